#pragma once

#include <cstdint>
#include <string_view>

namespace sdlc::render {

/// The 64-bit FNV-1a hash of the added bytes. It detects damage and distinguishes data, but is not
/// cryptographic.
class Fnv1a {
 public:
  constexpr void add_byte(std::uint8_t byte) noexcept { hash_ = (hash_ ^ byte) * 0x100000001B3u; }
  constexpr void add(std::string_view bytes) noexcept {
    for (const char c : bytes) add_byte(static_cast<std::uint8_t>(c));
  }
  constexpr std::uint64_t value() const noexcept { return hash_; }

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325u;
};

}  // namespace sdlc::render
