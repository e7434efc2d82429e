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

/// A program that runs beside this one, in the background (nice 5), with its standard output
/// dropped. It is killed when it is destroyed, or when the thread that started it ends.
class ChildProcess {
 public:
  /// Starts a program, given by its path, which gets `input` as its standard input. Throws
  /// std::system_error if the system has no resources for it; a program that cannot be started ends
  /// with status 127.
  ChildProcess(const std::vector<std::string>& command, std::string_view input);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Readable if there is more of the standard error.
  int error_descriptor() const noexcept { return errors_.number(); }
  /// The next part of the standard error, at least a byte; empty at its end, which is the end of
  /// the program. Blocks only if error_descriptor() is not readable.
  std::string read_errors();
  /// Waits for the end. The exit status, or 128 + n after signal n.
  int wait();
  void kill() noexcept;

 private:
  pid_t process_ = -1;
  std::optional<int> status_;
  Descriptor errors_;
};

}  // namespace sdlc::lsp
