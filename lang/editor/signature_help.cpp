#include "lang/editor/signature_help.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "lang/ast/ast.hpp"
#include "lang/editor/callee.hpp"
#include "lang/editor/cursor.hpp"
#include "lang/editor/cursor_place.hpp"
#include "lang/schema/property_text.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

using Role = OpenBracket::Role;

/// Builds a signature with the places of its parameters.
class SignatureWriter {
 public:
  SignatureWriter(std::string_view name, std::string documentation)
      : signature_{.label = fmt::format("{}(", name), .documentation = std::move(documentation)} {}

  void add(std::string_view name, std::string_view text, std::string documentation) {
    if (!names_.empty()) signature_.label += ", ";
    const auto begin = static_cast<std::uint32_t>(signature_.label.size());
    signature_.label += text;
    const auto end = static_cast<std::uint32_t>(signature_.label.size());
    signature_.parameters.push_back({{begin, end}, std::move(documentation)});
    names_.push_back(name);
  }
  Signature finish() {
    signature_.label += ')';
    return std::move(signature_);
  }
  const std::vector<std::string_view>& names() const noexcept { return names_; }

 private:
  Signature signature_;
  std::vector<std::string_view> names_;
};

/// "a number, at least 0, default `0`. Blurs the mirror."
std::string documentation_of(const Property& parameter) {
  std::string usual = describe_default(parameter);
  if (!usual.empty() && usual != "required") usual = "default " + usual;
  return fmt::format("{}{}{}. {}", describe_values(parameter), usual.empty() ? "" : ", ", usual,
                     parameter.doc);
}

/// The documentation of an option by its spelling in the signature: "curve: cubic".
std::string documentation_of(const Builtin& function, std::string_view spelling) {
  const std::string_view name = spelling.substr(0, spelling.find(':'));
  const auto option = std::ranges::find(function.options, name, &Property::name);
  return option == function.options.end() ? std::string() : documentation_of(*option);
}

/// The forms in "range(n), range(a, b), range(a, b, step)".
std::vector<Signature> signatures_of(const Builtin& function) {
  std::vector<Signature> all;
  std::string_view rest = function.signature;
  while (!rest.empty()) {
    const std::size_t end = rest.find(')');
    std::string_view inside = rest.substr(function.name.size() + 1, end - function.name.size() - 1);
    SignatureWriter writer(function.name, std::string(function.doc));
    while (!inside.empty()) {
      const std::size_t comma = std::min(inside.find(", "), inside.size());
      const std::string_view spelling = inside.substr(0, comma);
      writer.add({}, spelling, documentation_of(function, spelling));
      inside.remove_prefix(std::min(comma + 2, inside.size()));
    }
    all.push_back(writer.finish());
    rest.remove_prefix(std::min(end + 3, rest.size()));
  }
  return all;
}

/// The parameters that the call names, and the one at the cursor.
struct CallAtCursor {
  const OpenBracket* call;
  std::string_view label;  ///< of the argument at the cursor; may be empty
};

std::size_t index_of(const CallAtCursor& at, const std::vector<std::string_view>& names) {
  const auto index = [&](std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  if (!at.label.empty()) return index(at.label);
  if (at.call->labels.empty()) return at.call->commas;
  // The next argument is named too, probably in order.
  const auto is_given = [&](std::string_view name) {
    return std::ranges::find(at.call->labels, name) != at.call->labels.end();
  };
  std::size_t first =
      at.call->commas - std::min<std::size_t>(at.call->commas, at.call->labels.size());
  while (first < names.size() && is_given(names[first])) ++first;
  return first;
}

void set_active(SignatureHelp& help, std::size_t index) {
  if (index < help.signatures.front().parameters.size()) help.active_parameter = index;
}

SignatureHelp help_for(const Constructor& constructor, const CallAtCursor& at) {
  SignatureWriter writer(constructor.name, std::string(constructor.doc));
  for (const Property& p : constructor.parameters) {
    std::string text(p.name);
    if (!p.default_text.empty()) text += fmt::format(": {}", p.default_text);
    writer.add(p.name, text, documentation_of(p));
  }
  SignatureHelp help{.signatures = {writer.finish()}};
  set_active(help, index_of(at, writer.names()));
  return help;
}

SignatureHelp help_for(const SceneView& view, SymbolId function, std::string_view path,
                       const CallAtCursor& at) {
  SignatureWriter writer(path, view.index().documentation(function));
  for (const SymbolId id : parameters_of(view, function)) {
    const ast::Node node(view.tree(id.file), id.index);
    const std::string_view declared = type_name_of(view, id);
    writer.add(view.index().find(id)->name, node.text(), std::string(declared));
  }
  SignatureHelp help{.signatures = {writer.finish()}};
  set_active(help, index_of(at, writer.names()));
  return help;
}

/// The index of the argument at the cursor.
std::size_t index_of(const CallAtCursor& at, const Builtin& function) {
  const auto option = std::ranges::find(function.options, at.label, &Property::name);
  if (at.label.empty() || option == function.options.end()) return at.call->commas;
  return function.max_arguments + static_cast<std::size_t>(option - function.options.begin());
}

SignatureHelp help_for(const Builtin& function, const CallAtCursor& at) {
  SignatureHelp help{.signatures = signatures_of(function)};
  const std::size_t index = index_of(at, function);
  const auto fits = [&](const Signature& s) { return index < s.parameters.size(); };
  const auto form = std::ranges::find_if(help.signatures, fits);
  const bool is_found = form != help.signatures.end();
  help.active_signature = is_found ? static_cast<std::size_t>(form - help.signatures.begin())
                                   : help.signatures.size() - 1;
  if (is_found) {
    help.active_parameter = index;
  } else if (function.max_arguments == kAnyNumber) {
    help.active_parameter = help.signatures.back().parameters.size() - 1;
  }
  return help;
}

/// The innermost open call; null if the cursor is not in one.
const OpenBracket* find_call(const CursorPlace& place) {
  for (auto open = place.brackets.rbegin(); open != place.brackets.rend(); ++open) {
    if (open->role == Role::Arguments) return &*open;
    if (open->is_block()) return nullptr;
  }
  return nullptr;
}

/// The label that the cursor is in, or that of the argument around it.
std::string_view label_at(const CursorPlace& place, const OpenBracket& call,
                          std::string_view text) {
  if (&call != &place.inner() || place.kind != CursorPlace::Kind::Argument) return call.label;
  const bool is_label = place.word.size() > 0 && has_colon_after(text, place.word.end);
  return is_label ? text.substr(place.word.begin, place.word.size()) : std::string_view();
}

}  // namespace

std::optional<SignatureHelp> signature_help(SceneView& view, std::uint32_t file,
                                            std::uint32_t offset) {
  const CursorPlace place = find_cursor_place(view.tree(file), offset);
  const OpenBracket* call = find_call(place);
  if (call == nullptr) return std::nullopt;
  const std::string_view text = view.file(file).text();
  const std::string_view path = text.substr(call->head.begin, call->head.size());
  const CallAtCursor at{call, label_at(place, *call, text)};
  const Callee callee = find_callee(view, file, path);
  if (callee.constructor != nullptr) return help_for(*callee.constructor, at);
  if (callee.builtin != nullptr) return help_for(*callee.builtin, at);
  if (callee.function.is_known()) return help_for(view, callee.function, path, at);
  return std::nullopt;
}

}  // namespace sdlc::lang
