#include "lsp/json_rpc.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "lang/text/ascii.hpp"

namespace sdlc::lsp {
namespace {

/// Header lines are short. A longer one is data of a message whose header was wrong.
constexpr std::size_t kMaxHeaderLine = 4096;

bool is_id(const Json& id) { return id.is_string() || id.is_number(); }

/// The depth of arrays and objects; brackets in strings do not count.
int depth_of(std::string_view json) {
  int depth = 0, max_depth = 0;
  bool is_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (is_string && c == '\\') {
      ++i;
    } else if (c == '"') {
      is_string = !is_string;
    } else if (!is_string && (c == '[' || c == '{')) {
      max_depth = std::max(max_depth, ++depth);
    } else if (!is_string && (c == ']' || c == '}')) {
      --depth;
    }
  }
  return max_depth;
}

[[noreturn]] void fail(ErrorCode code, std::string reason, Json id = nullptr) {
  throw MalformedMessage{.code = code, .reason = std::move(reason), .id = std::move(id)};
}

}  // namespace

/// The line without its line end; nullopt at the end of the stream. The rest of a long line is
/// skipped.
std::optional<std::string> MessageReader::read_line() {
  std::string line;
  char c = 0;
  while (in_.get(c)) {
    if (c == '\n') {
      if (line.ends_with('\r')) line.pop_back();
      return line;
    }
    if (line.size() < kMaxHeaderLine) line += c;
  }
  return std::nullopt;
}

/// The length of the content; nullopt at the end of the stream.
std::optional<std::uint64_t> MessageReader::read_header() {
  constexpr std::string_view kLength = "content-length:";
  std::optional<std::uint64_t> length;
  while (true) {
    const std::optional<std::string> line = read_line();
    if (!line) return std::nullopt;
    if (line->empty()) {
      if (!length) continue;  // not the end of a header
      return length;
    }
    // After bytes of a broken message the header may be in the middle of a line.
    const std::size_t at = lang::lower_case(*line).rfind(kLength);
    if (at == std::string::npos) {
      if (!length && line->find(':') == std::string::npos) {
        fail(ErrorCode::ParseError, "a message has no Content-Length");
      }
      continue;
    }
    const std::size_t digits =
        std::min(line->find_first_not_of(" \t", at + kLength.size()), line->size());
    std::uint64_t value = 0;
    const char* const end = line->data() + line->size();
    const auto [stop, error] = std::from_chars(line->data() + digits, end, value);
    if (error != std::errc() || stop != end || value > kMaxBytes) {
      fail(ErrorCode::ParseError, "a message has an invalid Content-Length");
    }
    length = value;
  }
}

std::optional<Message> MessageReader::next() {
  const std::optional<std::uint64_t> length = read_header();
  if (!length) return std::nullopt;
  // Grow with what arrives: the length alone must not take memory.
  constexpr std::uint64_t kChunk = std::uint64_t{1} << 20;
  std::string content;
  while (content.size() < *length) {
    const std::size_t before = content.size();
    const auto wanted = static_cast<std::size_t>(std::min(kChunk, *length - before));
    content.resize(before + wanted);
    if (!in_.read(content.data() + before, static_cast<std::streamsize>(wanted))) {
      return std::nullopt;
    }
  }
  log_.received(content);
  return parse_message(content);
}

const std::string& document_uri(const Json& params) {
  const Json::json_pointer pointer("/textDocument/uri");
  if (!params.is_object() || !params.contains(pointer) || !params.at(pointer).is_string()) {
    throw RequestError(ErrorCode::InvalidParams, "there is no `textDocument.uri`");
  }
  return params.at(pointer).get_ref<const std::string&>();
}

Message parse_message(std::string_view text) {
  if (depth_of(text) > kMaxMessageDepth) {
    fail(ErrorCode::InvalidRequest, "a message is nested too deeply");
  }
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    fail(ErrorCode::ParseError, fmt::format("a message is no JSON from byte {} on", error.byte));
  }
  if (!json.is_object()) fail(ErrorCode::InvalidRequest, "a message must be a JSON object");
  Message message;
  const auto id = json.find("id");
  if (id != json.end() && !id->is_null() && !is_id(*id)) {
    fail(ErrorCode::InvalidRequest, "the `id` of a message must be a number or a string");
  }
  if (id != json.end()) message.id = *id;
  if (const auto method = json.find("method"); method != json.end()) {
    if (!method->is_string() || method->get_ref<const std::string&>().empty()) {
      fail(ErrorCode::InvalidRequest, "the `method` of a message must be a string", message.id);
    }
    message.method = method->get<std::string>();
  } else if (!json.contains("result") && !json.contains("error")) {
    fail(ErrorCode::InvalidRequest, "a message has no `method`", message.id);
  }
  if (auto params = json.find("params"); params != json.end()) message.params = std::move(*params);
  if (auto result = json.find("result"); result != json.end()) message.result = std::move(*result);
  if (auto error = json.find("error"); error != json.end()) message.error = std::move(*error);
  return message;
}

std::string text_of_message(const Json& message) {
  return message.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string with_header(std::string_view text) {
  return fmt::format("Content-Length: {}\r\n\r\n{}", text.size(), text);
}

}  // namespace sdlc::lsp
