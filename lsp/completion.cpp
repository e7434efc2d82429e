#include "lsp/completion.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/editor/completion.hpp"
#include "lang/editor/config_completion.hpp"
#include "lang/editor/hover.hpp"
#include "lang/editor/signature_help.hpp"
#include "lang/explain/explain.hpp"
#include "lang/source/sandbox.hpp"
#include "lsp/positions.hpp"

namespace sdlc::lsp {
namespace {

namespace fs = std::filesystem;

/// CompletionItemKind of the protocol.
int kind_number(lang::CompletionKind kind) {
  switch (kind) {
    case lang::CompletionKind::Function: return 3;
    case lang::CompletionKind::Constructor: return 4;
    case lang::CompletionKind::Component: return 5;  // Field
    case lang::CompletionKind::Variable: return 6;
    case lang::CompletionKind::ObjectKind: return 7;  // Class
    case lang::CompletionKind::Module: return 9;
    case lang::CompletionKind::Property: return 10;
    case lang::CompletionKind::Unit: return 11;
    case lang::CompletionKind::Literal: return 12;  // Value
    case lang::CompletionKind::Keyword: return 14;
    case lang::CompletionKind::Snippet: return 15;
    case lang::CompletionKind::Color: return 16;
    case lang::CompletionKind::File: return 17;
    case lang::CompletionKind::Folder: return 19;
    case lang::CompletionKind::Word: return 20;  // EnumMember
    case lang::CompletionKind::Code: return 21;  // Constant
    case lang::CompletionKind::Type: return 22;  // Struct
  }
  return 1;
}

/// Documentation as Markdown or, for other clients, as plain text.
Json documentation_json(const std::string& markdown, bool has_markdown) {
  if (has_markdown) return {{"kind", "markdown"}, {"value", markdown}};
  return lang::to_plain_text(markdown);
}

/// What the client can do with completions.
struct CompletionClient {
  explicit CompletionClient(const Client& client)
      : has_snippets(client.can(kItem + "/snippetSupport")),
        has_markdown(client.lists(kItem + "/documentationFormat", "markdown")),
        has_insert_and_replace(client.can(kItem + "/insertReplaceSupport")),
        has_default_range(client.lists(kList + "/itemDefaults", "editRange")) {}

  inline static const std::string kItem = "/textDocument/completion/completionItem";
  inline static const std::string kList = "/textDocument/completion/completionList";
  bool has_snippets, has_markdown, has_insert_and_replace;
  bool has_default_range;  ///< the list may give the range that its items replace
};

class CompletionJson {
 public:
  CompletionJson(Session& session, const Text& text, std::uint32_t offset)
      : session_(session), text_(text), offset_(offset), client_(session.client()) {}

  Json of(const lang::CompletionList& list) {
    Json json{{"isIncomplete", list.is_incomplete}};
    if (client_.has_default_range && !list.items.empty()) {
      default_range_ = list.items.front().replaced;
      const Json edit = place(*default_range_);
      json["itemDefaults"] = {{"editRange", edit.contains("range") ? edit.at("range") : edit}};
    }
    Json items = Json::array();
    for (const lang::CompletionItem& item : list.items) items.push_back(of(item, items.size()));
    json["items"] = std::move(items);
    return json;
  }

 private:
  Json of(const lang::CompletionItem& item, std::size_t index) {
    const bool is_snippet = client_.has_snippets && !item.snippet.empty();
    Json json{{"label", item.label},
              {"kind", kind_number(item.kind)},
              {"sortText", fmt::format("{:04}", index)}};
    const std::string& text = is_snippet ? item.snippet : item.text;
    if (item.replaced != default_range_) {
      json["textEdit"] = place(item.replaced);
      json["textEdit"]["newText"] = text;
    } else if (text != item.label) {
      json["textEditText"] = text;
    }
    if (is_snippet) json["insertTextFormat"] = 2;
    if (!item.filter.empty()) json["filterText"] = item.filter;
    if (!item.detail.empty()) json["detail"] = item.detail;
    if (!item.documentation.empty()) {
      json["documentation"] = documentation_json(item.documentation, client_.has_markdown);
    }
    if (item.kind == lang::CompletionKind::Code) json["data"] = {{"code", item.label}};
    return json;
  }

  /// An edit of the span, without its text.
  Json place(lang::Span span) {
    if (!client_.has_insert_and_replace || span.end <= offset_) return {{"range", range(span)}};
    return {{"insert", range({span.begin, offset_})}, {"replace", range(span)}};
  }

  /// The items have few different ranges.
  const Json& range(lang::Span span) {
    const auto [found, is_new] = ranges_.try_emplace({span.begin, span.end});
    if (is_new) found->second = session_.range(*text_.source, span);
    return found->second;
  }

  Session& session_;
  const Text& text_;
  const std::uint32_t offset_;
  const CompletionClient client_;
  std::optional<lang::Span> default_range_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Json> ranges_;
};

/// The contents of a folder that the scene may read.
std::vector<lang::FolderEntry> list_folder(Session& session, const std::string& root,
                                           const fs::path& folder) {
  if (session.program_options().is_sandboxed &&
      !lang::Sandbox(session.workspace(), root).resolve(folder)) {
    return {};
  }
  return session.workspace().list(folder);
}

std::string trigger_of(const Json& params) {
  const Json context = params.value("context", Json::object());
  return context.is_object() ? context.value("triggerCharacter", "") : "";
}

/// Whether a character that the user typed asks for completions here. A space does so only after
/// the colon of a property.
bool is_asked(std::string_view trigger, std::string_view before) {
  return trigger != " " || before.ends_with(": ");
}

bool is_file(const lang::CompletionItem& item) {
  return item.kind == lang::CompletionKind::File || item.kind == lang::CompletionKind::Folder;
}

lang::CompletionList complete(Session& session, const Text& text, std::uint32_t offset,
                              std::string_view trigger) {
  if (!text.is_scene()) return lang::complete_config(*text.source, offset);
  const std::string& root = text.view->root().name();
  lang::CompletionList list =
      lang::complete(*text.view, text.file, offset,
                     [&](const fs::path& folder) { return list_folder(session, root, folder); });
  // Quotes and slashes are typed in other places too.
  if (trigger == "\"" || trigger == "/") {
    std::erase_if(list.items, [](const auto& item) { return !is_file(item); });
  }
  return list;
}

Json signature_json(const lang::Signature& signature, const Client& client) {
  const std::string information = "/textDocument/signatureHelp/signatureInformation";
  const bool has_markdown = client.lists(information + "/documentationFormat", "markdown");
  Json parameters = Json::array();
  for (const lang::ParameterHelp& parameter : signature.parameters) {
    parameters.push_back(
        {{"label", signature.label.substr(parameter.where.begin, parameter.where.size())}});
    if (parameter.documentation.empty()) continue;
    parameters.back()["documentation"] = documentation_json(parameter.documentation, has_markdown);
  }
  Json json{{"label", signature.label}, {"parameters", std::move(parameters)}};
  if (!signature.documentation.empty()) {
    json["documentation"] = documentation_json(signature.documentation, has_markdown);
  }
  return json;
}

}  // namespace

Json completion(Session& session, const Json& params) {
  session.pause_checks();
  const Text text = session.text_of(params);
  const std::uint32_t offset = session.offset(text, params.at("position"));
  const std::string trigger = trigger_of(params);
  if (!is_asked(trigger, text.source->text().substr(0, offset))) return nullptr;
  const lang::CompletionList list = complete(session, text, offset, trigger);
  return CompletionJson(session, text, offset).of(list);
}

Json resolve_completion(Session& session, const Json& item) {
  Json resolved = item;
  const Json data = item.value("data", Json::object());
  const std::string code = data.is_object() ? data.value("code", "") : "";
  if (const auto page = lang::explanation(code)) {
    const CompletionClient client(session.client());
    resolved["documentation"] = documentation_json(std::string(*page), client.has_markdown);
  }
  return resolved;
}

Json signature_help(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  if (!text.is_scene()) return nullptr;
  const std::uint32_t offset = session.offset(text, params.at("position"));
  const auto help = lang::signature_help(*text.view, text.file, offset);
  if (!help) return nullptr;
  Json signatures = Json::array();
  for (const lang::Signature& signature : help->signatures) {
    signatures.push_back(signature_json(signature, session.client()));
  }
  Json json{{"signatures", std::move(signatures)}, {"activeSignature", help->active_signature}};
  // A number past the last parameter: none is active.
  json["activeParameter"] =
      help->active_parameter.value_or(help->signatures[help->active_signature].parameters.size());
  return json;
}

Json completion_options() {
  return {{"triggerCharacters", {".", ":", "(", "\"", "/", "#", " "}}, {"resolveProvider", true}};
}

Json signature_help_options() {
  return {{"triggerCharacters", {"(", ","}}, {"retriggerCharacters", {":", ")"}}};
}

}  // namespace sdlc::lsp
