#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "lang/code/code.hpp"
#include "lang/program/program.hpp"

namespace sdlc::lang {

/// Flags of the globals of a program, by module and index.
class GlobalSet {
 public:
  explicit GlobalSet(const Program& program) : program_(program), flags_(program.module_count()) {}

  bool contains(std::uint32_t module, std::uint32_t global) const {
    return !flags_[module].empty() && flags_[module][global];
  }
  void add(std::uint32_t module, std::uint32_t global) {
    if (flags_[module].empty()) flags_[module].resize(program_.module(module).globals.size());
    flags_[module][global] = true;
  }

 private:
  const Program& program_;
  std::vector<std::vector<bool>> flags_;  // of a module: empty until one is added
};

/// The values of the top level that expressions use, directly or through other values and
/// functions.
class UsedValues {
 public:
  struct Item {
    std::uint32_t module, global;
  };

  /// Values in `known`, and what only they use, are omitted.
  UsedValues(const Program& program, const GlobalSet& known)
      : program_(program), known_(known), found_(program) {}

  /// Adds what the expression uses. False if so much code is reached that evaluating it takes too
  /// long; the result is then incomplete.
  bool add(const Code& code, std::uint32_t expression);
  bool add_global(std::uint32_t module, std::uint32_t global);

  /// In no particular order.
  std::vector<Item>& globals() noexcept { return globals_; }
  bool uses_time() const noexcept { return uses_time_; }

 private:
  struct Part {
    const Code* code;
    std::uint32_t expression;
  };

  bool visit_all();
  bool visit(const Part& part);
  void visit_global(std::uint32_t module, std::uint32_t global);
  void visit_function(std::uint32_t module, std::uint32_t function);

  const Program& program_;
  const GlobalSet& known_;
  GlobalSet found_;
  std::vector<Item> globals_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> functions_;
  std::vector<Part> open_;  // an explicit stack: a file may chain a million values
  std::size_t visited_ = 0;
  bool uses_time_ = false;
};

}  // namespace sdlc::lang
