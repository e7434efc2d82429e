#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "lang/repair/vocabulary.hpp"
#include "lang/resolve/builtin_symbols.hpp"
#include "lang/value/constructors.hpp"
#include "tests/support/temporary_folder.hpp"

// The grammars of editors list the words of the language: they are those of the program's tables.
// SDLC_UPDATE=1 rewrites them.
namespace sdlc::test {
namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

const std::filesystem::path kRoot = SDLC_SOURCE_DIR;
const std::filesystem::path kTreeSitter = kRoot / "editors/tree-sitter-sdlc";
const std::filesystem::path kTextMate = kRoot / "editors/vscode/syntaxes/scene.tmLanguage.json";

template <typename List>
Words words_of(const List& list) {
  return {list.begin(), list.end()};
}

/// Reserved and contextual words.
std::set<std::string> keywords() {
  std::set<std::string> words(lang::kReservedWords.begin(), lang::kReservedWords.end());
  words.insert(lang::kContextualWords.begin(), lang::kContextualWords.end());
  return words;
}

/// The names of built-in symbols of a kind.
Words names_of(lang::SymbolKind kind) {
  Words names;
  for (const lang::BuiltinSymbol& symbol : lang::builtin_symbols()) {
    if (symbol.kind == kind) names.emplace_back(symbol.name);
  }
  return names;
}

bool is_constructor(const std::string& name) { return lang::find_constructor(name) != nullptr; }

/// The lists that an editor's grammar can ask for, by name.
std::map<std::string, Words> make_lists() {
  std::map<std::string, Words> lists{{"types", names_of(lang::SymbolKind::Type)},
                                     {"kinds", names_of(lang::SymbolKind::BuiltinKind)},
                                     {"values", names_of(lang::SymbolKind::BuiltinValue)},
                                     {"units", words_of(lang::kUnits)},
                                     {"declarations", words_of(lang::kDeclarationWords)}};
  for (std::string& name : names_of(lang::SymbolKind::BuiltinFunction)) {
    lists["functions and constructors"].push_back(name);
    lists[is_constructor(name) ? "constructors" : "functions"].push_back(std::move(name));
  }
  return lists;
}

const Words& list(const std::string& name) {
  static const std::map<std::string, Words> lists = make_lists();
  const auto found = lists.find(name);
  if (found == lists.end()) throw std::runtime_error("there is no list of " + name);
  return found->second;
}

/// Longer words first, since the first alternative wins where a word boundary does not decide.
std::string alternatives(Words words) {
  std::ranges::stable_sort(words, std::ranges::greater(), &std::string::size);
  return fmt::format("{}", fmt::join(words, "|"));
}

/// The text with each match of the pattern replaced by what `replace` makes of it.
template <typename Replace>
std::string replace_all(const std::string& text, const std::regex& pattern, Replace replace) {
  std::string result;
  auto copied = text.begin();
  for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i) {
    result.append(copied, (*i)[0].first);
    result += replace(*i);
    copied = (*i)[0].second;
  }
  return result.append(copied, text.end());
}

/// The first group of every match.
std::set<std::string> find_all(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i) {
    found.insert((*i)[1]);
  }
  return found;
}

/// Compares a file with what it should be, or rewrites it.
void expect_content(const std::filesystem::path& path, const std::string& expected) {
  if (std::getenv("SDLC_UPDATE") != nullptr) return write_text(path, expected);
  EXPECT_EQ(content_of(path), expected) << "SDLC_UPDATE=1 rewrites " << path;
}

// Words of the tree-sitter grammar

TEST(EditorLists, TheTreeSitterGrammarReadsTheWordsOfTheLanguage) {
  const Json words{{"reserved", lang::kReservedWords}, {"contextual", lang::kContextualWords}};
  expect_content(kTreeSitter / "words.json", words.dump(2) + "\n");
}

std::string c_array(std::string_view name, const Words& words) {
  return fmt::format("static const char *const {}[] = {{\n    \"{}\",\n}};\n", name,
                     fmt::join(words, "\",\n    \""));
}

std::size_t max_size(const Words& words) {
  return std::ranges::max(words, {}, &std::string::size).size();
}

TEST(EditorLists, TheTreeSitterScannerReadsTheWordsAndUnitsOfTheLanguage) {
  Words words = words_of(lang::kReservedWords);
  words.insert(words.end(), lang::kContextualWords.begin(), lang::kContextualWords.end());
  const Words& units = list("units");
  expect_content(kTreeSitter / "src/words.h",
                 "// Written by a test of sdlc from the program's tables; see README.md.\n"
                 "#ifndef TREE_SITTER_SDLC_WORDS_H_\n#define TREE_SITTER_SDLC_WORDS_H_\n\n"
                 "// Reserved words, then those that are names in most places.\n" +
                     c_array("sdlc_words", words) +
                     fmt::format("enum {{ SDLC_RESERVED_COUNT = {}, SDLC_WORD_COUNT = {}, "
                                 "SDLC_MAX_WORD = {} }};\n\n",
                                 lang::kReservedWords.size(), words.size(), max_size(words)) +
                     c_array("sdlc_units", units) +
                     fmt::format("enum {{ SDLC_UNIT_COUNT = {}, SDLC_MAX_UNIT = {} }};\n\n#endif\n",
                                 units.size(), max_size(units)));
}

TEST(EditorLists, TheContextualWordsAreThoseOfTheGrammarThatAreNotReserved) {
  EXPECT_EQ(
      find_all(content_of(kRoot / "grammar/scene.ebnf"), std::regex("\"([a-z]{2,})\"(?! \\|| ;)")),
      [] {
        std::set<std::string> words = keywords();
        words.erase("true");
        words.erase("false");
        return words;
      }());
}

TEST(EditorLists, TheTreeSitterGrammarHasARuleForEveryWord) {
  const std::string rules = std::regex_replace(content_of(kTreeSitter / "grammar.js"),
                                               std::regex("(field\\(|name: )'[a-z]+'"), "");
  EXPECT_EQ(find_all(rules, std::regex("'([a-z]+)'")), keywords());
}

TEST(EditorLists, TheQueriesColorEveryWord) {
  std::set<std::string> words = keywords();
  // Nodes of their own.
  words.erase("true");
  words.erase("false");
  EXPECT_EQ(
      find_all(content_of(kTreeSitter / "queries/highlights.scm"), std::regex("\n +\"([a-z]+)\"")),
      words);
}

// Names of built-ins in queries: `"^(…)$")) ; types`

std::string with_lists(const std::string& query) {
  static const std::regex kList(R"re("\^\([^")]*\)\$"(\)+) ; ([a-z ]+))re");
  return replace_all(query, kList, [](const std::smatch& match) {
    return fmt::format("\"^({})$\"{} ; {}", alternatives(list(match[2])), match[1].str(),
                       match[2].str());
  });
}

TEST(EditorLists, TheQueriesKnowTheNamesOfTheLanguage) {
  const auto path = kTreeSitter / "queries/highlights.scm";
  const std::string query = content_of(path);
  EXPECT_EQ(find_all(query, std::regex("\\) ; ([a-z ]+)\n")),
            (std::set<std::string>{"types", "kinds", "constructors", "functions",
                                   "functions and constructors", "values"}));
  expect_content(path, with_lists(query));
}

/// The captures of highlights.scm that Helix calls otherwise.
const std::map<std::string, std::string>& helix_captures() {
  static const std::map<std::string, std::string> captures{
      {"boolean", "constant.builtin.boolean"},
      {"comment.documentation", "comment.line.documentation"},
      {"function.call", "function"},
      {"keyword.conditional", "keyword.control.conditional"},
      {"keyword.import", "keyword.control.import"},
      {"keyword.repeat", "keyword.control.repeat"},
      {"module", "namespace"},
      {"number", "constant.numeric"},
      {"property", "variable.other.member"},
      {"string.escape", "constant.character.escape"},
      {"variable.member", "variable.other.member"},
  };
  return captures;
}

TEST(EditorLists, HelixHasTheSameQueryWithItsOwnNames) {
  const std::string query = with_lists(content_of(kTreeSitter / "queries/highlights.scm"));
  std::string text =
      replace_all(query, std::regex("@([a-z.]*[a-z])"), [](const std::smatch& match) {
        const auto renamed = helix_captures().find(match[1]);
        return "@" + (renamed == helix_captures().end() ? match[1].str() : renamed->second);
      });
  const std::size_t rules = text.find("\n(");
  ASSERT_NE(rules, std::string::npos);
  expect_content(kTreeSitter / "queries/helix/highlights.scm",
                 "; Written by a test of sdlc from ../highlights.scm, with the names of Helix.\n" +
                     text.substr(rules));
}

// Lists in the TextMate grammar: `(?<list>…)` of a rule with the comment `list: types`

void fill_lists(Json& json) {
  const std::string comment = json.is_object() && json.value("comment", Json()).is_string()
                                  ? json["comment"].get<std::string>()
                                  : std::string();
  if (comment.starts_with("list: ")) {
    const std::string name = comment.substr(6);
    for (const char* key : {"match", "begin", "end"}) {
      if (!json.contains(key)) continue;
      json[key] =
          std::regex_replace(json[key].get<std::string>(), std::regex(R"(\(\?<list>[^()]*\))"),
                             "(?<list>" + alternatives(list(name)) + ")");
    }
  }
  if (json.is_structured()) {
    for (Json& part : json) fill_lists(part);
  }
}

TEST(EditorLists, TheTextMateGrammarKnowsTheNamesOfTheLanguage) {
  const std::string text = content_of(kTextMate);
  Json grammar = Json::parse(text);
  EXPECT_EQ(find_all(text, std::regex("\"list: ([a-z ]+)\"")),
            (std::set<std::string>{"types", "kinds", "constructors", "declarations", "functions",
                                   "values", "units"}));
  fill_lists(grammar);
  expect_content(kTextMate, grammar.dump(2) + "\n");
}

// Sublime Text reads the same grammar as a property list

std::string xml_text(std::string text) {
  constexpr std::pair<std::string_view, std::string_view> kEscapes[] = {
      {"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}};
  for (const auto& [character, escape] : kEscapes) {
    for (std::size_t at = text.find(character); at != std::string::npos;
         at = text.find(character, at + escape.size())) {
      text.replace(at, character.size(), escape);
    }
  }
  return text;
}

/// An object, array or string as XML.
std::string property_list(const Json& json, const std::string& indent) {
  if (json.is_string())
    return indent + "<string>" + xml_text(json.get<std::string>()) + "</string>\n";
  const bool is_array = json.is_array();
  std::string xml = indent + (is_array ? "<array>\n" : "<dict>\n");
  for (const auto& [key, value] : json.items()) {
    // For people, and for this test.
    if (!is_array && (key == "comment" || key == "$schema") && value.is_string()) continue;
    if (!is_array) xml += indent + "  <key>" + xml_text(key) + "</key>\n";
    xml += property_list(value, indent + "  ");
  }
  return xml + indent + (is_array ? "</array>\n" : "</dict>\n");
}

TEST(EditorLists, SublimeTextHasTheTextMateGrammar) {
  Json grammar = Json::parse(content_of(kTextMate));
  fill_lists(grammar);
  expect_content(
      kRoot / "editors/sublime/Scene.tmLanguage",
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!-- Written by a test of sdlc from editors/vscode/syntaxes/scene.tmLanguage.json. -->\n"
      "<plist version=\"1.0\">\n" +
          property_list(grammar, "") + "</plist>\n");
}

TEST(EditorLists, TheTextMateGrammarColorsEveryWord) {
  std::set<std::string> words;
  for (const std::string& group :
       find_all(content_of(kTextMate), std::regex(R"re(\(([a-z|]+)\)\\\\b)re"))) {
    for (const std::string& word : find_all(group, std::regex("([a-z]+)"))) words.insert(word);
  }
  EXPECT_EQ(words, keywords());
}

}  // namespace
}  // namespace sdlc::test
