#include "cli/page_text.hpp"

#include <cstddef>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/text/utf8.hpp"

namespace sdlc::cli {
namespace {

constexpr std::size_t kColumns = 80;
constexpr std::string_view kFence = "```";
constexpr std::string_view kItem = "* ";

/// Replaces `[words](address)` by the words.
std::string without_links(const std::string& text) {
  std::string result;
  std::size_t rest = 0;
  while (true) {
    const std::size_t middle = text.find("](", rest);
    if (middle == std::string::npos) return result + text.substr(rest);
    const std::size_t begin = text.rfind('[', middle), end = text.find(')', middle);
    result += text.substr(rest, begin - rest) + text.substr(begin + 1, middle - begin - 1);
    rest = end + 1;
  }
}

/// The words of a paragraph; text in backticks is a single word.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream in(text);
  bool is_inside = false;
  for (std::string word; in >> word;) {
    if (is_inside) {
      words.back() += " " + word;
    } else {
      words.push_back(word);
    }
    for (const char c : word) is_inside ^= c == '`';
  }
  return words;
}

class PageWriter {
 public:
  explicit PageWriter(bool has_color) : has_color_(has_color) {}

  void read(const std::string& line) {
    if (line.starts_with(kFence)) {
      end_paragraph();
      if (!is_inside_) write_caption(line.substr(kFence.size()));
      is_inside_ = !is_inside_;
    } else if (is_inside_) {
      out_ += line.empty() ? "\n" : "    " + line + "\n";
    } else if (line.starts_with('#')) {
      out_ += heading(line.substr(line.find_first_not_of("# ")), has_color_) + "\n";
    } else if (line.empty()) {
      end_paragraph();
      out_ += "\n";
    } else {
      if (line.starts_with(kItem)) end_paragraph();
      paragraph_ += line + " ";
    }
  }

  std::string finish() {
    end_paragraph();
    return std::move(out_);
  }

 private:
  /// Writes a caption from the words of a fence: LANGUAGE KIND [NAME [FLAG…]].
  void write_caption(const std::string& fence) {
    const std::vector<std::string> words = words_of(fence);
    const bool is_message = words.size() > 1 && words[1] == "message";
    if (is_message) {
      out_ += "sdlc reports:\n\n";
    } else if (words.size() > 3) {
      out_ +=
          fmt::format("{}, with {}:\n\n", words[2], fmt::join(words.begin() + 3, words.end(), " "));
    } else if (words.size() > 2) {
      out_ += words[2] + ":\n\n";
    }
  }

  void end_paragraph() {
    if (paragraph_.empty()) return;
    const std::string indent(paragraph_.starts_with(kItem) ? kItem.size() : 0, ' ');
    std::size_t column = 0;
    for (const std::string& word : words_of(without_links(std::exchange(paragraph_, "")))) {
      const std::size_t width = lang::count_code_points(word);
      if (column > 0 && column + 1 + width > kColumns) {
        out_ += "\n" + indent;
        column = indent.size();
      } else if (column > 0) {
        out_ += ' ';
        ++column;
      }
      out_ += word;
      column += width;
    }
    out_ += '\n';
  }

  bool has_color_;
  bool is_inside_ = false;  // inside a code block
  std::string paragraph_;
  std::string out_;
};

}  // namespace

std::string heading(std::string_view text, bool has_color) {
  return has_color ? fmt::format("\x1b[1m{}\x1b[0m", text) : std::string(text);
}

std::string page_text(std::string_view page, bool has_color) {
  PageWriter writer(has_color);
  std::istringstream in{std::string(page)};
  for (std::string line; std::getline(in, line);) writer.read(line);
  return writer.finish();
}

}  // namespace sdlc::cli
