#include "tests/lsp/test_client.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "lang/source/source.hpp"
#include "lsp/open_files.hpp"
#include "lsp/positions.hpp"
#include "lsp/uri.hpp"

namespace sdlc::test {
namespace {

std::chrono::seconds patience() {
  const char* seconds = std::getenv("SDLC_TEST_PATIENCE");
  return std::chrono::seconds(seconds == nullptr ? 60 : std::atoi(seconds));
}

/// What the server sends after its header, without the checks of MessageReader.
std::optional<Json> read_json(std::istream& in) {
  std::string line;
  std::size_t size = 0;
  while (std::getline(in, line) && line != "\r") {
    if (line.starts_with("Content-Length: ")) size = std::stoul(line.substr(16));
  }
  std::string content(size, '\0');
  if (!in.read(content.data(), static_cast<std::streamsize>(size))) return std::nullopt;
  return Json::parse(content);
}

}  // namespace

TestClient::TestClient(Silent, const lsp::ServerOptions& options) { start(options); }

TestClient::TestClient(Json capabilities, Json settings, const lsp::ServerOptions& options) {
  start(options);
  result("initialize", {{"processId", nullptr},
                        {"rootUri", lsp::uri_of_path(folder_.path())},
                        {"capabilities", std::move(capabilities)},
                        {"initializationOptions", std::move(settings)}});
  notify("initialized", Json::object());
}

void TestClient::start(lsp::ServerOptions options) {
  options.patience = patience();
  serving_ = std::thread([this, options] {
    lsp::Server server(server_in_, server_out_, log_, options);
    const bool is_well = server.run();
    {
      const std::scoped_lock lock(mutex_);
      ended_well_ = is_well;
    }
    arrived_.notify_all();
  });
  reading_ = std::thread([this] { read_messages(); });
}

TestClient::~TestClient() {
  if (!is_asked_to_exit_) {
    send_request("shutdown", nullptr);
    notify("exit", nullptr);
  }
  to_server_.close();
  serving_.join();
  from_server_.close();
  reading_.join();
}

void TestClient::read_messages() {
  while (std::optional<Json> message = read_json(client_in_)) {
    const std::scoped_lock lock(mutex_);
    const bool is_answer = message->contains("id") && !message->contains("method");
    if (is_answer) {
      const std::int64_t id =
          message->at("id").is_number() ? message->at("id").get<std::int64_t>() : -1;
      answers_[id] = {.result = message->value("result", Json()),
                      .error = message->value("error", Json())};
    } else {
      if (message->at("method") == "textDocument/publishDiagnostics") {
        published_[message->at("params").at("uri")] = message->at("params").at("diagnostics");
      }
      messages_.push_back(std::move(*message));
    }
    arrived_.notify_all();
  }
  const std::scoped_lock lock(mutex_);
  has_ended_ = true;
  arrived_.notify_all();
}

template <typename T>
T TestClient::wait(const std::function<std::optional<T>()>& find, std::string_view what) {
  std::unique_lock lock(mutex_);
  std::optional<T> found;
  const auto deadline = std::chrono::steady_clock::now() + patience();
  while (!(found = find())) {
    if (has_ended_ || arrived_.wait_until(lock, deadline) == std::cv_status::timeout) {
      throw std::runtime_error(fmt::format("waited in vain for {}", what));
    }
  }
  return *std::move(found);
}

void TestClient::write(const std::string& name, std::string_view text) {
  const std::filesystem::path file = path(name);
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

std::string TestClient::path(const std::string& name) const {
  return (std::filesystem::canonical(folder_.path()) / name).string();
}

std::string TestClient::uri(const std::string& name) const { return lsp::uri_of_path(path(name)); }

void TestClient::open(const std::string& name, std::string text) {
  texts_[name] = text;
  versions_[name] = 1;
  notify("textDocument/didOpen", {{"textDocument",
                                   {{"uri", uri(name)},
                                    {"languageId", name.ends_with(".json") ? "json" : "scene"},
                                    {"version", 1},
                                    {"text", std::move(text)}}}});
}

Json TestClient::open_marked(const std::string& name, std::string text) {
  const std::size_t at = text.find('|');
  if (at == std::string::npos) throw std::logic_error("the text has no mark");
  text.erase(at, 1);
  const lang::SourceFile file(name, text);
  const Json position =
      lsp::position_json(file, static_cast<std::uint32_t>(at), lang::PositionEncoding::Utf16);
  open(name, std::move(text));
  return position;
}

void TestClient::change(const std::string& name, std::string text) {
  texts_[name] = text;
  notify("textDocument/didChange",
         {{"textDocument", {{"uri", uri(name)}, {"version", ++versions_[name]}}},
          {"contentChanges", Json::array({{{"text", std::move(text)}}})}});
}

void TestClient::close(const std::string& name) {
  notify("textDocument/didClose", {{"textDocument", {{"uri", uri(name)}}}});
}

void TestClient::notify(std::string_view method, Json params) {
  if (method == "exit") is_asked_to_exit_ = true;
  send_raw(lsp::with_header(lsp::text_of_message(
      {{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}})));
}

std::int64_t TestClient::send_request(std::string_view method, Json params) {
  const std::int64_t id = next_id_++;
  send_raw(lsp::with_header(lsp::text_of_message(
      {{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", std::move(params)}})));
  return id;
}

Answer TestClient::wait_for(std::int64_t id) {
  return wait<Answer>(
      [&]() -> std::optional<Answer> {
        const auto found = answers_.extract(id);
        return found.empty() ? std::nullopt : std::optional(std::move(found.mapped()));
      },
      fmt::format("the answer to request {}", id));
}

Answer TestClient::ask(std::string_view method, Json params) {
  return wait_for(send_request(method, std::move(params)));
}

Json TestClient::result(std::string_view method, Json params) {
  Answer answer = ask(method, std::move(params));
  if (!answer.error.is_null()) {
    throw std::runtime_error(fmt::format("{} failed: {}", method, answer.error.dump()));
  }
  return std::move(answer.result);
}

Json TestClient::at(const std::string& name, const Json& position) const {
  return {{"textDocument", {{"uri", uri(name)}}}, {"position", position}};
}

Json TestClient::result_at(std::string_view method, const std::string& name, const Json& position,
                           Json more) {
  more.update(at(name, position));
  return result(method, std::move(more));
}

Json TestClient::wait_for_message(const std::function<bool(const Json&)>& fits) {
  return wait<Json>(
      [&]() -> std::optional<Json> {
        const auto found = std::ranges::find_if(messages_, fits);
        if (found == messages_.end()) return std::nullopt;
        Json message = std::move(*found);
        messages_.erase(found);
        return message;
      },
      "a message");
}

void TestClient::drop_messages() {
  const std::scoped_lock lock(mutex_);
  messages_.clear();
}

Json TestClient::wait_for_notification(std::string_view method) {
  return wait_for_message([&](const Json& message) { return message.at("method") == method; })
      .at("params");
}

void TestClient::respond(const Json& id, Json result) {
  send_raw(lsp::with_header(
      lsp::text_of_message({{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}})));
}

Json TestClient::diagnostics(const std::string& name,
                             const std::function<bool(const Json&)>& fits) {
  return wait<Json>(
      [&, key = uri(name)]() -> std::optional<Json> {
        const auto found = published_.find(key);
        const Json present = found == published_.end() ? Json::array() : found->second;
        return fits(present) ? std::optional(present) : std::nullopt;
      },
      fmt::format("diagnostics of {}", name));
}

std::vector<std::string> TestClient::codes(const std::string& name) {
  // Code actions wait for the findings of the present text, which are published before.
  const Json first{{"line", 0}, {"character", 0}};
  result("textDocument/codeAction", {{"textDocument", {{"uri", uri(name)}}},
                                     {"range", {{"start", first}, {"end", first}}},
                                     {"context", {{"diagnostics", Json::array()}}}});
  std::vector<std::string> codes;
  const std::scoped_lock lock(mutex_);
  const auto found = published_.find(uri(name));
  if (found == published_.end()) return codes;
  for (const Json& diagnostic : found->second) codes.push_back(diagnostic.value("code", ""));
  return codes;
}

bool TestClient::exit() {
  result("shutdown", nullptr);
  notify("exit", nullptr);
  return wait_for_end();
}

bool TestClient::wait_for_end() {
  is_asked_to_exit_ = true;
  return wait<bool>([&] { return ended_well_; }, "the end of the server");
}

std::string TestClient::apply_edits(std::string text, const Json& edits) {
  std::vector<Json> sorted = edits;
  const lang::SourceFile file("", text);
  const auto begin_of = [&](const Json& edit) {
    return lsp::span_of_json(file, edit.at("range"), lang::PositionEncoding::Utf16).begin;
  };
  std::ranges::stable_sort(sorted, std::greater<>(), begin_of);
  for (const Json& edit : sorted) {
    const lang::Span span =
        lsp::span_of_json(file, edit.at("range"), lang::PositionEncoding::Utf16);
    text.replace(span.begin, span.size(), edit.at("newText").get<std::string>());
  }
  return text;
}

}  // namespace sdlc::test
