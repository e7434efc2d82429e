#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Pieces of scene text. Where lines end is left to lang/format.
namespace sdlc::lang {

/// The text as a string of the language. What one cannot see is written as an escape.
std::string scene_string(std::string_view text);

/// An object whose properties come in any order and are written in that of their table.
class ObjectText {
 public:
  explicit ObjectText(std::string head) : head_(std::move(head)) {}

  void add(std::size_t order, std::string_view label, std::string value);
  /// Comments stand behind the properties.
  void add_comment(std::string text) { comments_.push_back(std::move(text)); }
  bool is_empty() const noexcept { return entries_.empty() && comments_.empty(); }

  std::string str() const;

 private:
  struct Entry {
    std::size_t order;
    std::string label;
    std::string value;
  };

  std::string head_;
  std::vector<Entry> entries_;  ///< by their order
  std::vector<std::string> comments_;
};

}  // namespace sdlc::lang
