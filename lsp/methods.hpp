#pragma once

#include <span>
#include <string_view>

#include "lsp/json_rpc.hpp"
#include "lsp/session.hpp"

/// The methods that the server knows.
namespace sdlc::lsp {

/// Handles a request: returns its result, or throws RequestError. May throw lang::StopRequested.
using RequestHandler = Json (*)(Session& session, const Json& params);
using NotificationHandler = void (*)(Session& session, const Json& params);

/// The handler of a method; null if the server does not know it.
RequestHandler find_request(std::string_view method) noexcept;
NotificationHandler find_notification(std::string_view method) noexcept;

}  // namespace sdlc::lsp
