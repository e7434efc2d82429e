#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "lang/schema/schema.hpp"

namespace sdlc::test {

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers everywhere.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  /// From 0 to count - 1.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }
  bool one_in(std::size_t count) { return below(count) == 0; }
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  template <typename T>
  const T& pick(std::span<const T> choices) {
    return choices[below(choices.size())];
  }

 private:
  std::uint64_t state_;
};

/// Generates configs from the tables of keys: every key present and, if allowed, absent and null,
/// in any order, with numbers and strings in every spelling. Each key is valid; some configs are
/// invalid as a whole (a camera without a view direction).
class ConfigGenerator {
 public:
  explicit ConfigGenerator(std::uint64_t seed) : random_(seed) {}

  std::string next();

  /// "camera.up present", "camera.time_interval null", "material diffuse", "number -0": the cases
  /// generated so far, and all cases.
  const std::set<std::string>& reached() const { return reached_; }
  static std::set<std::string> everything();

 private:
  enum class State : std::uint8_t { Present, Absent, Null };

  State choose_state(const lang::JsonKey& key, bool is_required, const std::string& name);
  std::string object(const lang::JsonObject& table, const std::string& name);
  std::string members(std::vector<std::string> members);
  std::string value(const lang::JsonKey& key, const std::string& name);
  std::string number(const lang::JsonKey& key, lang::Range range);
  std::string any_number();
  std::string number_in(lang::Range range);
  std::string numbers(std::size_t count, lang::Range range);
  std::string whole_number(std::string_view key);
  std::string string();
  std::string material();
  std::string spheres();

  SplitMix64 random_;
  std::set<std::string> reached_;
};

/// The config in a canonical form: without nulls, `focal_length`, unused spheres and movements
/// without a shutter; the choice of threads as their number, the shutter times in order, and
/// `gamma_correct` always present.
nlohmann::json without_what_has_no_effect(nlohmann::json config);

/// The real configs beside the repository; empty if they are absent.
std::vector<std::filesystem::path> reference_configs();

}  // namespace sdlc::test
