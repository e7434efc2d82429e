#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "lsp/json_rpc.hpp"

namespace sdlc::lsp {

class Session;

/// The last results of `textDocument/semanticTokens/full`, from which the next ones differ.
class SemanticResults {
 public:
  static constexpr std::size_t kMaxTexts = 8;

  using Numbers = std::vector<std::uint32_t>;

  /// Replaces the result of the text. Returns its id.
  std::string add(const std::string& uri, Numbers numbers);
  /// The result with this id, if it is the last one of the text; else null.
  const Numbers* find(const std::string& uri, const std::string& id) const;

 private:
  struct Result {
    std::string uri, id;
    Numbers numbers;
  };

  std::deque<Result> results_;  // the last used one is the last
  std::uint64_t next_id_ = 1;
};

/// The server's capability, with the legend.
Json semantic_tokens_options();

/// `textDocument/semanticTokens/full`, `…/full/delta` and `…/range`. A client that augments its
/// syntax highlighting gets only the tokens that need the meaning of names.
Json semantic_tokens_full(Session& session, const Json& params);
Json semantic_tokens_delta(Session& session, const Json& params);
Json semantic_tokens_range(Session& session, const Json& params);

}  // namespace sdlc::lsp
