#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <istream>
#include <map>
#include <mutex>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "lsp/json_rpc.hpp"
#include "lsp/server.hpp"
#include "tests/lsp/message_stream.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {

using Json = lsp::Json;

/// A response to a request of a test.
struct Answer {
  Json result = nullptr;
  Json error = nullptr;
};

/// A client with a server in the same process, and a folder for files. A wait that lasts for a
/// minute fails the test: SDLC_TEST_PATIENCE is another number of seconds.
class TestClient {
 public:
  /// Does not say `initialize`.
  struct Silent {
    explicit Silent() = default;
  };
  explicit TestClient(Silent, const lsp::ServerOptions& options = {});
  /// Says `initialize` with these capabilities and options, and `initialized`.
  explicit TestClient(Json capabilities = Json::object(), Json settings = Json::object(),
                      const lsp::ServerOptions& options = {});
  /// Says `shutdown` and `exit`, unless the test did.
  ~TestClient();

  // Files

  /// Writes a file of the folder.
  void write(const std::string& name, std::string_view text);
  std::string path(const std::string& name) const;
  std::string uri(const std::string& name) const;
  /// Opens a text in the editor, whether it is on disk or not.
  void open(const std::string& name, std::string text);
  /// Opens a text with a `|` at the cursor, which is returned as a position.
  Json open_marked(const std::string& name, std::string text);
  /// Replaces an open text.
  void change(const std::string& name, std::string text);
  void close(const std::string& name);
  const std::string& text(const std::string& name) const { return texts_.at(name); }

  // Messages

  void notify(std::string_view method, Json params);
  /// Waits for the response.
  Answer ask(std::string_view method, Json params);
  /// The result of a request that must succeed.
  Json result(std::string_view method, Json params);
  /// The same about a position of a file.
  Json result_at(std::string_view method, const std::string& name, const Json& position,
                 Json more = Json::object());
  /// The parameters of a request about a position of a file.
  Json at(const std::string& name, const Json& position) const;
  std::int64_t send_request(std::string_view method, Json params);
  Answer wait_for(std::int64_t id);
  void send_raw(std::string_view bytes) { to_server_.write(bytes); }
  /// The next message that fits, requests of the server among them; messages before it are kept.
  Json wait_for_message(const std::function<bool(const Json&)>& fits);
  Json wait_for_notification(std::string_view method);
  /// Drops the messages that are kept.
  void drop_messages();
  void respond(const Json& id, Json result);

  /// The diagnostics of a file once they fit; waits for them.
  Json diagnostics(const std::string& name, const std::function<bool(const Json&)>& fits);
  /// Codes of the present diagnostics of a file, after all changes so far have been checked.
  std::vector<std::string> codes(const std::string& name);

  /// Says `exit`; whether the server ended as it should.
  bool exit();
  void end_input() { to_server_.close(); }
  bool wait_for_end();

  /// The text after edits of the protocol, in UTF-16 positions.
  static std::string apply_edits(std::string text, const Json& edits);

 private:
  void start(lsp::ServerOptions options);
  void read_messages();
  template <typename T>
  T wait(const std::function<std::optional<T>()>& find, std::string_view what);

  TemporaryFolder folder_;
  MessageStream to_server_, from_server_;
  std::istream server_in_{&to_server_};
  std::ostream server_out_{&from_server_};
  std::istream client_in_{&from_server_};
  lsp::Log log_;
  std::thread serving_, reading_;
  bool is_asked_to_exit_ = false;
  std::optional<bool> ended_well_;
  std::map<std::string, std::string> texts_;
  std::map<std::string, int> versions_;

  std::mutex mutex_;
  std::condition_variable arrived_;
  std::int64_t next_id_ = 1;
  std::map<std::int64_t, Answer> answers_;
  std::deque<Json> messages_;              // requests and notifications of the server
  std::map<std::string, Json> published_;  // the last diagnostics, by URI
  bool has_ended_ = false;
};

}  // namespace sdlc::test
