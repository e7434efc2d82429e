#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Parsing of Markdown pages for the tests of the documentation.
namespace sdlc::test {

/// A fenced block of code.
struct CodeBlock {
  std::string heading;             ///< of the section that contains it
  std::uint32_t line = 0;          ///< of its opening fence, from 1
  std::vector<std::string> words;  ///< after the opening fence
  std::string text;
};

std::vector<CodeBlock> code_blocks_of(std::string_view page);

/// The page with the text of block number `index`, counted from 0, replaced.
std::string replace_code_block(std::string_view page, std::size_t index, std::string_view text);

/// A part of a page between `<!-- generated: NAME -->` and `<!-- end -->`, each on its own line.
struct GeneratedPart {
  std::string name;
  std::string text;
};

std::vector<GeneratedPart> generated_parts_of(std::string_view page);

/// The page with the part of this name replaced.
std::string replace_generated_part(std::string_view page, const GeneratedPart& part);

}  // namespace sdlc::test
