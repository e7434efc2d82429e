#include "lang/editor/snippets.hpp"

#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sdlc::lang {
namespace {

using enum SnippetPlace;

constexpr auto kSnippets = std::to_array<Snippet>({
    {"scene", "A new scene: camera, background, a sphere on the ground.",
     "scene 1\n\n"
     "camera main { from: (0, 1, 5), at: (0, 0.5, 0), fov: 30deg }\n\n"
     "background { bottom: white, top: #80b3ff }\n\n"
     "sphere ground { center: (0, -1000, 0), radius: 1000, material: diffuse(color: ${1:olive}) }\n"
     "sphere ball { center: (0, 0.5, 0), radius: 0.5, material: ${2:diffuse(color: tan)} }\n\n"
     "render { width: ${3:960}, samples: ${4:64}, output: \"${5:ball}.png\" }\n$0",
     EmptyFile},
    {"let", "Names a value.", "let ${1:name} = $0", Statement, true},
    {"for", "Repeats statements for each element of a list.",
     "for ${1:i} in range(${2:10}) {\n  $0\n}", Statement, true},
    {"if", "Statements under a condition.", "if ${1:condition} {\n  $0\n}", Statement, true},
    {"fn", "Declares a function.", "fn ${1:name}(${2:x}) = $0", TopLevel, true},
    {"def", "Declares a kind of object.", "def ${1:name}(${2:size}: ${3:number}) {\n  $0\n}",
     TopLevel, true},
    {"param", "A value that `--set NAME=VALUE` can change.", "param ${1:name} = $0", TopLevel,
     true},
    {"import", "Brings the names of another scene file.", "import \"${1}\" as ${2:name}", TopLevel,
     true},
    {"include", "Places the objects of another file here.", "include \"${1}\"", Statement, true},
    {"assert", "Stops with a message if the condition is false.",
     "assert ${1:condition}, \"${2:message}\"", Statement, true},
    {"ifelse", "Statements under a condition, and others if it is false.",
     "if ${1:condition} {\n  $2\n} else {\n  $0\n}", Statement},
    {"ground", "A sphere so large that it looks flat.",
     "sphere ground { center: (0, -1000, 0), radius: 1000, material: diffuse(color: ${1:olive}) "
     "}\n",
     Statement},
    {"lamp", "A sphere that emits light.",
     "sphere lamp {\n"
     "  center: (${1:-5}, ${2:8}, ${3:5})\n"
     "  radius: ${4:3}\n"
     "  material: emissive(color: ${5:white}, intensity: ${6:4})\n"
     "}\n",
     Statement},
    {"ring", "Spheres on a circle.",
     "for i in range(${1:12}) {\n"
     "  let a = i / ${1:12} * 1turn\n"
     "  sphere { center: ${2:2} * (cos(a), 0, sin(a)), radius: ${3:0.2}, material: "
     "${4:diffuse(color: white)} }\n"
     "}\n",
     Statement},
    {"grid", "Spheres in rows.",
     "for i in range(${1:5}) {\n"
     "  for j in range(${2:5}) {\n"
     "    sphere { center: (i, 0, j), radius: ${3:0.4}, material: ${4:diffuse(color: white)} }\n"
     "  }\n"
     "}\n",
     Statement},
});

std::string choice(std::span<const std::string_view> words, int& next) {
  return fmt::format("${{{}|{}|}}", next++, fmt::join(words, ","));
}

/// A camera at the origin that looks at the origin is an error.
bool is_camera_position(const Property& property) {
  return &property == &kind_info(ObjectKind::Camera).properties[camera_property::kFrom];
}

std::string_view plain_placeholder(Type type) {
  switch (type) {
    case Type::Color: return "white";
    case Type::Material: return "diffuse(color: white)";
    default: return "1";
  }
}

}  // namespace

std::span<const Snippet> all_snippets() noexcept { return kSnippets; }

std::string placeholder_of(const Property& property, int& next) {
  const auto take = [&](std::string_view format) {
    std::string text;
    for (const char c : format) {
      if (c == '@') {
        text += std::to_string(next++);
      } else {
        text += c;
      }
    }
    return text;
  };
  static constexpr std::array<std::string_view, 2> kBooleans{"true", "false"};
  switch (property.type) {
    case Type::Vec3:
      return take(is_camera_position(property) ? "(${@:0}, ${@:1}, ${@:5})"
                                               : "(${@:0}, ${@:0}, ${@:0})");
    case Type::Angles: return take("(${@:0}deg, ${@:0}deg, ${@:0}deg)");
    case Type::Angle: return take("${@:40}deg");
    case Type::Interval: return take("${@:0s} .. ${@:20ms}");
    case Type::Frames: return take("${@:1} .. ${@:24}");
    case Type::String: return take("\"${@}\"");
    case Type::Motion: return take("line(to: (${@:0}, ${@:0}, ${@:0}), over: ${@:0s} .. ${@:1s})");
    case Type::Bool: return choice(kBooleans, next);
    case Type::Word: return property.words.empty() ? take("$@") : choice(property.words, next);
    default: break;
  }
  const std::string_view usual = property.default_text;
  return fmt::format("${{{}:{}}}", next++,
                     usual.empty() ? plain_placeholder(property.type) : usual);
}

std::string snippet_of(const Property& property) {
  int next = 1;
  return fmt::format("{}: {}", property.name, placeholder_of(property, next));
}

std::string snippet_of(const Kind& kind) {
  int next = 1;
  std::string text(kind.name);
  // Only the names of cameras are used elsewhere.
  if (kind.id == ObjectKind::Camera) text += fmt::format(" ${{{}:main}}", next++);
  std::string inside;
  for (const Property& property : kind.properties) {
    const bool is_wanted = property.presence == Presence::Required ||
                           (kind.id == ObjectKind::Sphere && property.type == Type::Material);
    if (is_wanted)
      inside += fmt::format("\n  {}: {}", property.name, placeholder_of(property, next));
  }
  return inside.empty() ? text + " {\n  $0\n}" : fmt::format("{} {{{}\n}}", text, inside);
}

}  // namespace sdlc::lang
