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

/// A place in the text: a location, or that of a sphere of the scene or of its material. Spheres
/// are located for all findings at once.
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

/// A diagnostic whose places may refer to spheres until they are located.
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
  std::vector<ChainLink> chain = {};  ///< of the sphere; known once it is located
};

/// The input of the rules, and their findings.
class LintContext {
 public:
  /// Max spheres that a rule reports. Findings with the same source location are merged later, so
  /// more would hardly be seen.
  static constexpr std::size_t kMaxFindings = 1000;
  /// Rules that must hold for all cameras report nothing for scenes with more.
  static constexpr std::size_t kMaxCameras = 100;

  LintContext(const SourceFile& file, const SyntaxTree* tree, Compiler& compiler,
              const LoweredScene& lowered)
      : file_(file), tree_(tree), compiler_(compiler), lowered_(lowered) {}

  const SourceFile& file() const noexcept { return file_; }
  /// The tree of the root; null for a config.
  const SyntaxTree* tree() const noexcept { return tree_; }
  /// The symbols of the root. Precondition: it is not a config.
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
  /// Whether the file has no camera, and so is a part of other scenes.
  bool is_part() const noexcept { return lowered_.checked_cameras.empty(); }

  /// Opaque spheres that contain no camera, not even nearly: they hide everything inside. Empty for
  /// a part, whose cameras are unknown.
  std::span<const std::uint32_t> occluders();

  /// A sphere completely inside an occluder while the shutter is open: no path reaches it.
  struct HiddenSphere {
    std::uint32_t sphere;
    std::uint32_t container;
  };
  /// In an order that keeps near spheres together.
  std::span<const HiddenSphere> hidden();
  bool is_hidden(std::uint32_t sphere);

  /// The first sphere of each material that is not hidden.
  std::vector<std::uint32_t> spheres_of_materials();
  /// The transmissive spheres that are not hidden.
  std::vector<std::uint32_t> visible_transmissive();

  /// The origins of spheres, whose indices ascend. Evaluates the scene once more.
  std::vector<Origin> trace(std::span<const std::uint32_t> spheres) {
    return compiler_.trace(spheres);
  }

  const StopRequest* stop_request() const { return compiler_.stop_request(); }
  void stop_if_requested() const { lang::stop_if_requested(stop_request()); }
  std::stop_token stop_token() const {
    const StopRequest* stop = stop_request();
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
  /// The same with a formatted message.
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
  std::optional<std::vector<std::uint32_t>> occluders_;
  std::optional<std::vector<HiddenSphere>> hidden_;
  std::vector<bool> is_hidden_;  ///< by sphere, once `hidden_` is known
};

/// The origins of some spheres of a scene.
class SphereOrigins {
 public:
  SphereOrigins(LintContext& context, std::vector<std::uint32_t> spheres);

  /// The origin of one of them.
  const Origin& of(std::uint32_t sphere) const;

 private:
  std::vector<std::uint32_t> spheres_;  // ascending
  std::vector<Origin> origins_;
};

}  // namespace sdlc::lang
