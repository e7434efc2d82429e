#include "tests/docs/markdown.hpp"

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace sdlc::test {
namespace {

constexpr std::string_view kFence = "```";
constexpr std::string_view kBegin = "<!-- generated: ";
constexpr std::string_view kBeginEnd = " -->";
constexpr std::string_view kEnd = "<!-- end -->";

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream in{std::string(text)};
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  std::istringstream in{std::string(text)};
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// The NAME in a line that begins a generated part.
std::optional<std::string> part_name(const std::string& line) {
  if (!line.starts_with(kBegin) || !line.ends_with(kBeginEnd)) return std::nullopt;
  return line.substr(kBegin.size(), line.size() - kBegin.size() - kBeginEnd.size());
}

}  // namespace

std::vector<CodeBlock> code_blocks_of(std::string_view page) {
  std::vector<CodeBlock> blocks;
  std::string heading;
  bool is_inside = false;
  std::uint32_t number = 0;
  for (const std::string& line : lines_of(page)) {
    ++number;
    if (line.starts_with(kFence)) {
      if (!is_inside) {
        blocks.push_back({.heading = heading,
                          .line = number,
                          .words = words_of(line.substr(kFence.size())),
                          .text = {}});
      }
      is_inside = !is_inside;
    } else if (is_inside) {
      blocks.back().text += line + "\n";
    } else if (line.starts_with('#')) {
      heading = line.substr(std::min(line.find_first_not_of("# "), line.size()));
    }
  }
  if (is_inside) throw std::runtime_error("a block of code has no end");
  return blocks;
}

std::string replace_code_block(std::string_view page, std::size_t index, std::string_view text) {
  std::string result;
  std::size_t fences = 0;
  for (const std::string& line : lines_of(page)) {
    const bool was_inside = fences == 2 * index + 1;
    fences += line.starts_with(kFence);
    const bool is_inside = fences == 2 * index + 1;
    if (was_inside && is_inside) continue;
    if (was_inside) result += text;
    result += line + "\n";
  }
  return result;
}

std::vector<GeneratedPart> generated_parts_of(std::string_view page) {
  std::vector<GeneratedPart> parts;
  bool is_inside = false;
  for (const std::string& line : lines_of(page)) {
    if (line == kEnd) is_inside = false;
    if (is_inside) parts.back().text += line + "\n";
    if (auto name = part_name(line)) {
      parts.push_back({.name = std::move(*name), .text = {}});
      is_inside = true;
    }
  }
  if (is_inside) throw std::runtime_error("a generated part has no end");
  return parts;
}

std::string replace_generated_part(std::string_view page, const GeneratedPart& part) {
  std::string result;
  bool is_inside = false;
  for (const std::string& line : lines_of(page)) {
    if (line == kEnd) is_inside = false;
    if (!is_inside) result += line + "\n";
    if (part_name(line) == part.name) {
      result += part.text;
      is_inside = true;
    }
  }
  return result;
}

}  // namespace sdlc::test
