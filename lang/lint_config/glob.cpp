#include "lang/lint_config/glob.hpp"

#include <cstddef>
#include <optional>
#include <stdexcept>

namespace sdlc::lang {
namespace {

constexpr std::string_view kAnyFolders = "**";

std::vector<std::string> parts_of(std::string_view path) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string_view::npos; begin = end + 1) {
    end = path.find('/', begin);
    parts.emplace_back(path.substr(begin, end == std::string_view::npos ? end : end - begin));
  }
  return parts;
}

/// The length of the `[…]` at the beginning of the text; nullopt if it is not closed. A `]` in the
/// first position is one of the characters.
std::optional<std::size_t> set_size(std::string_view text) {
  const std::size_t first = text.substr(0, 2) == "[!" ? 2 : 1;
  const std::size_t end = text.find(']', first + 1);
  if (end == std::string_view::npos) return std::nullopt;
  return end + 1;
}

/// Whether the character matches the set `[…]`.
bool is_in_set(std::string_view set, char c) {
  const bool is_negated = set[1] == '!';
  const std::string_view members =
      set.substr(is_negated ? 2 : 1, set.size() - (is_negated ? 3 : 2));
  bool is_member = false;
  for (std::size_t i = 0; i < members.size();) {
    const bool is_range = i + 2 < members.size() && members[i + 1] == '-';
    const char last = is_range ? members[i + 2] : members[i];
    is_member = is_member || (members[i] <= c && c <= last);
    i += is_range ? 3 : 1;
  }
  return is_member != is_negated;
}

/// The length of the element at the beginning of the pattern that matches one character.
std::size_t unit_size(std::string_view pattern) {
  return pattern.front() == '[' ? set_size(pattern).value() : 1;
}

bool unit_matches(std::string_view unit, char c) {
  if (unit == "?") return true;
  return unit.size() == 1 ? unit[0] == c : is_in_set(unit, c);
}

/// Whether a name matches a pattern without slashes. After a mismatch the last `*` takes one more
/// character; earlier ones need not be retried.
bool name_matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0;
  std::optional<std::size_t> after_star;
  std::size_t star_end = 0;  // end of the text that the last `*` has taken
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      after_star = ++p;
      star_end = n;
      continue;
    }
    const std::size_t size = p < pattern.size() ? unit_size(pattern.substr(p)) : 0;
    if (size > 0 && unit_matches(pattern.substr(p, size), name[n])) {
      p += size;
      ++n;
    } else if (after_star) {
      p = *after_star;
      n = ++star_end;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

void check_part(std::string_view part) {
  if (part.empty()) throw std::invalid_argument("has an empty part between slashes");
  if (part == "." || part == "..") throw std::invalid_argument("has `.` or `..` in it");
  if (part == kAnyFolders) return;
  if (part.find(kAnyFolders) != std::string_view::npos) {
    throw std::invalid_argument(
        "has `**` next to other characters; it must be a complete part between slashes");
  }
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (part[i] != '[') continue;
    const std::optional<std::size_t> size = set_size(part.substr(i));
    if (!size) throw std::invalid_argument("has a `[` that is not closed");
    i += *size - 1;
  }
}

}  // namespace

Glob::Glob(std::string_view pattern) {
  if (pattern.empty()) throw std::invalid_argument("is empty");
  if (pattern.starts_with('/')) {
    throw std::invalid_argument(
        "begins with a slash; patterns are relative to the folder of this file");
  }
  if (pattern.find('\\') != std::string_view::npos) {
    throw std::invalid_argument("has a backslash; folders are separated by slashes");
  }
  const bool is_folder = pattern.ends_with('/');
  if (is_folder) pattern.remove_suffix(1);
  parts_ = parts_of(pattern);
  for (const std::string& part : parts_) check_part(part);
  if (is_folder) {
    parts_.emplace_back(kAnyFolders);
  } else if (parts_.size() == 1 && parts_[0] != kAnyFolders) {
    parts_.emplace(parts_.begin(), kAnyFolders);
  }
}

bool Glob::matches(std::string_view path) const {
  const std::vector<std::string> names = parts_of(path);
  // fits[n]: the parts so far match the first n names.
  std::vector<bool> fits(names.size() + 1, false);
  fits[0] = true;
  for (const std::string& part : parts_) {
    std::vector<bool> next(names.size() + 1, false);
    for (std::size_t n = 0; n <= names.size(); ++n) {
      if (part == kAnyFolders) {
        next[n] = fits[n] || (n > 0 && next[n - 1]);
      } else if (n > 0) {
        next[n] = fits[n - 1] && name_matches(part, names[n - 1]);
      }
    }
    fits = std::move(next);
  }
  return fits.back();
}

}  // namespace sdlc::lang
