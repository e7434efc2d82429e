#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "lang/object/value.hpp"

namespace sdlc::lang {

/// Appends a key of `value` that only values with the same bits share. False if reading all of it
/// would take too long, as for long lists and strings.
bool append_identity(const Value& value, std::string& identity);

/// Memoization of the instances of a def: one with equal arguments is not evaluated again. A def
/// depends on its arguments, the file's globals and the time, and these do not change during the
/// evaluation of a frame.
class InstanceMemo {
 public:
  /// The def of an instance.
  struct Def {
    std::uint32_t module = 0, index = 0;
  };
  /// `number`: from 1, the same for all instances with the same contents; 0: not remembered.
  /// `height`: the depth of nested instances that were evaluated for it.
  struct Contents {
    std::uint32_t number = 0;
    bool is_new = false;
    int height = 0;
  };

  /// Whether instances of the def are still looked up: not after many misses and few hits.
  bool is_worthwhile(Def def) const;

  /// The contents of an instance; `arguments` is the key of its arguments and of whatever else
  /// matters.
  Contents look_up(Def def, const std::string& arguments);

  /// Sets the height of new contents.
  void set_height(Def def, const std::string& arguments, int height);

  /// Forgets new contents: something is wrong with them, which each instance has to report.
  void forget(Def def, const std::string& arguments);

 private:
  struct Known {
    std::uint32_t number;
    int height;
  };
  struct Instances {
    std::unordered_map<std::string, Known> known;
    std::uint64_t found = 0, missed = 0;
  };
  static std::uint64_t key(Def def) noexcept { return std::uint64_t{def.module} << 32 | def.index; }

  std::unordered_map<std::uint64_t, Instances> of_def_;
  std::uint32_t last_number_ = 0;
  std::size_t bytes_ = 0;  // of arguments
};

}  // namespace sdlc::lang
