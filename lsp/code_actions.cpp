#include "lsp/code_actions.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/editor/allow_here.hpp"
#include "lang/editor/fix_edits.hpp"
#include "lang/explain/explain.hpp"
#include "lsp/checked_scene.hpp"
#include "lsp/edits_json.hpp"
#include "lsp/positions.hpp"

namespace sdlc::lsp {
namespace {

using std::chrono::milliseconds;

constexpr std::string_view kQuickFix = "quickfix", kFixAll = "source.fixAll.sdlc";
constexpr std::string_view kNoKind;
/// Nobody chooses from more, and each takes about a millisecond in a large text.
constexpr std::size_t kMaxActions = 50;
constexpr int kAutomatic = 2;  ///< CodeActionTriggerKind: nobody asked, the caret was moved

/// What the client wants.
class Wish {
 public:
  explicit Wish(const Json& context) : known_(context.value("diagnostics", Json::array())) {
    is_automatic_ = context.value("triggerKind", 1) == kAutomatic;
    if (!context.contains("only") || !context.at("only").is_array()) return;
    has_kinds_ = true;
    for (const Json& kind : context.at("only")) kinds_.push_back(kind.get<std::string>());
  }

  /// Whether actions of the kind are wanted: `source` includes `source.fixAll`.
  bool includes(std::string_view kind) const {
    if (!has_kinds_) return true;
    return std::ranges::any_of(kinds_, [&](std::string_view wanted) {
      return wanted.empty() || kind == wanted ||
             (kind.starts_with(wanted) && kind[wanted.size()] == '.');
    });
  }

  /// Whether actions of the kind are wanted, and those that nobody asked for are not.
  bool asks_for(std::string_view kind) const {
    return includes(kind) && (has_kinds_ || !is_automatic_);
  }

  /// The client's own form of a diagnostic at the range; null if it has not sent it.
  Json find(std::string_view code, const Json& range) const {
    for (const Json& each : known_) {
      if (each.value("code", Json()) == code && each.value("range", Json()) == range) return each;
    }
    return nullptr;
  }

 private:
  Json known_;
  bool is_automatic_ = false;
  bool has_kinds_ = false;
  std::vector<std::string> kinds_;
};

class Actions {
 public:
  Actions(Session& session, const Text& text, const Json& params)
      : session_(session),
        text_(text),
        uri_(document_uri(params)),
        range_(session.span(text, params.at("range"))),
        ranges_(session.client().encoding()),
        wish_(params.value("context", Json::object())) {}

  Json list() {
    // Whoever asks may wait for the check. A light bulb is asked for again after it.
    const bool waits = wish_.asks_for(kQuickFix) || wish_.asks_for(kFixAll);
    const milliseconds patience = waits ? session_.server_options().patience : milliseconds(0);
    session_.checks().use_findings(session_.scene_of(text_.identity), patience, session_.stop(),
                                   [this](const CheckedScene& scene) { add(scene); });
    return std::move(actions_);
  }

 private:
  void add(const CheckedScene& scene) {
    bool has_safe_fix = false;
    std::set<std::string_view> explained;
    for (const lang::Diagnostic* found : scene.findings().shown) {
      if (!is_in_text(*found)) continue;
      const std::optional<lang::QuickFix> fix = fixes_.of(*found);
      has_safe_fix |= fix && fix->is_preferred;
      if (!wish_.includes(kQuickFix) || actions_.size() >= kMaxActions) continue;
      const Json known = known_form(*found);
      if (known.is_null() && !touches_range(found->where.span)) continue;
      if (fix) add_fix(*fix, known);
      const auto everywhere = lang::fix_everywhere(*found, scene.findings().shown);
      if (everywhere && !has_action(everywhere->title)) add_fix(*everywhere, known);
      add_allowance(*found, known);
      if (wish_.asks_for(kNoKind)) explained.insert(found->info->code);
    }
    if (has_safe_fix && wish_.asks_for(kFixAll)) add_fix_all();
    for (const std::string_view code : explained) add_explanation(code);
  }

  bool is_in_text(const lang::Diagnostic& found) {
    const lang::SourceFile* const file = found.where.file;
    if (file == nullptr) return false;
    const auto [known, is_new] = is_text_.try_emplace(file);
    if (is_new) known->second = session_.workspace().identity(file->name()) == text_.identity;
    return known->second;
  }
  Json known_form(const lang::Diagnostic& found) {
    return wish_.find(found.info->code, ranges_.range(*found.where.file, found.where.span));
  }
  bool touches_range(lang::Span span) const {
    return span.begin <= range_.end && span.end >= range_.begin;
  }

  bool has_action(const std::string& title) const {
    return std::ranges::any_of(actions_,
                               [&](const Json& action) { return action.at("title") == title; });
  }

  void add_fix(const lang::QuickFix& fix, const Json& known) {
    std::map<std::string, Json> edits;
    for (const lang::FileEdits& each : fix.files) {
      edits[session_.uri_of(*each.file)] = edits_json(session_, *each.file, each.edits);
    }
    Json action{{"title", fix.title}, {"edit", workspace_edit(session_, edits)}};
    if (fix.is_preferred) action["isPreferred"] = true;
    add_quick_fix(std::move(action), known);
  }

  void add_allowance(const lang::Diagnostic& found, const Json& known) {
    const auto* document = dynamic_cast<const lang::Document*>(found.where.file);
    if (document == nullptr) return;
    const auto edit = lang::allow_here(*document, *found.info, found.where.span.begin);
    if (!edit) return;
    const Json edits = edits_json(session_, *document, {&*edit, 1});
    add_quick_fix({{"title", fmt::format("Allow {} here", found.info->code)},
                   {"edit", workspace_edit(session_, {{session_.uri_of(*document), edits}})}},
                  known);
  }

  void add_explanation(std::string_view code) {
    if (!lang::explanation(std::string(code))) return;
    const std::string title = fmt::format("Explain {}", code);
    const Json arguments = Json::array({{{"code", code}, {"show", true}}});
    actions_.push_back(
        {{"title", title},
         {"kind", kNoKind},
         {"command", {{"title", title}, {"command", "sdlc.explain"}, {"arguments", arguments}}}});
  }

  void add_quick_fix(Json action, const Json& known) {
    action["kind"] = kQuickFix;
    if (!known.is_null()) action["diagnostics"] = Json::array({known});
    // Several findings of one place can have the same fix or allowance.
    if (std::ranges::find(actions_, action) == actions_.end()) {
      actions_.push_back(std::move(action));
    }
  }

  void add_fix_all() {
    Json action{{"title", "Fix all safe findings"}, {"kind", kFixAll}};
    const Json document{{"uri", uri_}};
    if (session_.client().lists("/textDocument/codeAction/resolveSupport/properties", "edit")) {
      action["data"] = {{"textDocument", document}};
    } else {
      action["command"] = {
          {"title", "Fix all"}, {"command", "sdlc.fixAll"}, {"arguments", Json::array({document})}};
    }
    actions_.push_back(std::move(action));
  }

  Session& session_;
  const Text& text_;
  const std::string uri_;
  const lang::Span range_;
  FileRanges ranges_;
  const Wish wish_;
  lang::QuickFixes fixes_;
  std::map<const lang::SourceFile*, bool> is_text_;
  Json actions_ = Json::array();
};

}  // namespace

Json list_code_actions(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  return Actions(session, text, params).list();
}

Json resolve_code_action(Session& session, const Json& params) {
  Json action = params;
  const Json data = params.value("data", Json());
  if (!data.is_object()) return action;
  const Json edit = fix_all_edit(session, data);
  if (!edit.is_null()) action["edit"] = edit;
  return action;
}

Json code_action_options() {
  return {{"codeActionKinds", {kQuickFix, kFixAll}}, {"resolveProvider", true}};
}

Json fix_all_edit(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  const auto check = [&](std::string each) {
    auto document = std::make_shared<const lang::Document>(text.source->name(), std::move(each));
    return std::make_unique<CheckedScene>(std::move(document), session.program_options(),
                                          &session.stop());
  };
  const lang::FixAll fixed = lang::fix_all(check(std::string(text.source->text())), check);
  if (fixed.edits.empty()) return nullptr;
  return workspace_edit(
      session, {{session.uri_of(text.identity), edits_json(session, *text.source, fixed.edits)}});
}

}  // namespace sdlc::lsp
