#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "lang/convert/config_value.hpp"
#include "lang/json/parser.hpp"
#include "lang/object/object.hpp"
#include "lang/schema/schema.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// A common radius of the spheres of a material.
struct ConfigRadius {
  std::string_view spelling;
  std::string name;  ///< of its declaration; empty: none
};

/// A material of a config and its text in the language.
struct ConfigMaterial {
  MaterialValue value;
  std::string text;
  std::size_t uses = 0;
  std::unordered_map<std::string_view, std::size_t> radii = {};  ///< uses of each spelling
  std::string name = {};  ///< of its declaration; empty if it is used once
  ConfigRadius radius = {};
};

/// First pass over a config: collects its materials, in the order of their first use, and whether
/// it has a shutter.
class ConfigFacts final : public ConfigParts {
 public:
  explicit ConfigFacts(const SourceFile& file) : file_(&file) {}

  void begin(Span /*bracket*/) override {}
  void take_element(const Tape& tape, std::uint32_t element) override;
  void take_member(const Tape& tape) override;

  /// Names the materials that are used more than once, and their radii that many spheres share.
  void finish();

  const std::vector<ConfigMaterial>& materials() const noexcept { return materials_; }
  /// Precondition: `material` is of the config.
  const ConfigMaterial& material_of(const ConfigValue& material) const;
  bool has_shutter() const noexcept { return has_shutter_; }

 private:
  const SourceFile* file_;
  std::vector<ConfigMaterial> materials_;
  std::unordered_map<std::string, std::size_t> indices_;  ///< by identity_of()
  bool has_shutter_ = false;
};

/// Whether the value equals the default of the property, bit for bit.
bool is_default(const Property& property, const JsonKey& key, const ConfigValue& value);

/// The colour in the language, with the same bits: `red`, `linear(…)` if that is shorter, else
/// `linear255(…)` with the numbers of the config.
std::string color_text(const ConfigValue& color);

/// "(1, 2, 3)"
std::string triple_text(const ConfigValue& triple);

}  // namespace sdlc::lang
