#include "cli/web/web_server.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <deque>
#include <exception>
#include <map>
#include <system_error>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <fmt/format.h>

#include "cli/web/random_token.hpp"

namespace sdlc::cli {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using Request = http::request<http::empty_body>;

constexpr std::string_view kSocketName = "live";
constexpr std::chrono::seconds kMaxRequestTime(10), kMaxAnswerTime(60);
constexpr std::uint32_t kMaxHeader = 8 << 10;  // bytes

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

/// In a time that does not depend on where they differ.
bool are_equal(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return difference == 0;
}

/// Whether a Host names this machine, with any port: it may be forwarded.
bool is_loopback(std::string_view host) {
  const std::size_t port = host.rfind(':');
  if (port != std::string_view::npos &&
      host.find_first_not_of("0123456789", port + 1) == std::string_view::npos) {
    host = host.substr(0, port);
  }
  return host == "127.0.0.1" || host == "localhost" || host == "[::1]";
}

/// Answers a request, or goes on as a WebSocket. Lives as long as an operation is pending.
class Connection;

/// What connections share. Used by the thread of the server only.
struct Hub {
  WebServer::Handlers handlers;
  std::string token;
  std::size_t connections = 0;
  std::size_t waiting_bytes = 0;  // of all connections
  WebServer::Viewer last_viewer = 0;
  std::map<WebServer::Viewer, Connection*> viewers;
};

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, Hub& hub) : hub_(hub), socket_(std::move(socket)) {
    ++hub_.connections;
    parser_.header_limit(kMaxHeader);
    parser_.body_limit(0);
  }
  ~Connection() {
    --hub_.connections;
    hub_.waiting_bytes -= waiting_bytes_;
    if (hub_.viewers.erase(viewer_) > 0) hub_.handlers.closed(viewer_);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void start() {
    tcp_stream().expires_after(kMaxRequestTime);
    http::async_read(tcp_stream(), buffer_, parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) return self->answer();
                       if (error == http::error::header_limit || error == http::error::body_limit) {
                         self->refuse(http::status::payload_too_large);
                       }
                     });
  }

  void send(std::string message, bool is_binary) {
    // Not even the pings of a browser that has stopped reading would get through.
    if (queue_.size() >= WebServer::kMaxWaiting) return close();
    const std::size_t bytes = message.size();
    queue_.push_back({std::move(message), is_binary});
    waiting_bytes_ += bytes;
    hub_.waiting_bytes += bytes;
    if (queue_.size() == 1) write_next();
  }
  std::size_t waiting_bytes() const noexcept { return waiting_bytes_; }
  void close() { tcp_stream().close(); }

 private:
  struct Message {
    std::string bytes;
    bool is_binary;
  };

  beast::tcp_stream& tcp_stream() { return socket_.next_layer(); }

  // HTTP

  void answer() {
    const Request& request = parser_.get();
    if (!is_loopback(view(request[http::field::host]))) {
      return refuse(http::status::misdirected_request);
    }
    const std::string_view origin = view(request[http::field::origin]);
    const std::string own = fmt::format("http://{}", view(request[http::field::host]));
    const bool is_socket = websocket::is_upgrade(request);
    // Browsers always tell the origin of a WebSocket; other sites cannot read answers to GET.
    if (origin.empty() ? is_socket : origin != own) return refuse(http::status::forbidden);
    // Newer browsers also tell it for GET. A frame of an editor may navigate to the page.
    if (view(request["Sec-Fetch-Site"]) == "cross-site" &&
        view(request["Sec-Fetch-Mode"]) != "navigate") {
      return refuse(http::status::forbidden);
    }
    std::string_view path = view(request.target());
    if (!path.starts_with('/')) return refuse(http::status::bad_request);
    path.remove_prefix(1);
    const std::size_t end = path.find('/');
    if (end == std::string_view::npos || !are_equal(path.substr(0, end), hub_.token)) {
      return refuse(http::status::not_found);
    }
    path.remove_prefix(end + 1);
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
      return refuse(http::status::method_not_allowed);
    }
    if (path == kSocketName) {
      return is_socket ? upgrade() : refuse(http::status::upgrade_required);
    }
    try {
      std::optional<WebResource> resource =
          hub_.handlers.get({.name = path, .host = view(request[http::field::host])});
      if (!resource) return refuse(http::status::not_found);
      respond(http::status::ok, *std::move(resource));
    } catch (const std::exception&) {
      refuse(http::status::internal_server_error);
    }
  }

  void refuse(http::status status) {
    respond(status,
            {.type = "text/plain", .body = std::string(http::obsolete_reason(status)) + "\n"});
  }

  void respond(http::status status, WebResource resource) {
    auto response = std::make_shared<http::response<http::string_body>>(status, 11);
    response->set(http::field::content_type, resource.type + "; charset=utf-8");
    response->set(http::field::cache_control, "no-store");
    response->set("Referrer-Policy", "no-referrer");
    response->set("X-Content-Type-Options", "nosniff");
    // An editor may show the page in a frame.
    if (resource.policy.empty()) response->set("Cross-Origin-Resource-Policy", "same-origin");
    response->set("Content-Security-Policy",
                  resource.policy.empty() ? "default-src 'none'" : resource.policy);
    response->keep_alive(false);
    const bool has_body = parser_.get().method() != http::verb::head;
    response->content_length(resource.body.size());
    if (has_body) response->body() = std::move(resource.body);
    tcp_stream().expires_after(kMaxAnswerTime);
    http::async_write(tcp_stream(), *response,
                      [self = shared_from_this(), response](beast::error_code, std::size_t) {
                        beast::error_code ignored;
                        self->tcp_stream().socket().shutdown(tcp::socket::shutdown_send, ignored);
                      });
  }

  // WebSocket

  void upgrade() {
    tcp_stream().expires_never();  // the WebSocket has its own timeouts
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(WebServer::kMaxMessage);
    buffer_.clear();
    socket_.async_accept(parser_.get(), [self = shared_from_this()](beast::error_code error) {
      if (!error) self->open();
    });
  }

  void open() {
    viewer_ = ++hub_.last_viewer;
    hub_.viewers.emplace(viewer_, this);
    hub_.handlers.opened(viewer_);
    read_next();
  }

  void read_next() {
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->close();
      const auto bytes = self->buffer_.cdata();
      const std::string_view text(static_cast<const char*>(bytes.data()), bytes.size());
      if (self->socket_.got_text()) self->hub_.handlers.received(self->viewer_, text);
      self->buffer_.clear();
      self->read_next();
    });
  }

  void write_next() {
    socket_.binary(queue_.front().is_binary);
    socket_.async_write(asio::buffer(queue_.front().bytes),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          if (error) return self->close();
                          const std::size_t bytes = self->queue_.front().bytes.size();
                          self->waiting_bytes_ -= bytes;
                          self->hub_.waiting_bytes -= bytes;
                          self->queue_.pop_front();
                          if (!self->queue_.empty()) self->write_next();
                        });
  }

  Hub& hub_;
  websocket::stream<beast::tcp_stream> socket_;  // speaks HTTP first
  beast::flat_buffer buffer_{WebServer::kMaxMessage + kMaxHeader};
  http::request_parser<http::empty_body> parser_;
  std::deque<Message> queue_;  // the first is being written
  std::size_t waiting_bytes_ = 0;
  WebServer::Viewer viewer_ = 0;
};

}  // namespace

class WebServer::Listener {
 public:
  Listener(std::uint16_t port, Handlers handlers) {
    hub_.handlers = std::move(handlers);
    hub_.token = random_token();
    const tcp::endpoint endpoint(asio::ip::address_v4::loopback(), port);
    beast::error_code error;
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
      throw std::system_error(error.value(), std::generic_category(), fmt::format("port {}", port));
    }
    accept();
    thread_ = std::thread([this] {
      while (!context_.stopped()) {
        try {
          context_.run();
        } catch (const std::exception&) {
          // The connection that it is about has no operation any more, and is closed.
        }
      }
    });
  }
  ~Listener() {
    context_.stop();
    thread_.join();
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  std::string url() const {
    return fmt::format("http://127.0.0.1:{}/{}/", acceptor_.local_endpoint().port(), hub_.token);
  }

  void post(std::function<void()> function) { asio::post(context_, std::move(function)); }

  void send(Viewer viewer, std::string message, MessageType type) {
    asio::post(context_, [this, viewer, message = std::move(message), type]() mutable {
      const auto found = hub_.viewers.find(viewer);
      if (found == hub_.viewers.end()) return;
      found->second->send(std::move(message), type == MessageType::Binary);
      if (hub_.waiting_bytes > kMaxWaitingBytes) close_slowest();
    });
  }

 private:
  void close_slowest() {
    const auto slowest = std::ranges::max_element(
        hub_.viewers, {}, [](const auto& viewer) { return viewer.second->waiting_bytes(); });
    if (slowest != hub_.viewers.end()) slowest->second->close();
  }

  void accept() {
    acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
      constexpr std::chrono::milliseconds kPause(100);
      if (error) {  // too many open files
        timer_.expires_after(kPause);
        timer_.async_wait([this](beast::error_code) { accept(); });
        return;
      }
      accept();
      if (hub_.connections < kMaxConnections) {
        beast::error_code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        std::make_shared<Connection>(std::move(socket), hub_)->start();
      }
    });
  }

  Hub hub_;
  asio::io_context context_{1};  // its connections refer to the hub
  tcp::acceptor acceptor_{context_};
  asio::steady_timer timer_{context_};
  std::thread thread_;
};

WebServer::WebServer(std::uint16_t port, Handlers handlers)
    : listener_(std::make_unique<Listener>(port, std::move(handlers))), url_(listener_->url()) {}

WebServer::~WebServer() = default;

void WebServer::post(std::function<void()> function) { listener_->post(std::move(function)); }

void WebServer::send(Viewer viewer, std::string message, MessageType type) {
  listener_->send(viewer, std::move(message), type);
}

}  // namespace sdlc::cli
