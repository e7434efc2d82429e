#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace sdlc::cli {

/// A GET request of TOKEN/name.
struct WebRequest {
  std::string_view name;
  std::string_view host;  ///< as the browser knows this machine: "127.0.0.1:8080"
};

/// The answer to it.
struct WebResource {
  std::string type;  ///< media type: "text/html"
  std::string body;
  std::string policy = {};  ///< its Content-Security-Policy; empty: nothing is loaded
};

/// A web server for the browsers of this machine. It listens on the loopback interface only, and
/// answers only requests that have its token in their path, name this machine as their host (so
/// that no foreign name can be bound to it), and come from its own pages. Messages go both ways by
/// WebSocket (RFC 6455). Connections, their requests and the time that they take are limited.
class WebServer {
 public:
  /// A connected browser window. Numbers are not used again.
  using Viewer = std::uint64_t;
  /// Called on the thread of the server, `closed` also at its end. An exception ends the connection
  /// that it is about; `closed` must not throw.
  struct Handlers {
    /// nullopt: there is nothing of this name.
    std::function<std::optional<WebResource>(const WebRequest& request)> get;
    std::function<void(Viewer viewer)> opened, closed;
    std::function<void(Viewer viewer, std::string_view text)> received;
  };
  static constexpr std::size_t kMaxConnections = 128;
  static constexpr std::size_t kMaxMessage = std::size_t{64} << 10;  ///< bytes, from a browser
  /// The number of messages that may wait until a viewer reads them. A viewer that reads too little
  /// is closed; so is the slowest one when all messages together have more than kMaxWaitingBytes.
  static constexpr std::size_t kMaxWaiting = 1000;
  /// A picture of the largest size, and texts.
  static constexpr std::size_t kMaxWaitingBytes = std::size_t{1} << 30;

  /// Listens on this port, 0: any that is free. Throws std::system_error.
  WebServer(std::uint16_t port, Handlers handlers);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// "http://127.0.0.1:PORT/TOKEN/"
  const std::string& url() const noexcept { return url_; }

  enum class MessageType : std::uint8_t { Text, Binary };
  /// Calls the function on the thread of the server, unless that ends before; its exceptions are
  /// dropped. May be called by any thread.
  void post(std::function<void()> function);
  /// Sends a message to a viewer, unless it is gone. May be called by any thread.
  void send(Viewer viewer, std::string message, MessageType type = MessageType::Text);

 private:
  class Listener;

  std::unique_ptr<Listener> listener_;
  std::string url_;
};

}  // namespace sdlc::cli
