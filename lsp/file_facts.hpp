#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/resolve/symbol.hpp"
#include "lang/source/position_encoding.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lsp {

/// A declaration or a named object of a file. The texts belong to its FileFacts.
struct IndexedSymbol {
  lang::SymbolKind kind = lang::SymbolKind::Let;
  std::string_view name;
  std::string_view object_kind = {};  ///< of an object
  std::string_view container = {};    ///< the name of the def or group around it; may be empty
  lang::Position begin, end = {};     ///< of the name; columns in the encoding of the index
};

/// What is kept of a scene file, instead of its text.
struct FileFacts {
  std::filesystem::path path;
  /// The files that it imports and includes, by identity, whether they exist or not.
  std::vector<std::filesystem::path> dependencies = {};
  std::vector<IndexedSymbol> symbols = {};
  std::unique_ptr<char[]> names = {};  ///< the texts of the symbols, each once
};

/// Max size of a text whose symbols are kept. A larger scene is usually data written by a program;
/// its tree would take ten times its size for a moment.
inline constexpr std::uint64_t kMaxIndexedBytes = std::uint64_t{4} << 20;
inline constexpr std::size_t kMaxIndexedSymbols = 10'000;  ///< per file

/// The facts of a text, however broken it is. Imports and includes are found in texts of any size.
/// Throws lang::StopRequested if `stop`, which may be null, is made.
FileFacts read_facts(const std::filesystem::path& path, std::string text,
                     const lang::FileSystem& files, lang::PositionEncoding encoding,
                     const lang::StopRequest* stop);

}  // namespace sdlc::lsp
