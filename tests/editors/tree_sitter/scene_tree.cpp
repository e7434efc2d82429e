#include "tests/editors/tree_sitter/scene_tree.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

#include "tests/support/temporary_folder.hpp"

extern "C" const TSLanguage* tree_sitter_sdlc();

namespace sdlc::test {
namespace {

lang::Span span_of(TSNode node) { return {ts_node_start_byte(node), ts_node_end_byte(node)}; }

std::unordered_set<std::string> words_of(std::string_view pattern) {
  if (!pattern.starts_with("^(") || !pattern.ends_with(")$")) {
    throw std::runtime_error("not a list of names: " + std::string(pattern));
  }
  std::unordered_set<std::string> words;
  std::istringstream list{std::string(pattern.substr(2, pattern.size() - 4))};
  for (std::string word; std::getline(list, word, '|');) words.insert(word);
  return words;
}

constexpr TSSymbol kErrorSymbol = static_cast<TSSymbol>(-1);

bool is_wrong(TSNode node) {
  return ts_node_is_missing(node) || ts_node_symbol(node) == kErrorSymbol;
}

/// The first wrong node of a subtree that has one.
TSNode first_wrong(TSNode node) {
  while (!is_wrong(node)) {
    std::uint32_t i = 0;
    while (i + 1 < ts_node_child_count(node) && !ts_node_has_error(ts_node_child(node, i))) ++i;
    if (ts_node_child_count(node) == 0) break;
    node = ts_node_child(node, i);
  }
  return node;
}

TSPoint point_of(std::string_view text, std::uint32_t at) {
  const std::string_view before = text.substr(0, at);
  const std::size_t line = before.find_last_of('\n') + 1;
  return {static_cast<std::uint32_t>(std::ranges::count(before, '\n')),
          at - static_cast<std::uint32_t>(line)};
}

}  // namespace

SceneTree::SceneTree(std::string_view text) : text_(text) { parse(nullptr); }

SceneTree::SceneTree(const SceneTree& old, std::string_view text, lang::Span replaced,
                     std::uint32_t size)
    : text_(text) {
  const std::unique_ptr<TSTree, Deleter> edited(ts_tree_copy(old.tree_.get()));
  const std::uint32_t end = replaced.begin + size;
  const TSInputEdit edit{
      .start_byte = replaced.begin,
      .old_end_byte = replaced.end,
      .new_end_byte = end,
      .start_point = point_of(text, replaced.begin),
      .old_end_point = point_of(old.text_, replaced.end),
      .new_end_point = point_of(text, end),
  };
  ts_tree_edit(edited.get(), &edit);
  parse(edited.get());
}

void SceneTree::parse(const TSTree* old) {
  const std::unique_ptr<TSParser, Deleter> parser(ts_parser_new());
  if (!ts_parser_set_language(parser.get(), tree_sitter_sdlc())) {
    throw std::runtime_error("this libtree-sitter does not read the ABI of parser.c");
  }
  tree_.reset(ts_parser_parse_string(parser.get(), old, text_.data(),
                                     static_cast<std::uint32_t>(text_.size())));
}

std::string SceneTree::shape() const {
  char* const text = ts_node_string(root());
  std::string shape = text;
  std::free(text);
  return shape;
}

std::string SceneTree::first_error() const {
  if (!has_error()) return {};
  const TSNode node = first_wrong(root());
  const TSPoint at = ts_node_start_point(node);
  return fmt::format("{}:{}: {}", at.row + 1, at.column + 1,
                     ts_node_is_missing(node) ? "MISSING" : ts_node_type(node));
}

Query::Query(const std::string& file) {
  const auto path =
      std::filesystem::path(SDLC_SOURCE_DIR) / "editors/tree-sitter-sdlc/queries" / file;
  const std::string source = content_of(path);
  std::uint32_t at = 0;
  TSQueryError error = TSQueryErrorNone;
  query_.reset(ts_query_new(tree_sitter_sdlc(), source.data(),
                            static_cast<std::uint32_t>(source.size()), &at, &error));
  if (!query_) {
    throw std::runtime_error(fmt::format("{}: error {} at byte {}: {}", file,
                                         static_cast<int>(error), at, source.substr(at, 40)));
  }
  for (std::uint32_t i = 0; i < ts_query_pattern_count(query_.get()); ++i) {
    conditions_.push_back(conditions_of(i));
  }
}

std::string_view Query::string(std::uint32_t id) const {
  std::uint32_t size = 0;
  const char* const text = ts_query_string_value_for_id(query_.get(), id, &size);
  return {text, size};
}

std::string_view Query::capture_name(std::uint32_t id) const {
  std::uint32_t size = 0;
  const char* const text = ts_query_capture_name_for_id(query_.get(), id, &size);
  return {text, size};
}

std::vector<std::string_view> Query::capture_names() const {
  std::vector<std::string_view> names;
  for (std::uint32_t i = 0; i < ts_query_capture_count(query_.get()); ++i) {
    names.push_back(capture_name(i));
  }
  return names;
}

std::vector<Query::Condition> Query::conditions_of(std::uint32_t pattern) const {
  std::vector<Condition> conditions;
  std::uint32_t count = 0;
  const TSQueryPredicateStep* step = ts_query_predicates_for_pattern(query_.get(), pattern, &count);
  // Each is its name, its arguments, and an end.
  for (const auto* const end = step + count; step != end;) {
    const std::string_view name = string(step->value_id);
    const bool is_match = name == "match?" || name == "not-match?";
    if (!is_match && name != "set!") throw std::runtime_error("predicate " + std::string(name));
    if (is_match) {
      conditions.push_back(
          {step[1].value_id, name == "not-match?", words_of(string(step[2].value_id))});
    }
    while (step->type != TSQueryPredicateStepTypeDone) ++step;
    ++step;
  }
  return conditions;
}

bool Query::holds(const TSQueryMatch& match, std::string_view text) const {
  const auto& conditions = conditions_[match.pattern_index];
  return std::ranges::all_of(conditions, [&](const Condition& condition) {
    for (std::uint16_t i = 0; i < match.capture_count; ++i) {
      if (match.captures[i].index != condition.capture) continue;
      const lang::Span span = span_of(match.captures[i].node);
      const std::string word(text.substr(span.begin, span.size()));
      if (condition.words.contains(word) == condition.is_negated) return false;
    }
    return true;
  });
}

std::vector<Capture> Query::captures(const SceneTree& tree) const {
  const std::unique_ptr<TSQueryCursor, Deleter> cursor(ts_query_cursor_new());
  ts_query_cursor_exec(cursor.get(), query_.get(), tree.root());
  std::vector<Capture> captures;
  TSQueryMatch match;
  while (ts_query_cursor_next_match(cursor.get(), &match)) {
    if (!holds(match, tree.text())) continue;
    for (std::uint16_t i = 0; i < match.capture_count; ++i) {
      const TSQueryCapture& capture = match.captures[i];
      captures.push_back({span_of(capture.node), capture_name(capture.index)});
    }
  }
  std::ranges::sort(captures, {}, [](const Capture& capture) {
    return std::tuple(capture.span.begin, capture.span.end, capture.name);
  });
  return captures;
}

}  // namespace sdlc::test
