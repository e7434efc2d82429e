#include "lsp/colors.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "lang/editor/color_places.hpp"
#include "lsp/positions.hpp"

namespace sdlc::lsp {
namespace {

Json color_json(const lang::DisplayedRgb& color) {
  return {{"red", color[0]}, {"green", color[1]}, {"blue", color[2]}, {"alpha", 1}};
}

lang::DisplayedRgb color_of_json(const Json& color) {
  return {color.at("red").get<double>(), color.at("green").get<double>(),
          color.at("blue").get<double>()};
}

std::vector<lang::ColorPlace> colors_of(const Text& text) {
  return text.is_scene() ? lang::colors_of(*text.view, text.file)
                         : lang::colors_of_config(text.source->text());
}

/// The texts for the picked colour; empty if the text has changed and there is no colour any more.
std::vector<std::string> presentations(const Text& text, lang::Span where,
                                       const lang::DisplayedRgb& picked) {
  if (text.is_scene()) {
    const auto place = lang::color_at(*text.view, text.file, where);
    if (!place) return {};
    return lang::color_presentations(*text.view, text.file, *place, picked);
  }
  const auto places = colors_of(text);
  const auto place = std::ranges::find(places, where, &lang::ColorPlace::where);
  if (place == places.end()) return {};
  return lang::config_color_presentations(text.source->text(), *place, picked);
}

/// The text in one line: what a picker shows.
std::string label_of(std::string text) {
  const auto is_break = [](char c) { return c == '\n' || c == '\r' || c == '\t'; };
  std::ranges::replace_if(text, is_break, ' ');
  return text;
}

}  // namespace

Json document_color(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  TextRanges ranges(*text.source, session.client().encoding());
  Json colors = Json::array();
  for (const lang::ColorPlace& place : colors_of(text)) {
    colors.push_back(
        {{"range", ranges.range(place.where)}, {"color", color_json(place.displayed())}});
  }
  return colors;
}

Json color_presentation(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  const Json& range = params.at("range");
  const lang::DisplayedRgb picked = color_of_json(params.at("color"));
  Json found = Json::array();
  for (const std::string& written : presentations(text, session.span(text, range), picked)) {
    found.push_back(
        {{"label", label_of(written)}, {"textEdit", {{"range", range}, {"newText", written}}}});
  }
  return found;
}

}  // namespace sdlc::lsp
