#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/resolve/symbol_table.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// Somewhere in the text: a location, or what of a sphere of the scene stands there. Where that is
/// will be found out for all findings at once.
struct LintPlace {
  enum Part : std::uint8_t { Text, Sphere, Material } part = Text;
  Location where = {};
  std::uint32_t sphere = 0;  ///< index in the scene

  static LintPlace of(Location where) { return {.part = Text, .where = where, .sphere = 0}; }
  static LintPlace of_sphere(std::uint32_t i) { return {.part = Sphere, .where = {}, .sphere = i}; }
  static LintPlace of_material(std::uint32_t sphere) {
    return {.part = Material, .where = {}, .sphere = sphere};
  }
};

/// A diagnostic on its way to the sink.
struct Finding {
  struct PlaceLabel {
    LintPlace place;
    std::string message;
  };

  const DiagnosticInfo* info;
  std::string message;
  LintPlace place = {};
  std::vector<PlaceLabel> labels = {};
  std::vector<std::string> help = {};
  std::vector<Fix> fixes = {};
};

/// What the rules look at, and where they put what they find.
class LintContext {
 public:
  /// Of one rule no more spheres are told: others of one place would be told once anyway.
  static constexpr std::size_t kMostFindings = 1000;
  /// Of more cameras nothing is claimed that all of them must agree on.
  static constexpr std::size_t kMostCameras = 100;

  LintContext(const SourceFile& file, const SyntaxTree* tree, Compiler& compiler,
              const LoweredScene& lowered)
      : file_(file), tree_(tree), compiler_(compiler), lowered_(lowered) {}

  const SourceFile& file() const noexcept { return file_; }
  /// Of the root; null of a config.
  const SyntaxTree* tree() const noexcept { return tree_; }
  /// What the names of the root mean. Precondition: it is no config.
  const SymbolTable& names() { return compiler_.names(); }
  const LoweredScene& lowered() const noexcept { return lowered_; }
  const render::Scene& scene() const noexcept { return lowered_.scene; }
  std::span<const render::Sphere> spheres() const noexcept { return lowered_.scene.spheres; }
  const render::Material& material_of(std::uint32_t sphere) const {
    return scene().materials[spheres()[sphere].material];
  }
  bool is_transmissive(std::uint32_t sphere) const {
    return material_of(sphere).type == render::MaterialType::Transmissive;
  }
  render::Vec3 shift_of(std::uint32_t sphere) const {
    return scene().shifts.empty() ? render::Vec3{} : scene().shifts[sphere];
  }
  /// Whether it has no camera of its own, so that others decide how it is looked at.
  bool is_part() const noexcept { return lowered_.checked_cameras.empty(); }

  /// Spheres that let nothing through, that no camera stands in, or nearly, and that hide all that
  /// is inside; of a part, which others look into, none.
  std::span<const std::uint32_t> closed();

  /// A sphere wholly inside a closed one while the shutter is open: no path gets there.
  struct HiddenSphere {
    std::uint32_t sphere;
    std::uint32_t around;
  };
  /// Near ones near each other.
  std::span<const HiddenSphere> hidden();
  bool is_hidden(std::uint32_t sphere);

  /// The first sphere of each material, of those that are not hidden.
  std::vector<std::uint32_t> spheres_of_materials();

  /// Where spheres come from, ascending; evaluates the scene once more.
  std::vector<Origin> trace(std::span<const std::uint32_t> spheres) {
    return compiler_.trace(spheres);
  }

  void stop_if_requested() const { lang::stop_if_requested(compiler_.stop_request()); }
  std::stop_token stop_token() const {
    const StopRequest* stop = compiler_.stop_request();
    return stop == nullptr ? std::stop_token() : stop->token();
  }

  template <typename... Args>
  Finding& add(const DiagnosticKind<Args...>& kind, LintPlace place,
               const std::type_identity_t<Args>&... args) {
    findings_.push_back({.info = &kind,
                         .message = fmt::format(fmt::runtime(kind.message), args...),
                         .place = place});
    return findings_.back();
  }
  /// The same with the message made.
  Finding& add_finding(const DiagnosticInfo& info, LintPlace place, std::string message) {
    findings_.push_back({.info = &info, .message = std::move(message), .place = place});
    return findings_.back();
  }
  std::vector<Finding> take_findings() { return std::move(findings_); }

 private:
  const SourceFile& file_;
  const SyntaxTree* tree_;
  Compiler& compiler_;
  const LoweredScene& lowered_;
  std::vector<Finding> findings_;
  std::optional<std::vector<std::uint32_t>> closed_;
  std::optional<std::vector<HiddenSphere>> hidden_;
  std::vector<bool> is_hidden_;  ///< by sphere, once `hidden_` is known
};

}  // namespace sdlc::lang
