#include "lang/source/data_format.hpp"

#include <algorithm>
#include <string>

#include "lang/text/ascii.hpp"

namespace sdlc::lang {

std::optional<DataFormat> data_format_of(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  const auto* const found = std::ranges::find(kDataFormats, extension, &DataFormatInfo::extension);
  return found == kDataFormats.end() ? std::nullopt : std::optional(found->format);
}

}  // namespace sdlc::lang
