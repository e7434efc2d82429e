#pragma once

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace sdlc::render {

/// An I/O failure: a file that cannot be read or written, a codec that is missing or fails. The
/// message reads "cannot write `out/a.png`: No space left on device".
class IoError : public std::runtime_error {
 public:
  /// `action` is the verb of the message ("write"), `cause` its last part, used verbatim.
  IoError(const std::string& action, const std::filesystem::path& path, const std::string& cause)
      : std::runtime_error("cannot " + action + " `" + path.string() + "`: " + cause),
        path_(path),
        cause_(cause) {}

  /// An error of the system, such as ENOSPC.
  IoError(const std::string& action, const std::filesystem::path& path, std::error_code error)
      : IoError(action, path, error.message()) {
    error_ = error;
  }

  /// Whether trying again may help: the disk was full.
  bool may_pass() const noexcept {
    return error_ == std::errc::no_space_on_device ||
           error_ == std::error_code(EDQUOT, std::generic_category());
  }
  /// The file as the user named it.
  const std::filesystem::path& path() const noexcept { return path_; }
  const std::string& cause() const noexcept { return cause_; }

 private:
  std::filesystem::path path_;
  std::string cause_;
  std::error_code error_;
};

}  // namespace sdlc::render
