#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "lsp/json_rpc.hpp"
#include "lsp/uri.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;
using lsp::Json;
using testing::HasSubstr;
using testing::IsEmpty;

/// `sdlc lsp` as an editor starts it: a process, with two pipes.
class RunningServer {
 public:
  explicit RunningServer(const std::string& options = "") {
    ::mkfifo((folder_ / "in").c_str(), 0600);
    ::mkfifo((folder_ / "out").c_str(), 0600);
    process_ = std::thread([this, options] {
      result_ = run_shell(folder_.path(), "$SDLC lsp " + options + " <in >out");
    });
    to_server_.open(folder_ / "in");
    from_server_.open(folder_ / "out");
  }
  ~RunningServer() { end(); }
  RunningServer(const RunningServer&) = delete;
  RunningServer& operator=(const RunningServer&) = delete;

  const TemporaryFolder& folder() const { return folder_; }

  void write(const std::string& text) { to_server_ << text << std::flush; }
  void send(const Json& message) { write(lsp::with_header(message.dump())); }
  void notify(const std::string& method, const Json& params) {
    send({{"jsonrpc", "2.0"}, {"method", method}, {"params", params}});
  }
  /// The result of a request.
  Json ask(const std::string& method, const Json& params = Json::object()) {
    send({{"jsonrpc", "2.0"}, {"id", 1}, {"method", method}, {"params", params}});
    while (const auto message = reader_.next()) {
      if (!message->is_response() || message->id != 1) continue;
      EXPECT_EQ(message->error, nullptr);
      return message->result;
    }
    ADD_FAILURE() << method << " is not answered";
    return nullptr;
  }
  /// The parameters of the next such notification.
  Json wait_for(const std::string& method) {
    while (const auto message = reader_.next()) {
      if (message->method == method) return message->params;
    }
    ADD_FAILURE() << method << " does not come";
    return nullptr;
  }

  void initialize() {
    ask("initialize", {{"processId", nullptr},
                       {"rootUri", lsp::uri_of_path(folder_.path())},
                       {"capabilities", Json::object()}});
    notify("initialized", Json::object());
  }
  void open(const std::string& name, const std::string& text) {
    notify("textDocument/didOpen",
           {{"textDocument",
             {{"uri", uri_of(name)}, {"languageId", "sdlc"}, {"version", 1}, {"text", text}}}});
  }
  std::string uri_of(const std::string& name) const { return lsp::uri_of_path(folder_ / name); }

  /// Closes the pipe to the server, and waits for its end.
  const ProgramResult& end() {
    to_server_.close();
    while (from_server_.is_open() && from_server_.get() != EOF) continue;
    if (process_.joinable()) process_.join();
    return result_;
  }

 private:
  const TemporaryFolder folder_;
  std::thread process_;
  std::ofstream to_server_;
  std::ifstream from_server_;
  lsp::Log log_;
  lsp::MessageReader reader_{from_server_, log_};
  ProgramResult result_;
};

TEST(LspCommand, SucceedsAfterShutdownAndExit) {
  RunningServer server;
  server.initialize();
  EXPECT_EQ(server.ask("shutdown"), nullptr);
  server.notify("exit", nullptr);
  EXPECT_EQ(server.end().exit_code, 0);
  EXPECT_THAT(server.end().err, IsEmpty());
}

TEST(LspCommand, FailsIfTheClientGoesAway) {
  RunningServer server;
  server.initialize();
  EXPECT_EQ(server.end().exit_code, 1);
  EXPECT_THAT(server.end().err, IsEmpty());
}

TEST(LspCommand, FailsAfterExitWithoutShutdown) {
  RunningServer server;
  server.initialize();
  server.notify("exit", nullptr);
  EXPECT_EQ(server.end().exit_code, 1);
}

TEST(LspCommand, EndsWithHalfAMessage) {
  RunningServer server;
  server.initialize();
  server.write("Content-Length: 1000\r\n\r\n{\"jsonrpc\"");
  EXPECT_EQ(server.end().exit_code, 1);
}

TEST(LspCommand, AppendsToItsLog) {
  RunningServer server("--log log.txt");
  std::ofstream(server.folder() / "log.txt") << "an older line\n";
  server.initialize();
  server.write("Content-Length: 3\r\n\r\n{,}");
  server.end();
  const std::string log = content_of(server.folder() / "log.txt");
  EXPECT_THAT(log, testing::StartsWith("an older line\n"));
  EXPECT_THAT(log, HasSubstr("malformed message"));
}

TEST(LspCommand, RefusesALogThatCannotBeWritten) {
  const TemporaryFolder folder;
  const ProgramResult result = run_shell(folder.path(), "$SDLC lsp --log missing/log.txt");
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_THAT(result.err, HasSubstr("missing/log.txt"));
  EXPECT_THAT(result.out, IsEmpty());
}

TEST(LspCommand, PublishesDiagnosticsOfAnUnsavedText) {
  RunningServer server;
  server.initialize();
  server.open("new.scene", "scene 1\nlet a = b\n");
  const Json published = server.wait_for("textDocument/publishDiagnostics");
  EXPECT_EQ(published["uri"], server.uri_of("new.scene"));
  EXPECT_EQ(published["diagnostics"].at(0)["range"]["start"]["line"], 1);
}

TEST(LspCommand, RendersWithItsOwnProgram) {
  RunningServer server;
  server.initialize();
  const std::string text =
      "scene 1\n"
      "render { width: 4, height: 2, samples: 1 }\n"
      "background { color: white }\n"
      "camera { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
      "sphere { center: (0, 0, 0), radius: 1, material: diffuse(color: tan) }\n";
  std::ofstream(server.folder() / "small.scene") << text;
  server.open("small.scene", text);
  server.ask(
      "workspace/executeCommand",
      {{"command", "sdlc.render"}, {"arguments", {{{"uri", server.uri_of("small.scene")}}}}});
  const std::string message = server.wait_for("window/showMessage")["message"];
  const std::string start = "The picture of small.scene is ";
  ASSERT_THAT(message, testing::StartsWith(start));
  const fs::path picture = message.substr(start.size());
  EXPECT_THAT(content_of(picture), testing::StartsWith("\x89PNG"));
  server.end();
  EXPECT_FALSE(fs::exists(picture));
}

}  // namespace
}  // namespace sdlc::test
