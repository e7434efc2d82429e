#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace sdlc::lang {

enum class DataFormat : std::uint8_t { Csv, Tsv, Xyz };

/// A format of data files.
struct DataFormatInfo {
  std::string_view extension;  ///< in small letters
  DataFormat format;
  std::string_view doc;
};

inline constexpr auto kDataFormats = std::to_array<DataFormatInfo>({
    {".csv", DataFormat::Csv,
     "Cells separated by commas (RFC 4180); the first line, the header, has the names of the "
     "columns."},
    {".tsv", DataFormat::Tsv, "The same with tabs."},
    {".xyz", DataFormat::Xyz,
     "The atoms of a molecule: their number, a comment line, and a line `element x y z` for each, "
     "which are the names of the columns."},
});

/// The format of a data file by its extension, whose case does not matter; nullopt for other files.
std::optional<DataFormat> data_format_of(const std::filesystem::path& path);

}  // namespace sdlc::lang
