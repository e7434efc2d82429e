#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Pieces of scene text; lang/format breaks it into lines.
namespace sdlc::lang {

/// The text as a string of the language, with escapes for invisible characters.
std::string scene_string(std::string_view text);

/// The text of an object. Properties are added in any order and written in that of their table.
class ObjectText {
 public:
  explicit ObjectText(std::string head) : head_(std::move(head)) {}

  void add(std::size_t order, std::string_view label, std::string value);
  /// Comments come after the properties.
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
