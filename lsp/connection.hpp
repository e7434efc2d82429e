#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <ostream>
#include <string>
#include <string_view>

#include "lsp/json_rpc.hpp"
#include "lsp/log.hpp"

namespace sdlc::lsp {

/// The way to the client. Every thread may send. A message is sent at once and whole.
class Connection {
 public:
  /// Called with the result of a request of the server, on the thread that handles messages; a null
  /// pointer if the client reports an error.
  using OnResult = std::function<void(const Json* result)>;

  Connection(std::ostream& out, Log& log) : out_(out), log_(log) {}
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void notify(std::string_view method, Json params);
  /// A message that the editor shows.
  void show(MessageType type, const std::string& text) {
    notify("window/showMessage", {{"type", static_cast<int>(type)}, {"message", text}});
  }
  void respond(const Json& id, Json result);
  void fail(const Json& id, ErrorCode code, const std::string& message);
  /// `params` may be null: there are none.
  void request(std::string_view method, Json params, OnResult on_result = {});

  /// Passes a response of the client to the request that it answers. Responses to unknown requests
  /// are ignored.
  void accept(const Message& response);

 private:
  /// Returns the bytes of the text.
  std::size_t send(const Json& message);

  std::ostream& out_;
  Log& log_;
  std::mutex out_mutex_;
  std::mutex requests_mutex_;
  std::int64_t next_id_ = 1;
  std::map<std::int64_t, OnResult> pending_;
};

}  // namespace sdlc::lsp
