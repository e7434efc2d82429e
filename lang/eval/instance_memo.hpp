#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "lang/value/computed.hpp"

namespace sdlc::lang {

/// Appends what tells `value` from every value that is not the very same, bit for bit. False where
/// looking at all of it would take too long, as of long lists and strings.
bool append_identity(const Computed& value, std::string& identity);

/// Remembers what each instance of a def held, so that one with equal arguments need not be
/// evaluated again: a def depends on nothing else but the file's globals and the time, which stand
/// still while a frame is evaluated.
class InstanceMemo {
 public:
  /// The def of an instance.
  struct Def {
    std::uint32_t module = 0, index = 0;
  };
  /// `number`: the same for all instances with the same contents, from 1 on.
  /// 0: they are not remembered. `height`: instances inside each other that were evaluated for it.
  struct Contents {
    std::uint32_t number = 0;
    bool is_new = false;
    int height = 0;
  };

  /// Whether instances of the def are still looked up: not after many of which hardly any was like
  /// an earlier one.
  bool is_worthwhile(Def def) const;

  /// The contents of an instance; `arguments` tells its arguments, and whatever else matters, from
  /// all others.
  Contents look_up(Def def, const std::string& arguments);

  /// Says of a new one how high it is.
  void set_height(Def def, const std::string& arguments, int height);

  /// That of a new one was not to be remembered, as what is wrong with it has to be told each time.
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
