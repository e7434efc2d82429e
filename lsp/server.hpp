#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <istream>
#include <map>
#include <memory>
#include <mutex>
#include <ostream>
#include <string>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lsp/connection.hpp"
#include "lsp/json_rpc.hpp"
#include "lsp/log.hpp"
#include "lsp/session.hpp"
#include "lsp/settings.hpp"

namespace sdlc::lsp {

/// A language server on two streams. One thread reads messages, another handles them in their
/// order; checks run on a third. A request is cancelled as soon as its cancellation is read.
class Server {
 public:
  Server(std::istream& in, std::ostream& out, Log& log, const ServerOptions& options);
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Serves until the client says `exit`, or the input ends. Whether the client asked for it, with
  /// `shutdown` and then `exit`.
  bool run();

  /// Without threads (ServerOptions) instead of run(): handles the JSON text of a message and does
  /// all work that follows from it.
  void receive(std::string_view message);

 private:
  struct Received {
    Message message = {};
    std::shared_ptr<lang::StopRequest> stop = {};
    std::function<void()> task = {};  ///< instead of a message
  };
  enum class State { New, Running, ShutDown };

  // On the thread that reads
  void read_messages();
  /// False if the client says `exit`.
  bool take(Message message);
  void refuse(const MalformedMessage& malformed);
  void add(Received received);
  void cancel(const Json& id);
  void stop_all();

  // On the thread that handles messages
  void handle_messages();
  void handle_first(std::unique_lock<std::mutex>& lock);
  void handle(const Received& received);
  void answer(const Received& received);
  Json result_of(const Message& request);
  void refuse_state(const Message& request) const;
  void accept_notification(const Message& notification);

  MessageReader reader_;
  Log& log_;
  Connection connection_;
  State state_ = State::New;  // of the thread that handles messages

  std::mutex mutex_;  // for everything down to `is_ended_`
  std::condition_variable arrived_;
  std::deque<Received> queue_;
  std::map<std::string, std::shared_ptr<lang::StopRequest>> active_;  // by id
  bool is_ended_ = false;                                             // no message follows
  bool was_asked_to_exit_ = false;

  Session session_;  // last: its threads add tasks to the queue
};

}  // namespace sdlc::lsp
