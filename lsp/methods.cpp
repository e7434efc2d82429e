#include "lsp/methods.hpp"

#include <algorithm>
#include <array>

#include "lsp/call_hierarchy.hpp"
#include "lsp/code_actions.hpp"
#include "lsp/code_lenses.hpp"
#include "lsp/colors.hpp"
#include "lsp/commands.hpp"
#include "lsp/completion.hpp"
#include "lsp/folding_and_selection.hpp"
#include "lsp/formatting.hpp"
#include "lsp/hover.hpp"
#include "lsp/inlay_hints.hpp"
#include "lsp/lifecycle.hpp"
#include "lsp/navigation.hpp"
#include "lsp/rename.hpp"
#include "lsp/semantic_tokens.hpp"
#include "lsp/symbols.hpp"
#include "lsp/text_sync.hpp"

namespace sdlc::lsp {
namespace {

template <typename Handler>
struct Method {
  std::string_view name;
  Handler handler;
};

constexpr auto kRequests = std::to_array<Method<RequestHandler>>({
    {"initialize", initialize},
    {"shutdown", shut_down},
    {"textDocument/completion", completion},
    {"completionItem/resolve", resolve_completion},
    {"textDocument/signatureHelp", signature_help},
    {"textDocument/definition", go_to_definition},
    {"textDocument/declaration", go_to_declaration},
    {"textDocument/references", find_references},
    {"textDocument/documentHighlight", highlight},
    {"textDocument/documentLink", list_links},
    {"textDocument/prepareRename", prepare_rename},
    {"textDocument/rename", rename},
    {"textDocument/documentSymbol", list_document_symbols},
    {"workspace/symbol", find_workspace_symbols},
    {"textDocument/foldingRange", list_folding_ranges},
    {"textDocument/selectionRange", list_selection_ranges},
    {"textDocument/prepareCallHierarchy", prepare_call_hierarchy},
    {"callHierarchy/incomingCalls", list_incoming_calls},
    {"callHierarchy/outgoingCalls", list_outgoing_calls},
    {"textDocument/hover", hover},
    {"textDocument/documentColor", document_color},
    {"textDocument/colorPresentation", color_presentation},
    {"textDocument/semanticTokens/full", semantic_tokens_full},
    {"textDocument/semanticTokens/full/delta", semantic_tokens_delta},
    {"textDocument/semanticTokens/range", semantic_tokens_range},
    {"textDocument/inlayHint", inlay_hint},
    {"textDocument/codeLens", code_lens},
    {"textDocument/codeAction", list_code_actions},
    {"codeAction/resolve", resolve_code_action},
    {"textDocument/formatting", format_document},
    {"textDocument/rangeFormatting", format_lines},
    {"textDocument/onTypeFormatting", format_while_typing},
    {"workspace/executeCommand", execute_command},
});

constexpr auto kNotifications = std::to_array<Method<NotificationHandler>>({
    {"initialized", initialized},
    {"textDocument/didOpen", did_open},
    {"textDocument/didChange", did_change},
    {"textDocument/didClose", did_close},
    {"textDocument/didSave", did_save},
    {"workspace/didChangeConfiguration", did_change_configuration},
    {"workspace/didChangeWatchedFiles", did_change_watched_files},
    {"workspace/didChangeWorkspaceFolders", did_change_workspace_folders},
    {"window/workDoneProgress/cancel", cancel_progress},
    {"sdlc/cursor", cursor_moved},
    {"$/setTrace", set_trace},
});

template <typename Handler, std::size_t n>
Handler find(const std::array<Method<Handler>, n>& methods, std::string_view name) noexcept {
  const auto found = std::ranges::find(methods, name, &Method<Handler>::name);
  return found == methods.end() ? nullptr : found->handler;
}

}  // namespace

RequestHandler find_request(std::string_view method) noexcept { return find(kRequests, method); }

NotificationHandler find_notification(std::string_view method) noexcept {
  return find(kNotifications, method);
}

}  // namespace sdlc::lsp
