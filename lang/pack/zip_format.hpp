#pragma once

#include <cstddef>
#include <cstdint>

/// The numbers of ZIP that its reader and writer share (APPNOTE 4.3 and 4.4).
namespace sdlc::lang::zip {

inline constexpr std::uint32_t kLocalHeader = 0x04034b50, kDirectoryHeader = 0x02014b50;
inline constexpr std::uint32_t kEnd = 0x06054b50, kZip64Locator = 0x07064b50;
/// Bytes without names, extra fields and comments.
inline constexpr std::size_t kLocalSize = 30, kDirectorySize = 46, kEndSize = 22;
inline constexpr std::size_t kZip64LocatorSize = 20;

inline constexpr std::uint16_t kStored = 0, kDeflated = 8;  // methods
inline constexpr std::uint16_t kVersion = 20;               // 2.0: that of deflate
inline constexpr std::uint16_t kEncrypted = 1 << 0, kSizesAfterData = 1 << 3,
                               kStronglyEncrypted = 1 << 6, kUtf8 = 1 << 11,
                               kHiddenHeaders = 1 << 13;  // flags
/// They do not change the meaning of an entry: how hard deflate tried, and the encoding of the
/// name, which is UTF-8 in any case.
inline constexpr std::uint16_t kHarmlessFlags = 1 << 1 | 1 << 2 | kUtf8;

inline constexpr std::uint32_t kFileTypeMask = 0170000, kRegularFile = 0100000,
                               kSymbolicLink = 0120000, kFolder = 0040000;  // of a Unix mode
inline constexpr std::uint32_t kDosFolder = 0x10;

}  // namespace sdlc::lang::zip
