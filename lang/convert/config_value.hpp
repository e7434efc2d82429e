#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lang/json/tape.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

struct ConfigMember;

/// A value of a config without mistakes.
class ConfigValue {
 public:
  ConfigValue(const SourceFile& file, const Tape& tape, std::uint32_t node) noexcept
      : file_(&file), tape_(&tape), node_(node) {}

  double number() const noexcept { return node().number; }
  /// As written in the text.
  std::string_view spelling() const noexcept { return file_->text(node().span); }
  /// The content of a string, its escapes resolved.
  std::string string() const;
  std::vector<ConfigValue> elements() const;
  /// The member of an object; nullopt if it is absent or null.
  std::optional<ConfigMember> find(std::string_view key) const;
  /// Without line breaks: "[[-3, 1, -2], 0, 1]"
  std::string on_one_line() const;

 private:
  const JsonNode& node() const noexcept { return (*tape_)[node_]; }

  const SourceFile* file_;
  const Tape* tape_;
  std::uint32_t node_;
};

struct ConfigMember {
  Location name;
  ConfigValue value;
};

}  // namespace sdlc::lang
