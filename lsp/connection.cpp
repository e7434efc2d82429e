#include "lsp/connection.hpp"

#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace sdlc::lsp {

std::size_t Connection::send(const Json& message) {
  const std::string text = text_of_message(message);
  const std::scoped_lock lock(out_mutex_);
  log_.sent(text);
  out_ << with_header(text) << std::flush;
  return text.size();
}

void Connection::notify(std::string_view method, Json params) {
  send({{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}});
}

void Connection::respond(const Json& id, Json result) {
  // The answer takes ten times its text in memory, which the system gets back.
  constexpr std::size_t kLarge = std::size_t{1} << 20;
  const std::size_t size = send({{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}});
#ifdef __GLIBC__
  if (size > kLarge) malloc_trim(0);
#endif
}

void Connection::fail(const Json& id, ErrorCode code, const std::string& message) {
  send({{"jsonrpc", "2.0"},
        {"id", id},
        {"error", {{"code", static_cast<int>(code)}, {"message", message}}}});
}

void Connection::request(std::string_view method, Json params, OnResult on_result) {
  std::int64_t id = 0;
  {
    const std::scoped_lock lock(requests_mutex_);
    id = next_id_++;
    pending_.emplace(id, std::move(on_result));
  }
  Json message{{"jsonrpc", "2.0"}, {"id", id}, {"method", method}};
  if (!params.is_null()) message["params"] = std::move(params);
  send(message);
}

void Connection::accept(const Message& response) {
  if (!response.id.is_number_integer()) return;
  OnResult on_result;
  {
    const std::scoped_lock lock(requests_mutex_);
    const auto found = pending_.find(response.id.get<std::int64_t>());
    if (found == pending_.end()) return;
    on_result = std::move(found->second);
    pending_.erase(found);
  }
  if (on_result) on_result(response.error.is_null() ? &response.result : nullptr);
}

}  // namespace sdlc::lsp
