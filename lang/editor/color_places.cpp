#include "lang/editor/color_places.hpp"

#include <algorithm>
#include <utility>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/editor/cursor.hpp"
#include "lang/object/check.hpp"
#include "lang/resolve/builtin_symbols.hpp"
#include "lang/value/colors.hpp"
#include "lang/value/constructors.hpp"
#include "lang/value/literals.hpp"
#include "render/image/tone.hpp"

namespace sdlc::lang {
namespace {

constexpr auto kConstructors = std::to_array<std::pair<std::string_view, ColorSpelling>>({
    {"rgb", ColorSpelling::Rgb},
    {"hsl", ColorSpelling::Hsl},
    {"linear", ColorSpelling::Linear},
    {"linear255", ColorSpelling::Linear255},
    {"kelvin", ColorSpelling::Kelvin},
});

bool is_showable(render::LinearRgb color) { return color.r >= 0 && color.g >= 0 && color.b >= 0; }

/// The built-in name of this kind in this place; empty if there is none.
std::string_view builtin_at(const SymbolTable& table, Span where, SymbolKind kind) {
  const Occurrence* name = table.at(where.begin);
  const bool is_builtin = name != nullptr && name->where == where && name->symbol.is_builtin();
  if (!is_builtin) return {};
  const BuiltinSymbol& symbol = builtin_symbols()[name->symbol.index];
  return symbol.kind == kind ? symbol.name : std::string_view();
}

class ColorReader {
 public:
  explicit ColorReader(const SymbolTable& table) : table_(table) { ignored_.set_muted(true); }

  std::optional<ColorPlace> read(ast::Node node) {
    switch (node.kind()) {
      case SyntaxKind::Color:
        return ColorPlace{.where = node.span(), .color = decode_hex_color(node.text())};
      case SyntaxKind::Reference: return read_name(node);
      case SyntaxKind::Call: return read_call(node);
      default: return std::nullopt;
    }
  }

 private:
  std::optional<ColorPlace> read_name(ast::Node node) {
    const auto color = find_named_color(builtin_at(table_, node.span(), SymbolKind::BuiltinValue));
    if (!color) return std::nullopt;
    return ColorPlace{.where = node.span(), .spelling = ColorSpelling::Name, .color = *color};
  }

  std::optional<ColorPlace> read_call(ast::Node node) {
    const auto known = std::ranges::find(
        kConstructors, builtin_at(table_, node.head_span(), SymbolKind::BuiltinFunction),
        &std::pair<std::string_view, ColorSpelling>::first);
    if (known == kConstructors.end() || ast::Call{node}.is_broken()) return std::nullopt;
    ColorPlace place{.where = node.span(), .spelling = known->second, .color = {}};
    const Constructor& constructor = *find_constructor(known->first);
    ConstructorArguments arguments;
    if (!read_arguments(node, constructor, arguments, place.numbers)) return std::nullopt;
    const Value color = constructor.construct(constructor, arguments);
    place.color = get<render::LinearRgb>(color);
    return is_showable(place.color) ? std::optional(place) : std::nullopt;
  }

  /// Whether the arguments are those of the constructor, and numbers.
  bool read_arguments(ast::Node call, const Constructor& constructor,
                      ConstructorArguments& arguments, std::array<Span, 3>& numbers) {
    std::size_t count = 0;
    for (const ast::Node argument : call.children()) {
      const bool is_labeled = argument.is(SyntaxKind::Argument);
      const auto value = is_labeled ? argument.child(0) : std::optional(argument);
      const auto parameters = constructor.parameters;
      const std::size_t index =
          !is_labeled ? count
                      : static_cast<std::size_t>(
                            std::ranges::find(parameters, argument.head(), &Property::name) -
                            parameters.begin());
      if (index >= parameters.size() || !value || !value->is(SyntaxKind::Number)) return false;
      if (!is_nothing(arguments[index])) return false;
      arguments[index] = evaluate_number(*value, ignored_);
      numbers[index] = value->span();
      const Location where = value->location();
      if (!has_type(parameters[index].type, arguments[index])) return false;
      if (!check_property(parameters[index], arguments[index], where, ignored_)) return false;
      ++count;
    }
    return count == constructor.parameters.size();
  }

  const SymbolTable& table_;
  DiagnosticSink ignored_;
};

}  // namespace

double ColorPlace::intensity() const noexcept { return std::max({1.0, color.r, color.g, color.b}); }

DisplayedRgb ColorPlace::displayed() const noexcept {
  const render::LinearRgb shown = color / intensity();
  const auto encoded = [](double v) { return render::encode_tone(render::Tone::Srgb, v); };
  return {encoded(shown.r), encoded(shown.g), encoded(shown.b)};
}

std::vector<ColorPlace> colors_of(const SceneView& view, std::uint32_t file) {
  const SyntaxTree& tree = view.tree(file);
  ColorReader reader(view.table(file));
  std::vector<ColorPlace> places;
  for (NodeIndex node = 0; node < tree.nodes().size(); ++node) {
    if (auto place = reader.read({tree, node})) places.push_back(*place);
  }
  return places;
}

std::optional<ColorPlace> color_at(const SceneView& view, std::uint32_t file, Span where) {
  const SyntaxTree& tree = view.tree(file);
  ColorReader reader(view.table(file));
  for (const ast::Node node : cursor_on(tree, where.begin).nodes) {
    if (node.span() != where) continue;
    if (auto place = reader.read(node)) return place;
  }
  return std::nullopt;
}

}  // namespace sdlc::lang
