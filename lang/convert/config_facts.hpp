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

/// A number that stands for the radius of several spheres.
struct ConfigRadius {
  std::string_view spelling;
  std::string name;  ///< of its declaration; empty where there is none
};

/// A material of a config, and how the language writes it.
struct ConfigMaterial {
  MaterialValue value;
  std::string text;
  std::size_t uses = 0;
  std::unordered_map<std::string_view, std::size_t> radii = {};  ///< of its spheres, as spelled
  std::string name = {};  ///< of its declaration; empty where it is used once and has none
  ConfigRadius radius = {};
};

/// What one has to know of a whole config before its first line can be written: the materials, in
/// the order of their first use, and whether anything can be seen moving.
class ConfigFacts final : public ConfigParts {
 public:
  explicit ConfigFacts(const SourceFile& file) : file_(&file) {}

  void begin(Span /*bracket*/) override {}
  void take_element(const Tape& tape, std::uint32_t element) override;
  void take_member(const Tape& tape) override;

  /// Gives names to the materials that are used more than once, and to a radius that so many of
  /// their spheres have that it is hardly chance.
  void finish();

  const std::vector<ConfigMaterial>& materials() const noexcept { return materials_; }
  /// That of a `material` that was counted.
  const ConfigMaterial& material_of(const ConfigValue& material) const;
  bool has_shutter() const noexcept { return has_shutter_; }

 private:
  const SourceFile* file_;
  std::vector<ConfigMaterial> materials_;
  std::unordered_map<std::string, std::size_t> indices_;  ///< by what the config says, bit for bit
  bool has_shutter_ = false;
};

/// Whether the key's value is, bit for bit, what the property is where nothing is written.
bool is_default(const Property& property, const JsonKey& key, const ConfigValue& value);

/// The language's spelling of a config's colour, three numbers of which 255 is 1: of the same bits,
/// with the config's own numbers unless there is a plainer way.
std::string color_text(const ConfigValue& color);

/// "(1, 2, 3)"
std::string triple_text(const ConfigValue& triple);

}  // namespace sdlc::lang
