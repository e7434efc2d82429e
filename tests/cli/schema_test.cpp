#include "lang/schema/schema.hpp"

#include <array>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "lang/compile/compile.hpp"
#include "lang/json/json.hpp"
#include "tests/support/configs/config_generator.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

// Compares the schema of configs with the reader of configs, using a real validator: the jsonschema
// module of Python. Without it those tests are skipped.
namespace sdlc::test {
namespace {

using nlohmann::json;
using testing::Each;
using testing::HasSubstr;

constexpr int kConfigs = 500;

bool has_validator() {
  const TemporaryFolder folder;
  return run_shell(folder.path(), "python3 -c 'import jsonschema'").exit_code == 0;
}

/// "valid" or "invalid" for each config, by the schema that the program prints.
std::vector<std::string> verdicts(const std::vector<json>& configs) {
  const TemporaryFolder folder;
  std::string lines;
  for (const json& config : configs) lines += config.dump() + "\n";
  write_text(folder / "configs", lines);
  const ProgramResult result =
      run_shell(folder.path(), "\"$SDLC\" schema > schema && python3 '" SDLC_SOURCE_DIR
                               "/tests/cli/validate_configs.py' schema < configs");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::istringstream words(result.out);
  return {std::istream_iterator<std::string>(words), {}};
}

class NoObjects final : public lang::ObjectSink {
 public:
  void add(const lang::Object& /*object*/) override {}
};

/// The same by the config reader, which checks each key separately, as a schema does.
std::string verdict_of_reader(const json& config) {
  const lang::SourceFile file("config.json", config.dump());
  lang::DiagnosticSink sink;
  NoObjects objects;
  lang::read_config(file, objects, sink);
  return sink.has_errors() ? "invalid" : "valid";
}

std::vector<json> generated_configs() {
  ConfigGenerator generator(77);
  std::vector<json> configs;
  while (configs.size() < kConfigs) {
    json config = json::parse(generator.next());
    if (verdict_of_reader(config) == "valid") configs.push_back(std::move(config));
  }
  return configs;
}

/// A small valid config.
json small_config() {
  return json::parse(R"({
    "camera": {"look_from": [0, 0, 0], "look_at": [0, 0, -1], "up": [0, 1, 0], "vfov": 90,
               "aspect_ratio": 2, "viewport_height": 2, "focal_length": 1,
               "samples_per_pixel": 4, "time_interval": [0, 1]},
    "rendering": {"width": 10, "render_depth": 4, "in_parallel": true, "number_cores": 2},
    "saving": {"path": "a.png", "gamma_correct": true},
    "background": [0, 0, 0],
    "spheres": [{"origin": [0, 0, -2], "radius": 1, "movement": [[1, 1, 1], 0, 1],
                 "material": {"type": "specular", "color": [1, 2, 3], "fuzz": 0.5}}]})");
}

json with(const std::string& pointer, const json& value) {
  json config = small_config();
  config[json::json_pointer(pointer)] = value;
  return config;
}

json without(const std::string& pointer) {
  json config = small_config();
  const json::json_pointer path(pointer);
  config[path.parent_pointer()].erase(path.back());
  return config;
}

/// The places of all values except the root.
void collect_places(const json& value, const json::json_pointer& place,
                    std::vector<json::json_pointer>& places) {
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) {
      places.push_back(place / key);
      collect_places(inner, place / key, places);
    }
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      places.push_back(place / i);
      collect_places(value[i], place / i, places);
    }
  }
}

/// The config with one change: a value, a member or element removed or added.
json damaged(json config, SplitMix64& random) {
  static const std::vector<json> kValues{
      nullptr,
      true,
      "text",
      0,
      -1,
      3.5,
      1000000001,
      json::array(),
      json::object(),
      180,
      {1, 2},
      {1, 2, 3},
      {1, -2, 3},
      json::parse(R"({"width": 1, "height": 1, "color": [1, 2, 3]})")};
  std::vector<json::json_pointer> places;
  collect_places(config, json::json_pointer(), places);
  const json::json_pointer& place = places[random.below(places.size())];
  json& parent = config[place.parent_pointer()];
  const json value = kValues[random.below(kValues.size())];
  switch (random.below(4)) {
    case 0:
      if (parent.is_object()) {
        parent.erase(place.back());
      } else {
        parent.erase(parent.begin() + static_cast<std::ptrdiff_t>(std::stoul(place.back())));
      }
      return config;
    case 1:
      if (parent.is_object()) {
        constexpr std::array<const char*, 5> kKeys{"colour", "image", "fuzz", "movement", "radius"};
        parent[kKeys[random.below(kKeys.size())]] = value;
      } else {
        parent.push_back(value);
      }
      return config;
    default: config[place] = value; return config;
  }
}

TEST(Schema, IsPrintedWithTheDialectItIsWrittenIn) {
  const TemporaryFolder folder;
  const ProgramResult result = run_shell(folder.path(), "\"$SDLC\" schema");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  const json schema = json::parse(result.out);
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema["$defs"]["material"]["oneOf"].size(), lang::all_materials().size());
}

TEST(Schema, DescribesEveryKey) {
  const TemporaryFolder folder;
  const json schema = json::parse(run_shell(folder.path(), "\"$SDLC\" schema").out);
  const auto check = [](auto&& self, const json& value) -> void {
    if (value.is_object() && value.contains("properties") && value["properties"].is_object()) {
      for (const auto& [name, property] : value["properties"].items()) {
        const bool is_bare = property.size() == 1;  // of a condition, or the type of a material
        EXPECT_TRUE(is_bare || property.contains("description")) << name << property;
      }
    }
    if (!value.is_structured()) return;
    for (const json& inner : value) self(self, inner);
  };
  check(check, schema);
}

TEST(Schema, AcceptsGeneratedAndRealConfigs) {
  if (!has_validator()) GTEST_SKIP() << "Python has no jsonschema here";
  std::vector<json> configs = generated_configs();
  for (const auto& path : reference_configs()) {
    configs.push_back(json::parse(std::ifstream(path)));
  }
  configs.push_back(small_config());
  EXPECT_THAT(verdicts(configs), Each("valid"));
}

TEST(Schema, RejectsWhatIsBroken) {
  if (!has_validator()) GTEST_SKIP() << "Python has no jsonschema here";
  const std::vector<json> broken{
      with("/unknown", 1),
      with("/camera/vfow", 1),
      with("/camera/vfov", "90"),
      with("/camera/vfov", 180),
      with("/camera/look_at", {1, 2}),
      with("/camera/look_at", {1, 2, 3, 4}),
      with("/camera/samples_per_pixel", 2.5),
      with("/camera/samples_per_pixel", 0),
      with("/camera/up", nullptr),
      with("/camera", nullptr),
      with("/rendering/in_parallel", 1),
      with("/saving/path", std::string("a\0b", 3)),
      with("/background", {0, 0, -1}),
      with("/spheres/0/radius", -1),
      with("/spheres/0/movement", {{1, 1, 1}, 0}),
      with("/spheres/0/movement", {{1, 1}, 0, 1}),
      with("/spheres/0/material/type", "mirror"),
      with("/spheres/0/material/intensity", 1),
      with("/spheres/0/material/fuzz", nullptr),
      with("/image", {{"width", 1}, {"height", 1}, {"color", {0, 0, 0}}}),
      without("/camera"),
      without("/saving"),
      without("/camera/focal_length"),
      without("/spheres/0/material/fuzz"),
      without("/spheres/0/material/type"),
      json::array()};
  for (const json& config : broken) EXPECT_EQ(verdict_of_reader(config), "invalid") << config;
  EXPECT_THAT(verdicts(broken), Each("invalid"));
}

TEST(Schema, AgreesWithTheReaderOnDamagedConfigs) {
  if (!has_validator()) GTEST_SKIP() << "Python has no jsonschema here";
  SplitMix64 random(5);
  std::vector<json> configs;
  for (const json& config : generated_configs()) configs.push_back(damaged(config, random));
  const std::vector<std::string> by_schema = verdicts(configs);
  ASSERT_EQ(by_schema.size(), configs.size());
  int invalid = 0;
  for (std::size_t i = 0; i < configs.size(); ++i) {
    const std::string by_reader = verdict_of_reader(configs[i]);
    EXPECT_EQ(by_schema[i], by_reader) << configs[i];
    invalid += by_reader == "invalid";
  }
  EXPECT_GT(invalid, kConfigs / 4);
  EXPECT_LT(invalid, kConfigs);
}

TEST(Schema, GivesTheTablesOfTheLanguage) {
  const TemporaryFolder folder;
  const ProgramResult result = run_shell(folder.path(), "\"$SDLC\" schema --language");
  EXPECT_EQ(result.exit_code, 0);
  const json tables = json::parse(result.out);
  EXPECT_EQ(tables["kinds"].size(), lang::all_kinds().size());
  EXPECT_EQ(tables["kinds"][0]["properties"][0],
            json::parse(R"json({"name": "from", "takes": "a point (x, y, z)", "required": true,
                            "doc": "The position of the camera.", "json": "look_from"
})json"));
  EXPECT_EQ(tables["diagnostics"].size(), lang::all_diagnostics().size());
  for (const char* table :
       {"constructors", "functions", "types", "data_formats", "limits", "colors"}) {
    EXPECT_FALSE(tables[table].empty()) << table;
  }
}

}  // namespace
}  // namespace sdlc::test
