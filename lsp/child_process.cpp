#include "lsp/child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sdlc::lsp {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// A file in memory with this content: a reader needs nobody who writes at the same time.
Descriptor file_of(std::string_view content) {
  Descriptor file(::memfd_create("input", MFD_CLOEXEC));
  if (!file.is_open()) fail("memfd_create");
  while (!content.empty()) {
    const ssize_t written = ::write(file.number(), content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("write");
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  ::lseek(file.number(), 0, SEEK_SET);
  return file;
}

Descriptor nowhere() {
  Descriptor file(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  if (!file.is_open()) fail("open /dev/null");
  return file;
}

/// In the new process: only calls that are safe between fork and exec of a program with threads.
[[noreturn]] void become(char* const* command, int input, int output, int errors, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);  // it ended before the line above
  ::dup2(input, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(errors, STDERR_FILENO);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  constexpr int kNice = 5;
  ::setpriority(PRIO_PROCESS, 0, kNice);
  ::execv(command[0], command);
  ::_exit(127);
}

}  // namespace

Descriptor::~Descriptor() {
  if (is_open()) ::close(number_);
}

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

Pipe Pipe::make() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("pipe");
  return {.out = Descriptor(ends[0]), .in = Descriptor(ends[1])};
}

ChildProcess::ChildProcess(const std::vector<std::string>& command, std::string_view input) {
  const Descriptor in = file_of(input);
  const Descriptor out = nowhere();
  Pipe errors = Pipe::make();
  start(command, in.number(), out.number(), errors.in.number());
  from_ = std::move(errors.out);
}

ChildProcess::ChildProcess(const std::vector<std::string>& command) {
  const Descriptor errors = nowhere();
  Pipe in = Pipe::make(), out = Pipe::make();
  start(command, in.out.number(), out.in.number(), errors.number());
  ::fcntl(in.in.number(), F_SETFL, O_NONBLOCK);
  to_ = std::move(in.in);
  from_ = std::move(out.out);
}

void ChildProcess::start(const std::vector<std::string>& command, int input, int output,
                         int errors) {
  std::vector<char*> arguments;
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ < 0) fail("fork");
  if (process_ == 0) become(arguments.data(), input, output, errors, parent);
}

ChildProcess::~ChildProcess() {
  kill();
  wait();
}

std::string ChildProcess::read() {
  std::string part(4096, '\0');
  ssize_t size = 0;
  do {
    size = ::read(from_.number(), part.data(), part.size());
  } while (size < 0 && errno == EINTR);
  part.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return part;
}

bool ChildProcess::write(std::string_view text, int milliseconds) {
  while (!text.empty()) {
    pollfd ready{.fd = to_.number(), .events = POLLOUT, .revents = 0};
    if (::poll(&ready, 1, milliseconds) <= 0) return false;
    const ssize_t size = ::write(to_.number(), text.data(), text.size());
    if (size < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (size <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(size));
  }
  return true;
}

int ChildProcess::wait() {
  if (status_) return *status_;
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return *status_;
}

void ChildProcess::kill() noexcept {
  if (!status_) ::kill(process_, SIGKILL);
}

}  // namespace sdlc::lsp
