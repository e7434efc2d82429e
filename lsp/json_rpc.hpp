#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "lsp/log.hpp"

/// The language server: the Language Server Protocol 3.17 over JSON-RPC 2.0.
namespace sdlc::lsp {

using Json = nlohmann::json;

/// Of a message that the editor shows.
enum class MessageType : int { Error = 1, Warning = 2, Info = 3 };

/// Error codes of JSON-RPC and of the protocol.
enum class ErrorCode : int {
  ParseError = -32700,
  InvalidRequest = -32600,
  MethodNotFound = -32601,
  InvalidParams = -32602,
  InternalError = -32603,
  ServerNotInitialized = -32002,
  RequestFailed = -32803,
  ServerCancelled = -32802,
  ContentModified = -32801,
  RequestCancelled = -32800,
};

/// The answer to a request that cannot be fulfilled. The message is for the user.
class RequestError : public std::runtime_error {
 public:
  RequestError(ErrorCode code, const std::string& message)
      : std::runtime_error(message), code_(code) {}

  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

/// The URI that `params.textDocument` names. Throws RequestError (InvalidParams) if there is none.
const std::string& document_uri(const Json& params);

/// A message from the client: a request, a notification, or a response to a request of the server.
struct Message {
  Json id = nullptr;   ///< a number or string; null for notifications
  std::string method;  ///< empty: a response
  Json params = nullptr;
  Json result = nullptr;  ///< of a response
  Json error = nullptr;   ///< of a response

  bool is_request() const noexcept { return !method.empty() && !id.is_null(); }
  bool is_response() const noexcept { return method.empty(); }
};

/// A message that cannot be read. Reading can continue with the next one.
struct MalformedMessage {
  ErrorCode code;
  std::string reason;
  Json id = nullptr;  ///< of the message, if it is known
};

/// Reads messages: header lines, an empty line, and as many bytes of JSON as `Content-Length` says.
/// After a malformed header, it searches for the next line that begins with `Content-Length`.
class MessageReader {
 public:
  static constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30;  ///< of one message

  MessageReader(std::istream& in, Log& log) : in_(in), log_(log) {}

  /// The next message; nullopt at the end of the stream, also in the middle of a message. Throws
  /// MalformedMessage.
  std::optional<Message> next();

 private:
  std::optional<std::uint64_t> read_header();
  std::optional<std::string> read_line();

  std::istream& in_;
  Log& log_;
};

/// Max nested arrays and objects of a message: copies and destruction of JSON are recursive.
inline constexpr int kMaxMessageDepth = 256;

/// The message of a JSON text. Throws MalformedMessage.
Message parse_message(std::string_view text);

/// The text of a message. Bytes that are not UTF-8 are replaced.
std::string text_of_message(const Json& message);
/// The text after its header.
std::string with_header(std::string_view text);

}  // namespace sdlc::lsp
