#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/json/parsed_text.hpp"
#include "lang/json/parser.hpp"
#include "lang/json/tape.hpp"
#include "lang/source/limits.hpp"
#include "lang/text/display_width.hpp"

namespace sdlc::lang {

/// Thrown after the report of a mistake that ends the parse.
struct JsonAbandoned {};

/// Builds the tape of each part of a config and passes it on when the part ends. Spans are those of
/// the parsed text.
class TapeBuilder {
 public:
  TapeBuilder(const ParsedText& text, ConfigParts& parts, DiagnosticSink& sink)
      : text_(text), parts_(parts), sink_(sink), streamed_(streamed_key()) {}

  void open(JsonNodeType type, Span bracket) {
    if (depth_ == kMaxNesting) {
      sink_.report(diag::too_deep, text_.at(bracket), kMaxNesting);
      throw JsonAbandoned{};
    }
    if (depth_ == 0) parts_.begin(text_.in_file(bracket));
    is_streaming_ |= depth_ == 1 && type == JsonNodeType::Array && is_streamed_name();
    open_[depth_++] = {size(), bracket};
    if (depth_ > 1) add(type, bracket);
  }
  void close(std::uint32_t end) {
    const Open& open = open_[--depth_];
    if (depth_ == 0) return;
    if (depth_ == 1) is_streaming_ = false;
    JsonNode& node = tape_[open.node];
    node.next = size();
    // If the bracket is missing in the file, more may be missing before it.
    if (text_.is_added(end - 1)) node.is_complete = false;
    node.span.end = text_.in_file({end, end}).end;
  }

  JsonNode& add(JsonNodeType type, Span span) {
    if (tape_.size() == kMaxNodes) stop_at_size(span);
    return tape_.emplace_back(
        JsonNode{.span = text_.in_file(span), .next = size() + 1, .type = type});
  }
  /// `number`: its spelling in JSON.
  void add_number(Span span, std::string_view number) {
    double value = 0;
    const auto result = std::from_chars(number.data(), number.data() + number.size(), value);
    if (result.ec != std::errc() || std::isinf(value)) {
      value = 0;
      if (is_large(number)) {
        sink_.report(diag::number_too_large, text_.at(span), abbreviated(number));
        add(JsonNodeType::Error, span);
        return;
      }
    }
    add(JsonNodeType::Number, span).number = value;
  }
  void begin_string(Span quote) noexcept { opening_quote_ = quote, has_escapes_ = false; }
  void note_escape() noexcept { has_escapes_ = true; }
  /// The string that begins at the last opening quote.
  void add_string(Span span) {
    JsonNode& node = add(JsonNodeType::String, span);
    node.quote_size = static_cast<std::uint8_t>(opening_quote_.size());
    node.has_escapes = has_escapes_;
  }
  /// Stands for a value that is missing at the place in the file.
  void add_missing(Span place) {
    tape_.push_back({.span = place, .next = size() + 1, .type = JsonNodeType::Error});
  }
  /// Marks the innermost object, or the config, as one that lacks a member.
  void leave_incomplete() noexcept {
    (depth_ > 1 ? tape_[open_[depth_ - 1].node].is_complete : is_complete_) = false;
  }

  void end_element() {
    sink_.stop_if_requested();
    if (!is_streaming_ || depth_ != 2) return;
    const std::uint32_t element = open_[1].node + 1;
    parts_.take_element(tape_, element);
    tape_.resize(element);
  }
  void end_member() {
    sink_.stop_if_requested();
    if (depth_ != 1) return;
    parts_.take_member(tape_);
    tape_.clear();
  }
  /// Passes on the unfinished part.
  void give_up() {
    const std::uint32_t end = size();
    while (depth_ > 1) {
      JsonNode& node = tape_[open_[--depth_].node];
      node.next = end;
      node.is_complete = false;
    }
    if (tape_.size() < 2) return;
    if (is_streaming_) {
      if (tape_.size() > 2) parts_.take_element(tape_, 2);
      tape_.resize(2);
      tape_[1].next = 2;
    }
    parts_.take_member(tape_);
  }

  bool is_complete() const noexcept { return is_complete_; }
  /// The last opening bracket that is not closed.
  std::optional<Span> open_bracket() const noexcept {
    return depth_ > 0 ? std::optional(open_[depth_ - 1].bracket) : std::nullopt;
  }
  Span opening_quote() const noexcept { return opening_quote_; }

 private:
  /// Parts other than the streamed spheres have a few dozen nodes.
  static constexpr std::size_t kMaxNodes = std::size_t{1} << 24;

  struct Open {
    std::uint32_t node = 0;  ///< unused for the outermost bracket
    Span bracket;
  };

  [[noreturn]] void stop_at_size(Span span) {
    sink_.report(diag::too_much_memory, text_.at(span), kMaxNodes * sizeof(JsonNode))
        .help("only `spheres` may have so many values");
    throw JsonAbandoned{};
  }
  /// Whether a number out of the range of double is too large and not too small: the decimal
  /// exponent of its first digit other than 0 decides. Precondition: `text` is a number of JSON and
  /// not 0.
  static bool is_large(std::string_view text) {
    if (text.starts_with('-')) text.remove_prefix(1);
    const std::size_t e = text.find_first_of("eE");
    const std::string_view digits = text.substr(0, e);
    const std::size_t point = std::min(digits.find('.'), digits.size());
    const std::size_t first = digits.find_first_of("123456789");
    const auto place = static_cast<double>(point) - static_cast<double>(first);

    double exponent = 0;
    if (e != std::string_view::npos) {
      std::string_view power = text.substr(e + 1);
      if (power.starts_with('+')) power.remove_prefix(1);
      std::from_chars(power.data(), power.data() + power.size(), exponent);
    }
    return place + exponent > 0;
  }

  bool is_streamed_name() const {
    std::string buffer;
    return member_name(text_.file(), tape_[0], buffer) == streamed_;
  }
  std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(tape_.size()); }

  const ParsedText& text_;
  ConfigParts& parts_;
  DiagnosticSink& sink_;
  std::string_view streamed_;  ///< the key of the spheres

  Tape tape_;
  std::array<Open, kMaxNesting> open_;
  int depth_ = 0;
  bool is_streaming_ = false;
  bool is_complete_ = true;
  bool has_escapes_ = false;  ///< of the current string
  Span opening_quote_;        ///< of the current string
};

}  // namespace sdlc::lang
