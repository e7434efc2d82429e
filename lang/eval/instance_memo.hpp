#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "lang/object/value.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// Appends a key of `value` that only values with the same bits share. False for lists and strings
/// that are too long for a lookup to pay off, and for Nothing.
bool append_identity(const Value& value, std::string& identity);

/// Memoization of the contents of instances: those with equal arguments are not evaluated again. A
/// def depends on its arguments, the locals around it, the globals and the time, and the last two
/// do not change during the evaluation of a frame.
class InstanceMemo {
 public:
  /// The def of an instance.
  struct Def {
    std::uint32_t module = 0;
    NodeIndex node = 0;  ///< the statement
  };
  /// `number`: from 1, identifies equal contents; 0: not memoized.
  /// `height`: the depth of the calls and instances in it.
  struct Contents {
    std::uint32_t number = 0;
    bool is_new = false;
    std::uint64_t height = 0;
  };

  /// Whether instances of the def are still looked up: false after many misses and few hits.
  bool is_worthwhile(Def def) const;

  /// The contents of an instance. `arguments`: the key of its arguments and of anything else that
  /// its contents depend on.
  Contents look_up(Def def, const std::string& arguments);

  /// Sets the height of new contents.
  void set_height(Def def, const std::string& arguments, std::uint64_t height);

  /// Forgets new contents that had errors or warnings, which each instance has to report.
  void forget(Def def, const std::string& arguments);

 private:
  struct Known {
    std::uint32_t number;
    std::uint64_t height;
  };
  struct Instances {
    std::unordered_map<std::string, Known> known;
    std::uint64_t found = 0, missed = 0;
  };
  static std::uint64_t key(Def def) noexcept { return std::uint64_t{def.module} << 32 | def.node; }

  std::unordered_map<std::uint64_t, Instances> of_def_;
  std::uint32_t last_number_ = 0;
  std::size_t bytes_ = 0;  // of all keys
};

}  // namespace sdlc::lang
