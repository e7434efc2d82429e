#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/repair/repair_report.hpp"

namespace sdlc::lang {

/// A round of repairs that visits the tokens of a scene one by one and knows what encloses each.
class SceneRound : protected RepairRound {
 protected:
  using RepairRound::RepairRound;

  /// What a bracket encloses.
  enum class Inside : std::uint8_t {
    File,    ///< no bracket
    Group,   ///< properties and statements
    Object,  ///< properties
    Block,   ///< statements
    Arguments,
    Parameters,
    Loop,   ///< the head of a `for` of another language
    Value,  ///< a point, a list or a part of a formula
  };

  /// Calls `visit` at each token, `i_`.
  template <typename Visit>
  void walk(Visit visit) {
    for (; i_ < tokens_.size(); ++i_) {
      stop_if_requested();
      note_statement();
      is_skipped_ = false;
      visit();
      if (!is_skipped_) follow_brackets();
    }
  }
  /// Continues after the token `last`.
  void skip_to(std::size_t last) {
    i_ = last;
    is_skipped_ = true;
  }

  Inside inside() const { return inside_.empty() ? Inside::File : inside_.back(); }
  bool in_block() const { return inside() <= Inside::Block; }
  bool in_object() const { return inside() == Inside::Group || inside() == Inside::Object; }
  /// Whether the token is between a `let` of a value and its `in`.
  bool in_let() const { return is_let_; }
  /// Whether the token is in the condition of an `if` or an `assert`.
  bool in_condition() const { return is_condition_; }

  DiagnosticBuilder expected(Span span, std::string_view what);

  std::size_t i_ = 0;

 private:
  void note_statement();
  void follow_brackets();

  std::vector<Inside> inside_;  ///< the brackets that are open
  bool is_skipped_ = false;
  Inside next_block_ = Inside::Block;  ///< what the next brace opens
  bool is_condition_ = false;
  bool is_let_ = false;
};

}  // namespace sdlc::lang
