#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "lang/lower/motion.hpp"
#include "lang/object/object.hpp"
#include "render/math/interval.hpp"
#include "render/math/placement.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::lang {

/// A sphere with the name that a camera's `focus` uses.
struct NamedSphere {
  Location where;
  std::optional<render::Vec3> center{};  ///< in its groups, at shutter opening without `motion`;
                                         ///< nullopt: invalid, and reported
  std::optional<MotionValue> motion{};
  render::Placement groups{};  ///< at shutter opening

  /// The centre in the world when the shutter opens.
  render::Vec3 opening(const std::optional<render::Interval>& shutter) const;
};

/// Finds the spheres that cameras focus on, among all spheres of the scene: in groups, defs, loops
/// and included files. Settings are added before spheres, so other spheres are not kept.
class NamedSpheres {
 public:
  struct Found {
    std::size_t count = 0;             ///< of all spheres with the name
    std::vector<NamedSphere> spheres;  ///< the first kMaxShown
  };
  static constexpr std::size_t kMaxShown = 3;

  void want(const Object& camera);
  bool is_used() const noexcept { return !wanted_.empty(); }

  // These follow the objects; only if is_used().
  void add(const Object& sphere, const render::Placement& groups);
  void enter() { contents_.push_back(kNoContents); }
  void leave() { contents_.pop_back(); }
  void begin_contents(std::uint32_t contents) { contents_.back() = contents; }
  /// A group with known contents. The sphere in the first of these groups is known, so a name in it
  /// is ambiguous from now on.
  void repeat(const Object& group, std::uint32_t contents);

  /// The objects are complete, or not because of an error.
  void finish(bool is_complete) noexcept { is_complete_ = is_complete; }
  bool is_complete() const noexcept { return is_complete_; }
  const Found& find(std::string_view name) const;
  /// The most similar name of another sphere.
  std::optional<std::string> nearest(std::string_view name) const;

 private:
  static constexpr std::uint32_t kNoContents = 0xFFFFFFFF;
  static constexpr std::size_t kMaxOthers = 10'000;

  void add(std::string_view name, NamedSphere sphere);

  std::map<std::string, Found, std::less<>> wanted_;
  std::set<std::string, std::less<>> others_;  // names, for suggestions
  bool is_complete_ = true;
  std::vector<std::uint32_t> contents_;  // of the open groups
  std::unordered_map<std::uint32_t, std::set<std::string, std::less<>>> names_in_contents_;
};

}  // namespace sdlc::lang
