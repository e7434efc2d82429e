#include "cli/report/html.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

#include "lang/text/display_width.hpp"

namespace sdlc::cli {

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : lang::printable(text)) {
    switch (c) {
      case '&': html += "&amp;"; break;
      case '<': html += "&lt;"; break;
      case '>': html += "&gt;"; break;
      case '"': html += "&quot;"; break;
      case '\'': html += "&#39;"; break;
      default: html += c;
    }
  }
  return html;
}

std::string base64(std::string_view bytes) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::string_view triple = bytes.substr(i, 3);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (k < triple.size() ? static_cast<unsigned char>(triple[k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= triple.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

std::string plain_text(std::string_view html) {
  static constexpr std::pair<std::string_view, std::string_view> kEntities[] = {
      {"&lt;", "<"},  {"&gt;", ">"},  {"&quot;", "\""},
      {"&#39;", "'"}, {"&amp;", "&"}, {"\u00a0", " "}};
  std::string text;
  while (!html.empty()) {
    if (html.front() == '<') {
      html.remove_prefix(std::min(html.find('>'), html.size() - 1) + 1);
      continue;
    }
    const auto entity = std::ranges::find_if(
        kEntities, [&](const auto& candidate) { return html.starts_with(candidate.first); });
    const bool is_entity = entity != std::end(kEntities);
    text += is_entity ? entity->second : html.substr(0, 1);
    html.remove_prefix(is_entity ? entity->first.size() : 1);
  }
  return text;
}

}  // namespace sdlc::cli
