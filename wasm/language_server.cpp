#include <charconv>
#include <chrono>
#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "lsp/log.hpp"
#include "lsp/server.hpp"
#include "wasm/calls.hpp"

namespace sdlc::wasm {
namespace {

/// A server without threads, and what it has sent.
class LanguageServer {
 public:
  Json receive(const std::string& message) {
    server_.receive(message);
    Json messages = messages_of(out_.str());
    out_.str({});
    return messages;
  }

 private:
  /// Each follows a header, lsp::with_header().
  static Json messages_of(std::string_view sent) {
    constexpr std::string_view kLength = "Content-Length: ", kEnd = "\r\n\r\n";
    Json messages = Json::array();
    while (!sent.empty()) {
      std::size_t size = 0;
      const char* const end = sent.data() + sent.size();
      const char* const stop = std::from_chars(sent.data() + kLength.size(), end, size).ptr;
      sent.remove_prefix(static_cast<std::size_t>(stop - sent.data()) + kEnd.size());
      messages.push_back(sent.substr(0, size));
      sent.remove_prefix(size);
    }
    return messages;
  }

  std::istringstream in_;  // it reads nothing
  std::ostringstream out_;
  lsp::Log log_;
  lsp::Server server_{in_,
                      out_,
                      log_,
                      {.limits = kLimits,
                       .version = SDLC_VERSION,
                       .has_threads = false,
                       .patience = std::chrono::milliseconds(0)}};
};

}  // namespace

Json receive(const Json& parameters) {
  static std::optional<LanguageServer> server;
  if (!server) server.emplace();
  return {{"messages", server->receive(parameters.at("message").get<std::string>())}};
}

}  // namespace sdlc::wasm
