#pragma once

#include <string>
#include <utility>

#include "lang/source/position_encoding.hpp"
#include "lsp/json_rpc.hpp"

namespace sdlc::lsp {

/// What the client can do, as it says in `initialize`.
class Client {
 public:
  Client() = default;
  explicit Client(Json capabilities);

  /// Whether the capability is true: `can("/workspace/configuration")`. A capability that is an
  /// object counts as true. False for anything unknown.
  bool can(const std::string& pointer) const;
  /// Whether the array at `pointer` contains the text.
  bool lists(const std::string& pointer, const std::string& text) const;

  /// UTF-8 if the client offers it, else UTF-16.
  lang::PositionEncoding encoding() const noexcept { return encoding_; }

 private:
  Json capabilities_ = Json::object();
  lang::PositionEncoding encoding_ = lang::PositionEncoding::Utf16;
};

}  // namespace sdlc::lsp
