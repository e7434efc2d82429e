#include "lsp/client.hpp"

#include <algorithm>

namespace sdlc::lsp {
namespace {

/// The value at the pointer, or null. Whatever the client sends is accepted.
const Json* find(const Json& json, const std::string& pointer) {
  const Json::json_pointer path(pointer);
  return json.contains(path) ? &json.at(path) : nullptr;
}

}  // namespace

Client::Client(Json capabilities) : capabilities_(std::move(capabilities)) {
  if (lists("/general/positionEncodings", "utf-8")) encoding_ = lang::PositionEncoding::Utf8;
}

bool Client::can(const std::string& pointer) const {
  const Json* value = find(capabilities_, pointer);
  return value != nullptr && (value->is_object() || (value->is_boolean() && value->get<bool>()));
}

bool Client::lists(const std::string& pointer, const std::string& text) const {
  const Json* value = find(capabilities_, pointer);
  return value != nullptr && value->is_array() &&
         std::ranges::find(*value, Json(text)) != value->end();
}

}  // namespace sdlc::lsp
