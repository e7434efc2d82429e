#include "lsp/server.hpp"

#include <exception>
#include <optional>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "lsp/methods.hpp"

namespace sdlc::lsp {

Server::Server(std::istream& in, std::ostream& out, Log& log, const ServerOptions& options)
    : reader_(in, log),
      log_(log),
      connection_(out, log),
      session_(connection_, log, options, [this](std::function<void()> task) {
        add({.stop = std::make_shared<lang::StopRequest>(), .task = std::move(task)});
      }) {}

bool Server::run() {
  std::thread handling([this] { handle_messages(); });
  read_messages();
  stop_all();
  handling.join();
  return was_asked_to_exit_ && state_ == State::ShutDown;
}

void Server::read_messages() {
  while (true) {
    try {
      std::optional<Message> message = reader_.next();
      if (!message || !take(std::move(*message))) return;
    } catch (const MalformedMessage& malformed) {
      refuse(malformed);
    }
  }
}

void Server::receive(std::string_view message) {
  log_.received(message);
  try {
    take(parse_message(message));
  } catch (const MalformedMessage& malformed) {
    refuse(malformed);
  }
  std::unique_lock lock(mutex_);
  while (!queue_.empty()) {
    handle_first(lock);
    if (!queue_.empty()) continue;
    lock.unlock();
    session_.run_due();  // it may add tasks
    lock.lock();
  }
}

bool Server::take(Message message) {
  if (message.method == "exit") {
    was_asked_to_exit_ = true;
    return false;
  }
  if (message.method == "$/cancelRequest" && !message.is_request()) {
    if (message.params.is_object() && message.params.contains("id")) {
      cancel(message.params.at("id"));
    }
  } else {
    add({.message = std::move(message), .stop = std::make_shared<lang::StopRequest>()});
  }
  return true;
}

void Server::refuse(const MalformedMessage& malformed) {
  log_.write(fmt::format("malformed message: {}", malformed.reason));
  connection_.fail(malformed.id, malformed.code, malformed.reason);
}

void Server::add(Received received) {
  const std::scoped_lock lock(mutex_);
  if (received.message.is_request()) active_[received.message.id.dump()] = received.stop;
  queue_.push_back(std::move(received));
  arrived_.notify_one();
}

void Server::cancel(const Json& id) {
  const std::scoped_lock lock(mutex_);
  const auto found = active_.find(id.dump());
  if (found != active_.end()) found->second->make();
}

/// No answer is awaited any more, except those to requests before `exit`.
void Server::stop_all() {
  const std::scoped_lock lock(mutex_);
  is_ended_ = true;
  for (const Received& received : queue_) {
    // A client may send `exit` before it has the answer to `shutdown`.
    if (received.message.method == "shutdown") active_.erase(received.message.id.dump());
  }
  for (const auto& [id, stop] : active_) stop->make();
  arrived_.notify_one();
}

void Server::handle_messages() {
  std::unique_lock lock(mutex_);
  while (true) {
    arrived_.wait(lock, [this] { return is_ended_ || !queue_.empty(); });
    if (queue_.empty()) return;
    handle_first(lock);
  }
}

void Server::handle_first(std::unique_lock<std::mutex>& lock) {
  const Received received = std::move(queue_.front());
  queue_.pop_front();
  lock.unlock();
  handle(received);
  lock.lock();
  if (received.message.is_request()) active_.erase(received.message.id.dump());
}

void Server::handle(const Received& received) {
  const Message& message = received.message;
  session_.set_stop(received.stop.get());
  try {
    if (received.task) {
      received.task();
    } else if (message.is_response()) {
      connection_.accept(message);
    } else if (message.is_request()) {
      answer(received);
    } else {
      accept_notification(message);
    }
  } catch (const std::exception& error) {
    log_.write(fmt::format("`{}` failed: {}", message.method, error.what()));
  }
  session_.resume_checks();
}

void Server::answer(const Received& received) {
  const Message& request = received.message;
  try {
    received.stop->is_made() ? throw lang::StopRequested() : refuse_state(request);
    connection_.respond(request.id, result_of(request));
  } catch (const lang::StopRequested&) {
    connection_.fail(request.id, ErrorCode::RequestCancelled, "the request was cancelled");
  } catch (const RequestError& error) {
    connection_.fail(request.id, error.code(), error.what());
  } catch (const Json::exception& error) {
    log_.write(fmt::format("wrong parameters of `{}`: {}", request.method, error.what()));
    connection_.fail(
        request.id, ErrorCode::InvalidParams,
        fmt::format("a parameter of `{}` is missing or has the wrong type", request.method));
  } catch (const std::exception& error) {
    log_.write(fmt::format("`{}` failed: {}", request.method, error.what()));
    connection_.fail(request.id, ErrorCode::InternalError,
                     fmt::format("a defect in sdlc: {}", error.what()));
  }
}

void Server::refuse_state(const Message& request) const {
  const bool is_first = request.method == "initialize";
  if (state_ == State::New && !is_first) {
    throw RequestError(ErrorCode::ServerNotInitialized, "the first request must be `initialize`");
  }
  if (state_ == State::ShutDown || (state_ == State::Running && is_first)) {
    throw RequestError(ErrorCode::InvalidRequest,
                       is_first ? "the server is initialized" : "the server is shut down");
  }
}

Json Server::result_of(const Message& request) {
  const RequestHandler handler = find_request(request.method);
  if (handler == nullptr) {
    throw RequestError(ErrorCode::MethodNotFound,
                       fmt::format("unknown method `{}`", request.method));
  }
  Json result = handler(session_, request.params);
  if (request.method == "initialize") state_ = State::Running;
  if (request.method == "shutdown") state_ = State::ShutDown;
  return result;
}

void Server::accept_notification(const Message& notification) {
  if (state_ != State::Running) return;
  if (const NotificationHandler handler = find_notification(notification.method)) {
    handler(session_, notification.params);
  }
}

}  // namespace sdlc::lsp
