#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "lang/code/code.hpp"
#include "lang/program/program.hpp"

namespace sdlc::lang {

/// The values of the top level that expressions use, directly or through other values and
/// functions.
class UsedValues {
 public:
  explicit UsedValues(const Program& program);

  /// Adds what the expression uses. False if it reads locals, or if so much code is reached that
  /// evaluating it takes too long; the result is then incomplete.
  bool add(const Code& code, std::uint32_t expression);
  bool add_global(std::uint32_t module, std::uint32_t global);

  bool contains(std::uint32_t module, std::uint32_t global) const {
    return module < globals_.size() && global < globals_[module].size() && globals_[module][global];
  }
  bool uses_module(std::uint32_t module) const { return !globals_[module].empty(); }
  bool uses_time() const noexcept { return uses_time_; }

 private:
  struct Item {
    const Code* code;
    std::uint32_t expression;
    bool may_read_locals;  ///< in a function
  };

  bool visit_all();
  bool visit(const Item& item);
  void visit_global(std::uint32_t module, std::uint32_t global);
  void visit_function(std::uint32_t module, std::uint32_t function);

  const Program& program_;
  std::vector<std::vector<bool>> globals_;  // by module; empty until one is used
  std::set<std::pair<std::uint32_t, std::uint32_t>> functions_;
  std::vector<Item> open_;  // an explicit stack: a file may chain a million values
  std::size_t visited_ = 0;
  bool uses_time_ = false;
};

}  // namespace sdlc::lang
