#include "lsp/child_process.hpp"

#include <system_error>

// A page starts no programs: renders of the language server are refused.
namespace sdlc::lsp {

Descriptor::~Descriptor() = default;
Descriptor::Descriptor(Descriptor&& /*other*/) noexcept {}
Descriptor& Descriptor::operator=(Descriptor&& /*other*/) noexcept { return *this; }

Pipe Pipe::make() { throw std::system_error(std::make_error_code(std::errc::not_supported)); }

ChildProcess::ChildProcess(const std::vector<std::string>& /*command*/,
                           std::string_view /*input*/) {
  throw std::system_error(std::make_error_code(std::errc::not_supported));
}
ChildProcess::ChildProcess(const std::vector<std::string>& command) : ChildProcess(command, {}) {}
ChildProcess::~ChildProcess() = default;

std::string ChildProcess::read() { return {}; }
bool ChildProcess::write(std::string_view /*text*/, int /*milliseconds*/) { return false; }
int ChildProcess::wait() { return 1; }
void ChildProcess::kill() noexcept {}

}  // namespace sdlc::lsp
