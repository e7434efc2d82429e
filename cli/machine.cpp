#include "cli/machine.hpp"

#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <sys/utsname.h>

#include "cli/environment.hpp"
#include "cli/numbers/format_numbers.hpp"

namespace sdlc::cli {
namespace {

/// The value of the first line "model name : …".
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> describe_machine() {
  std::vector<std::pair<std::string, std::string>> machine{
      {"processor", processor_name()},
      {"cores", fmt::to_string(std::thread::hardware_concurrency())},
      {"memory", format_bytes(physical_memory_bytes())}};
  utsname system{};
  if (uname(&system) == 0) {
    machine.emplace_back("system", fmt::format("{} {}", system.sysname, system.machine));
  }
  return machine;
}

}  // namespace sdlc::cli
