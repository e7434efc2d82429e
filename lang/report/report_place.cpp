#include "lang/report/report_place.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <unordered_map>

#include <fmt/format.h>

#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

namespace fs = std::filesystem;

/// The code units of a text that are hashed, and the indices at which its lines begin.
struct Units {
  std::vector<std::uint16_t> units;
  std::vector<std::size_t> line_begins;
};

void append_utf16(DecodedChar c, std::vector<std::uint16_t>& units) {
  constexpr char32_t kReplacement = 0xFFFD, kFirstPair = 0x10000;
  const char32_t code_point = c.is_valid ? c.code_point : kReplacement;
  if (code_point < kFirstPair) {
    units.push_back(static_cast<std::uint16_t>(code_point));
  } else {
    const char32_t bits = code_point - kFirstPair;
    units.push_back(static_cast<std::uint16_t>(0xD800 + (bits >> 10)));
    units.push_back(static_cast<std::uint16_t>(0xDC00 + (bits & 0x3FF)));
  }
}

Units units_of(std::string_view text) {
  constexpr std::uint16_t kEnd = 0xFFFF;
  Units result{.units = {}, .line_begins = {0}};
  while (!text.empty()) {
    const DecodedChar c = decode_utf8(text);
    const bool is_pair = text.starts_with("\r\n");
    text.remove_prefix(is_pair ? 2 : c.size);
    if (c.code_point == ' ' || c.code_point == '\t') continue;
    if (c.code_point == '\r' || c.code_point == '\n') {
      result.units.push_back('\n');
      result.line_begins.push_back(result.units.size());
    } else {
      append_utf16(c, result.units);
    }
  }
  result.units.push_back(kEnd);
  return result;
}

std::vector<std::string> fingerprints_of(std::string_view text) {
  constexpr std::size_t kWindow = 100;
  constexpr std::uint64_t kBase = 37;
  const Units all = units_of(text);
  const auto unit = [&](std::size_t i) -> std::uint64_t {
    return i < all.units.size() ? all.units[i] : 0;
  };

  std::uint64_t hash = 0, base_to_window = 1;
  for (std::size_t i = 0; i < kWindow; ++i) {
    hash = hash * kBase + unit(i);
    base_to_window *= kBase;
  }
  std::vector<std::string> fingerprints;
  std::unordered_map<std::uint64_t, std::uint32_t> seen;
  std::size_t at = 0;
  for (const std::size_t begin : all.line_begins) {
    for (; at < begin; ++at) hash = hash * kBase + unit(at + kWindow) - base_to_window * unit(at);
    fingerprints.push_back(fmt::format("{:x}:{}", hash, ++seen[hash]));
  }
  return fingerprints;
}

}  // namespace

std::string report_path(std::string_view name, const fs::path& root) {
  if (root.empty()) return std::string(name);
  const fs::path whole = (root / name).lexically_normal();
  const fs::path relative = whole.lexically_relative(root);
  const bool is_inside = !relative.empty() && *relative.begin() != "..";
  return (is_inside ? relative : whole).generic_string();
}

std::string report_uri(std::string_view path) {
  std::string uri = path.starts_with('/') ? "file://" : "";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = byte < 0x80 && (std::isalnum(byte) != 0 ||
                                          std::string_view("-._~/").find(c) != std::string::npos);
    uri += is_plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return uri;
}

std::string LineFingerprints::of(const SourceFile& file, std::uint32_t line) {
  if (fingerprints_.empty() || name_ != file.name()) {
    name_ = file.name();
    fingerprints_ = fingerprints_of(file.text());
  }
  // A single carriage return is a line end for GitHub, but not here.
  return fingerprints_[std::min<std::size_t>(line, fingerprints_.size()) - 1];
}

}  // namespace sdlc::lang
