#pragma once

#include <cstdint>
#include <string_view>

#include <tao/pegtl/memory_input.hpp>
#include <tao/pegtl/parse.hpp>

namespace sdlc::lang {

/// The end of what the lexical rule matches at `at`; `at` if it does not match. For the lexers
/// alone: each includer compiles PEGTL.
template <typename Rule>
std::uint32_t end_of_match(std::string_view text, std::uint32_t at) noexcept {
  namespace pegtl = tao::pegtl;
  pegtl::memory_input<pegtl::tracking_mode::lazy, pegtl::eol::lf, const char*> in(
      text.data() + at, text.data() + text.size(), "");
  pegtl::parse<Rule>(in);
  return static_cast<std::uint32_t>(in.current() - text.data());
}

}  // namespace sdlc::lang
