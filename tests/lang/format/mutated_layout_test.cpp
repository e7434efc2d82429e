#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "lang/format/format.hpp"
#include "lang/format/placed_tokens.hpp"
#include "lang/syntax/syntax.hpp"
#include "tests/lang/format/scene_texts.hpp"

// Sound texts with other blanks, line ends, comments and optional commas than they had: whatever
// the layout, formatting keeps what the text says and is done after one time.
namespace sdlc::test {
namespace {

/// SplitMix64: the same layouts in every run.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t bound) {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return static_cast<std::size_t>((z ^ (z >> 31)) % bound);
  }
  template <typename T, std::size_t N>
  const T& one_of(const T (&all)[N]) {
    return all[below(N)];
  }

 private:
  std::uint64_t state_;
};

/// What a text says, without its layout: the tokens without commas, and the comments.
struct Content {
  std::string tokens, comments;
};

void append_without_blanks(std::string_view text, std::string& out) {
  for (const char c : text) {
    if (c != ' ' && c != '\t' && c != '\n' && c != '\r') out += c;
  }
}

/// A node's own bytes: all of a leaf, the head of another.
lang::Span leaf_of(const lang::SyntaxNode& node) {
  if (node.extent == 1) return node.span();
  return {node.begin, node.begin + node.head};
}

/// Takes the text apart by the nodes of its tree, not by tokens as the formatter does.
Content content_of_scene(const std::string& text) {
  const lang::Document file("test.scene", text);
  lang::DiagnosticSink sink;
  const lang::SyntaxTree tree = lang::parse(file, sink);
  EXPECT_FALSE(sink.has_errors()) << text;
  Content content;
  std::uint32_t at = 0;
  auto comment = tree.comments().begin();
  // What is between leaves, without comments and commas. A path may have comments in it.
  const auto append_to = [&](std::uint32_t end) {
    while (at < end) {
      const bool has_comment = comment != tree.comments().end() && comment->span.begin < end;
      std::string part(tree.text({at, has_comment ? comment->span.begin : end}));
      std::erase(part, ',');
      append_without_blanks(part, content.tokens);
      at = has_comment ? (comment++)->span.end : end;
    }
  };
  for (const lang::SyntaxNode& node : tree.nodes()) {
    const lang::Span leaf = leaf_of(node);
    if (leaf.size() == 0 || leaf.begin < at) continue;
    append_to(leaf.begin);
    if (node.kind == lang::SyntaxKind::Number && text[leaf.begin] == '.') content.tokens += '0';
    if (node.kind == lang::SyntaxKind::String) {
      append_without_blanks(tree.text(leaf), content.tokens);
      at = leaf.end;
    } else {
      append_to(leaf.end);
    }
  }
  append_to(static_cast<std::uint32_t>(text.size()));
  for (const lang::Comment& each : tree.comments()) {
    append_without_blanks(tree.text(each.span), content.comments);
  }
  return content;
}

std::vector<std::string> tokens_of(const std::string& text) {
  std::vector<std::string> tokens;
  for (lang::PlacedTokens reader(text); !reader.is_at_end(); reader.take()) {
    tokens.emplace_back(reader.peek_text());
  }
  return tokens;
}

bool is_bracket_or_comma(const std::string& token) {
  return token.size() == 1 && std::string_view("{}()[],:").find(token[0]) != std::string_view::npos;
}

/// The tokens with random gaps between them.
std::string with_random_gaps(const std::vector<std::string>& tokens, bool has_comments,
                             Random& random) {
  static constexpr std::string_view kBlanks[] = {" ",  " ",      " ",  "   ",
                                                 "\n", "\n\n\n", "\t", "\r\n"};
  static constexpr std::string_view kComments[] = {
      "/* a */", " /* b */\n", "// c\n", " /// d\n", "\n// e\n", "\n\n /* f\n  g */", "/**/"};
  const std::size_t rarity = 1 + random.below(20);
  std::string text;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const bool may_touch =
        i == 0 || is_bracket_or_comma(tokens[i]) || is_bracket_or_comma(tokens[i - 1]);
    if (!may_touch || random.below(3) == 0) text += random.one_of(kBlanks);
    if (has_comments && random.below(rarity) == 0) {
      if (text.ends_with('/')) text += ' ';  // a division: with the comment it would be another one
      text += random.one_of(kComments);
      if (random.below(4) == 0) text += random.one_of(kComments);
      text += random.one_of(kBlanks);
    }
    text += tokens[i];
  }
  return text;
}

bool is_sound_and_same(const std::string& text, const lang::SyntaxTree& original) {
  const lang::Document file("test.scene", text);
  lang::DiagnosticSink sink;
  const lang::SyntaxTree tree = lang::parse(file, sink);
  const auto is_alike = [](const lang::SyntaxNode& a, const lang::SyntaxNode& b) {
    return a.kind == b.kind && a.op == b.op && a.extent == b.extent;
  };
  return !sink.has_errors() && std::ranges::equal(tree.nodes(), original.nodes(), is_alike);
}

/// Drops or adds a comma, where that changes nothing.
void change_a_comma(std::vector<std::string>& tokens, const lang::SyntaxTree& original,
                    Random& random) {
  std::vector<std::string> changed = tokens;
  const auto at = changed.begin() + static_cast<std::ptrdiff_t>(random.below(changed.size()));
  const auto comma = std::find(at, changed.end(), ",");
  if (random.below(2) == 0 && comma != changed.end()) {
    changed.erase(comma);
  } else {
    const auto closer = std::find_if(at, changed.end(), [](const std::string& token) {
      return token == "}" || token == ")" || token == "]";
    });
    changed.insert(closer, ",");
  }
  std::string text;
  for (const std::string& token : changed) text += token + " ";
  if (is_sound_and_same(text, original)) tokens = std::move(changed);
}

/// Makes layouts of the sound texts, one after the other.
class Layouts {
 public:
  Layouts(bool has_comments, std::uint64_t seed) : has_comments_(has_comments), random_(seed) {
    for (const SceneText& scene : sound_scenes()) texts_.push_back(scene.text);
  }

  std::string next() {
    const std::string& text = texts_[next_++ % texts_.size()];
    const lang::Document file("test.scene", text);
    lang::DiagnosticSink sink;
    const lang::SyntaxTree tree = lang::parse(file, sink);
    std::vector<std::string> tokens = tokens_of(text);
    for (int i = 0; i < 4; ++i) change_a_comma(tokens, tree, random_);
    for (;;) {
      // A value at the beginning of a line may look like the next object, which is an error.
      std::string layout = with_random_gaps(tokens, has_comments_, random_);
      if (is_sound_and_same(layout, tree)) return layout;
    }
  }

 private:
  bool has_comments_;
  Random random_;
  std::vector<std::string> texts_;
  std::size_t next_ = 0;
};

void expect_sound_formatting(const std::string& text) {
  const std::string once = formatted(text);
  const Content before = content_of_scene(text), after = content_of_scene(once);
  ASSERT_EQ(after.tokens, before.tokens) << text;
  ASSERT_EQ(after.comments, before.comments) << text;
  ASSERT_EQ(formatted(once), once) << text;
}

TEST(MutatedLayout, WithoutCommentsIsFormattedOnce) {
  Layouts layouts(false, 1);
  for (int i = 0; i < 500 && !testing::Test::HasFailure(); ++i) {
    expect_sound_formatting(layouts.next());
  }
}

TEST(MutatedLayout, WithCommentsIsFormattedOnce) {
  Layouts layouts(true, 2);
  for (int i = 0; i < 500 && !testing::Test::HasFailure(); ++i) {
    expect_sound_formatting(layouts.next());
  }
}

TEST(MutatedLayout, SaysTheSameWhenSomeLinesAreFormatted) {
  Layouts layouts(true, 3);
  Random random(4);
  for (int i = 0; i < 300 && !testing::Test::HasFailure(); ++i) {
    const std::string text = layouts.next();
    const lang::Document file("test.scene", text);
    const auto first = static_cast<std::uint32_t>(1 + random.below(file.line_count()));
    const auto last = static_cast<std::uint32_t>(first + random.below(20));
    lang::DiagnosticSink sink;
    const auto outcome = lang::format_file(file, sink, lang::LineRange{first, last});
    ASSERT_TRUE(outcome) << text;
    const Content before = content_of_scene(text), after = content_of_scene(*outcome);
    ASSERT_EQ(after.tokens, before.tokens) << first << ":" << last << "\n" << text;
    ASSERT_EQ(after.comments, before.comments) << first << ":" << last << "\n" << text;
  }
}

/// The bits of the spheres that a text lowers to.
std::string bits_of(const std::string& name, const std::string& text) {
  static const lang::DiskFileSystem files;
  lang::Workspace workspace(files);
  const lang::Document file(name, text);
  lang::DiagnosticSink sink;
  lang::Compiler compiler(file, {.workspace = &workspace, .limits = {}, .sets = {}}, sink);
  const auto lowered = compiler.lower({});
  std::string bits;
  if (!lowered) return bits;
  for (const render::Sphere& sphere : lowered->scene.spheres) {
    for (const double number : {sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius}) {
      bits += fmt::format("{:x} ", std::bit_cast<std::uint64_t>(number));
    }
    bits += fmt::format("{}\n", static_cast<int>(sphere.material));
  }
  return bits;
}

TEST(MutatedLayout, LowersToTheSameSpheresWhenFormatted) {
  Random random(3);
  for (const auto& [name, text] : scenes_in({"examples", "tests/files/whole"})) {
    const std::string layout = with_random_gaps(tokens_of(text), true, random);
    const std::string expected = bits_of(name, text);
    EXPECT_TRUE(bits_of(name, formatted(layout)) == expected) << name;
  }
}

}  // namespace
}  // namespace sdlc::test
