#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace sdlc::lsp {

/// An open file of the system; closed at the end.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) noexcept : number_(number) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;

  int number() const noexcept { return number_; }
  bool is_open() const noexcept { return number_ >= 0; }

 private:
  int number_ = -1;
};

/// A pipe: what is written to `in` can be read from `out`. Throws std::system_error.
struct Pipe {
  Descriptor out, in;

  static Pipe make();
};

/// A program that runs beside this one, in the background (nice 5). It is killed when it is
/// destroyed, or when the thread that started it ends. Constructors throw std::system_error if the
/// system has no resources for it; a program that cannot be started ends with status 127.
class ChildProcess {
 public:
  /// Starts a program, given by its path, which gets `input` as its standard input. What it writes
  /// is its standard error; its standard output is dropped.
  ChildProcess(const std::vector<std::string>& command, std::string_view input);
  /// Starts a program to talk to: write() is its standard input, and what it writes is its standard
  /// output; its standard error is dropped.
  explicit ChildProcess(const std::vector<std::string>& command);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Readable if there is more that it writes.
  int descriptor() const noexcept { return from_.number(); }
  /// The next part of what it writes, at least a byte; empty at the end, which is the end of the
  /// program. Blocks only if descriptor() is not readable.
  std::string read();
  /// Returns false if the program has ended, or has read nothing for `milliseconds`: then a part is
  /// missing, and no more can be written. Precondition: SIGPIPE is ignored.
  bool write(std::string_view text, int milliseconds);
  /// Waits for the end. The exit status, or 128 + n after signal n.
  int wait();
  void kill() noexcept;

 private:
  void start(const std::vector<std::string>& command, int input, int output, int errors);

  pid_t process_ = -1;
  std::optional<int> status_;
  Descriptor from_, to_;
};

}  // namespace sdlc::lsp
