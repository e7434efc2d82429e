#include "cli/environment.hpp"

namespace sdlc::cli {

// What a module of 32 bits may take.
std::size_t physical_memory_bytes() { return std::size_t{1} << 31; }

}  // namespace sdlc::cli
