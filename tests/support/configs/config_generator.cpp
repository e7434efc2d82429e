#include "tests/support/configs/config_generator.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sdlc::test {
namespace {

using lang::JsonKey;
using lang::JsonType;
using lang::Presence;
using lang::Range;

/// Some spellings of each kind; otherwise the number is random.
struct NumberStyle {
  std::string_view name;
  std::vector<std::string> spellings;
};

const std::vector<NumberStyle>& number_styles() {
  static const std::vector<NumberStyle> styles{
      {"whole", {"0", "1", "-1", "2", "3", "-7", "12", "255"}},
      {"fraction", {"0.5", "-0.25", "0.50", "1.10", "-12.250", "127.5", "63.9", "0.1"}},
      {"exponent", {"1e3", "2.5E+1", "125e-2", "-1e0", "1E-3"}},
      {"zero with a sign", {"-0", "-0.0", "0.0", "0e5"}},
      {"extreme", {"1e-300", "-1e300", "1e300", "5e-324", "1e-320", "1.7976931348623157e308"}},
      {"all digits", {}},
      {"many digits", {"0.10000000000000000555111512312578270211815834045410156250000000000001"}}};
  return styles;
}

constexpr std::array<std::string_view, 9> kStrings{"results/picture.png",
                                                   "a.ppm",
                                                   "",
                                                   R"(\u00e9t\u00e9/\ud83d\ude00.png)",
                                                   "картинка 日本.exr",
                                                   R"(say \"it\" \\ \/ \b\f\n\r\t.png)",
                                                   R"(\u202e\u00a0\u200b.png)",
                                                   "\u202e\u00a0raw\u3000\u007f.png",
                                                   "ring.####.png"};

double value_of(const std::string& number) { return nlohmann::json::parse(number).get<double>(); }

bool is_in(Range range, double number) {
  switch (range) {
    case Range::Positive: return number > 0;
    case Range::NonNegative: return number >= 0;
    case Range::BetweenZeroAndHalfTurn: return number > 0 && number < 180;
    default: return true;
  }
}

Range range_of(const JsonKey& key) {
  return key.target == nullptr ? key.range : key.target->properties[key.property].range;
}

void add_states(const lang::JsonObject& table, const std::string& name,
                std::set<std::string>& all) {
  for (const JsonKey& key : table.keys) {
    const std::string full = name + std::string(key.key);
    // All other parts of the config are absent if there is an `image`, except one.
    const bool is_part = name.empty() && key.key != "saving";
    all.insert(full + " present");
    if (is_part || key.presence == Presence::Optional) {
      all.insert({full + " absent", full + " null"});
    }
    if (key.object != nullptr) add_states(*key.object, full + ".", all);
  }
}

}  // namespace

std::set<std::string> ConfigGenerator::everything() {
  std::set<std::string> all;
  add_states(lang::json_config(), "", all);
  add_states(lang::json_sphere(), "sphere.", all);
  for (const lang::MaterialInfo& material : lang::all_materials()) {
    all.insert(fmt::format("material {}", material.json_name));
  }
  for (const NumberStyle& style : number_styles()) all.insert(fmt::format("number {}", style.name));
  return all;
}

std::string ConfigGenerator::next() {
  const bool is_plain = random_.one_in(8);
  std::vector<std::string> parts;
  for (const JsonKey& key : lang::json_config().keys) {
    const std::string name(key.key);
    const bool is_of_plain = key.key == "image";
    const bool is_wanted = key.key == "saving" || is_plain == is_of_plain;
    const bool is_required =
        key.key == "saving" || is_of_plain || key.presence == Presence::Required;
    State state = State::Absent;
    if (is_wanted) {
      state = choose_state(key, is_required, name);
    } else {
      state = random_.one_in(2) ? State::Absent : State::Null;
      reached_.insert(name + (state == State::Null ? " null" : " absent"));
    }
    if (state == State::Null) parts.push_back(fmt::format("\"{}\": null", name));
    if (state == State::Present) parts.push_back(fmt::format("\"{}\": {}", name, value(key, name)));
  }
  return members(std::move(parts)) + "\n";
}

ConfigGenerator::State ConfigGenerator::choose_state(const JsonKey& /*key*/, bool is_required,
                                                     const std::string& name) {
  const State state = is_required ? State::Present : static_cast<State>(random_.below(3));
  reached_.insert(name + (state == State::Present  ? " present"
                          : state == State::Absent ? " absent"
                                                   : " null"));
  return state;
}

std::string ConfigGenerator::object(const lang::JsonObject& table, const std::string& name) {
  std::vector<std::string> all;
  for (const JsonKey& key : table.keys) {
    const std::string full = name + "." + std::string(key.key);
    const State state = choose_state(key, key.presence == Presence::Required, full);
    if (state == State::Null) all.push_back(fmt::format("\"{}\": null", key.key));
    if (state == State::Present)
      all.push_back(fmt::format("\"{}\": {}", key.key, value(key, full)));
  }
  return members(std::move(all));
}

std::string ConfigGenerator::members(std::vector<std::string> all) {
  for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[random_.below(i)]);
  const char* separator = random_.one_in(2) ? ", " : ",\n\t";
  return fmt::format("{{{}}}", fmt::join(all, separator));
}

std::string ConfigGenerator::value(const JsonKey& key, const std::string& name) {
  switch (key.type) {
    case JsonType::Object: return object(*key.object, name);
    case JsonType::Spheres: return spheres();
    case JsonType::Material: return material();
    case JsonType::Number: return number(key, range_of(key));
    case JsonType::WholeNumber: return whole_number(key.key);
    case JsonType::Bool: return random_.one_in(2) ? "true" : "false";
    case JsonType::String: {
      const std::span<const std::string_view> all(kStrings);
      return fmt::format("\"{}\"", random_.pick(all));
    }
    case JsonType::Triple: return numbers(3, Range::Any);
    case JsonType::Color: return numbers(3, Range::NonNegative);
    case JsonType::Degrees: return number_in(range_of(key));
    case JsonType::Interval: return numbers(2, Range::Any);
    case JsonType::Movement:
      return fmt::format("[{}, {},\n {}]", numbers(3, Range::Any), any_number(), any_number());
  }
  return "null";
}

std::string ConfigGenerator::number(const JsonKey& key, Range range) {
  // Other pictures have no rows, or more than the program allows.
  constexpr std::array<std::string_view, 6> kAspects{
      "1", "1.50", "1.7777777777777777777777777777777777777777778", "16e-1", "0.75", "2"};
  const std::span<const std::string_view> aspects(kAspects);
  return key.key == "aspect_ratio" ? std::string(random_.pick(aspects)) : number_in(range);
}

std::string ConfigGenerator::any_number() {
  // Combine extremes only rarely: two of them usually overflow.
  const auto& styles = number_styles();
  std::size_t index = random_.below(styles.size());
  if (styles[index].name == "extreme" && !random_.one_in(8)) index = 0;
  const NumberStyle& style = styles[index];
  reached_.insert(fmt::format("number {}", style.name));
  if (!style.spellings.empty()) return random_.pick(std::span<const std::string>(style.spellings));
  return fmt::format("{}", (random_.uniform() * 2 - 1) * 300);
}

std::string ConfigGenerator::number_in(Range range) {
  while (true) {
    const std::string number = any_number();
    if (is_in(range, value_of(number))) return number;
  }
}

std::string ConfigGenerator::numbers(std::size_t count, Range range) {
  std::vector<std::string> all;
  while (all.size() < count) {
    std::string number = number_in(range);
    // The smallest colours become black in every reader, after division by 255.
    const double value = value_of(number);
    if (range == Range::NonNegative && value != 0 && value / 255 == 0) continue;
    all.push_back(std::move(number));
  }
  return fmt::format("[{}]", fmt::join(all, random_.one_in(2) ? ", " : ",\n"));
}

std::string ConfigGenerator::whole_number(std::string_view key) {
  constexpr std::array<std::string_view, 7> kSmall{"1", "2", "4", "5.0", "1e1", "16", "64"};
  constexpr std::array<std::string_view, 5> kWide{"16", "2.4e1", "20.0", "960", "1920"};
  if (key == "number_cores" && random_.one_in(3)) return "0";
  const bool is_wide = key == "width" || key == "height";
  const std::span<const std::string_view> choices =
      is_wide ? std::span<const std::string_view>(kWide) : kSmall;
  return std::string(random_.pick(choices));
}

std::string ConfigGenerator::material() {
  const lang::MaterialInfo& info = random_.pick(lang::all_materials());
  reached_.insert(fmt::format("material {}", info.json_name));
  std::vector<std::string> all{fmt::format("\"type\": \"{}\"", info.json_name)};
  for (const JsonKey& key : lang::json_material_keys(info.id)) {
    const Range range = info.arguments[key.property].range;
    const bool is_white = key.type == JsonType::Color && random_.one_in(4);
    all.push_back(fmt::format("\"{}\": {}", key.key,
                              is_white                      ? "[255, 255, 255]"
                              : key.type == JsonType::Color ? numbers(3, range)
                                                            : number_in(range)));
  }
  return members(std::move(all));
}

std::string ConfigGenerator::spheres() {
  std::vector<std::string> all;
  const std::string shared = material();
  for (std::size_t i = random_.below(7); i > 0; --i) {
    all.push_back(object(lang::json_sphere(), "sphere"));
  }
  // A material that several spheres share.
  for (std::size_t i = random_.below(4); i > 0; --i) {
    all.push_back(fmt::format(R"({{"origin": {}, "radius": 1, "material": {}}})",
                              numbers(3, Range::Any), shared));
  }
  return fmt::format("[{}]", fmt::join(all, ",\n"));
}

nlohmann::json without_what_has_no_effect(nlohmann::json config) {
  const auto drop_nulls = [](auto&& self, nlohmann::json& value) -> void {
    if (value.is_object()) {
      for (auto member = value.begin(); member != value.end();) {
        member = member->is_null() ? value.erase(member) : std::next(member);
      }
    }
    if (!value.is_structured()) return;
    for (auto& inner : value) self(self, inner);
  };
  drop_nulls(drop_nulls, config);
  if (config.contains("rendering")) {
    auto& rendering = config["rendering"];
    const bool is_parallel = rendering.value("in_parallel", true);
    rendering["threads"] = is_parallel ? rendering.value("number_cores", 0.0) : 1.0;
    rendering.erase("in_parallel");
    rendering.erase("number_cores");
  }
  auto& saving = config["saving"];
  saving["gamma_correct"] = saving.value("gamma_correct", false);
  if (config.contains("spheres") && config["spheres"].empty()) config.erase("spheres");
  if (!config.contains("camera")) return config;

  auto& camera = config["camera"];
  camera.erase("focal_length");
  const bool has_shutter = camera.contains("time_interval");
  if (has_shutter) std::sort(camera["time_interval"].begin(), camera["time_interval"].end());
  if (!has_shutter && config.contains("spheres")) {
    for (auto& sphere : config["spheres"]) sphere.erase("movement");
  }
  return config;
}

std::vector<std::filesystem::path> reference_configs() {
  namespace fs = std::filesystem;
  std::vector<fs::path> paths;
  std::error_code absent;
  const fs::path folder = fs::path(SDLC_SOURCE_DIR) / ".." / "shared" / "reference" / "configs";
  for (const auto& entry : fs::directory_iterator(folder, absent)) paths.push_back(entry.path());
  std::ranges::sort(paths);
  return paths;
}

}  // namespace sdlc::test
