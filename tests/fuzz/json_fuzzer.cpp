#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sdlc::test::run_fuzz_input({reinterpret_cast<const char*>(data), size},
                             sdlc::lang::SourceFormat::Json);
  return 0;
}
