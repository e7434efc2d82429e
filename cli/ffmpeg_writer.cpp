#include "cli/ffmpeg_writer.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <initializer_list>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "render/image/io_error.hpp"
#include "render/math/clock.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "ffmpeg";
// The bytes of H.264 and VP9 depend on the number of threads, and must not on the machine.
constexpr const char* kThreads = "8";

constexpr std::array kMuxers{"mp4", "webm", "matroska", "gif", "webp", "apng"};  // by VideoFormat

/// Whether 2 × 2 pixels share their colours.
bool shares_colors(VideoFormat format) noexcept {
  return format == VideoFormat::Mp4 || format == VideoFormat::WebM ||
         format == VideoFormat::Matroska;
}

bool is_executable(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && ::access(path.c_str(), X_OK) == 0;
}

[[noreturn]] void fail(const fs::path& path, int error) {
  throw render::IoError("write", path, std::error_code(error, std::generic_category()));
}

/// The time that the process has computed, in nanoseconds.
std::int64_t computing_time(pid_t process) {
  clockid_t clock{};
  timespec time{};
  if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0;
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

/// Decides when an ffmpeg that hangs is given up after an interruption.
class Patience {
 public:
  explicit Patience(const std::atomic<bool>* interrupted) : interrupted_(interrupted) {}

  /// Whether it has not changed `progress` for long.
  bool is_over(std::int64_t progress) {
    constexpr double kMaxSeconds = 5;
    const bool is_interrupted = interrupted_ != nullptr && interrupted_->load();
    if (!is_interrupted || std::exchange(progress_, progress) != progress) {
      since_ = render::Clock::now();
    }
    return render::seconds_since(since_) > kMaxSeconds;
  }

 private:
  const std::atomic<bool>* interrupted_;
  std::int64_t progress_ = 0;
  render::Clock::time_point since_ = render::Clock::now();
};

}  // namespace

std::vector<std::string> ffmpeg_arguments(VideoFormat format, const VideoSettings& settings,
                                          const fs::path& file) {
  std::vector<std::string> arguments;
  const auto add = [&](std::initializer_list<std::string> words) {
    arguments.insert(arguments.end(), words);
  };
  // -xerror: otherwise the status is 0 although the end of the file could not be written.
  add({"-nostdin", "-xerror", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24",
       "-video_size", fmt::format("{}x{}", settings.width, settings.height), "-framerate",
       fmt::format("{}", settings.frames_per_second), "-i", "pipe:0"});
  if (shares_colors(format)) {
    const int right = settings.width % 2, bottom = settings.height % 2;
    std::string filter;
    if (right + bottom > 0) {
      filter = fmt::format("pad={}:{},fillborders=right={}:bottom={}:mode=smear,",
                           settings.width + right, settings.height + bottom, right, bottom);
    }
    filter +=
        "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int+"
        "full_chroma_inp,format=yuv420p";
    add({"-vf", filter, "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
         "-color_range", "tv"});
    const std::string crf = fmt::to_string(settings.crf);
    add({"-threads", kThreads});
    if (format == VideoFormat::WebM) {
      add({"-c:v", "libvpx-vp9", "-b:v", "0", "-crf", crf, "-row-mt", "1"});
    } else {
      add({"-c:v", "libx264", "-crf", crf});
    }
    if (format == VideoFormat::Mp4) add({"-movflags", "+faststart"});
  } else if (format == VideoFormat::Gif) {
    // One palette for all frames keeps all of them in memory, with four bytes a pixel.
    constexpr double kMaxBytes = 1 << 30;
    const bool is_one =
        4.0 * settings.width * settings.height * static_cast<double>(settings.frames) <= kMaxBytes;
    add({"-vf",
         fmt::format("split[a][b];[a]palettegen=stats_mode={}[p];[b][p]paletteuse=dither=none{}",
                     is_one ? "full" : "single", is_one ? "" : ":new=1"),
         "-loop", "0"});
  } else if (format == VideoFormat::WebP) {
    add({"-c:v", "libwebp_anim", "-lossless", "1", "-loop", "0"});
  } else {
    add({"-c:v", "apng", "-pix_fmt", "rgb24", "-plays", "0"});
  }
  // The same frames give the same bytes: without dates and versions.
  add({"-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact"});
  add({"-f", kMuxers[static_cast<std::size_t>(format)], "-y", file.string()});
  return arguments;
}

bool has_ffmpeg() {
  const char* const path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    if (is_executable(fs::path(rest.substr(0, end)) / kProgram)) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

FfmpegWriter::FfmpegWriter(const fs::path& path, VideoFormat format, const VideoSettings& settings)
    : frames_per_second_(settings.frames_per_second),
      shown_(path),
      file_(path),
      interrupted_(settings.interrupted) {
  // A socket, because writing to it when ffmpeg has ended need not raise a signal.
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) fail(path, errno);
  input_ = ends[0];
  // Absolute, because ffmpeg takes what is before a colon as a protocol.
  const std::vector<std::string> arguments =
      ffmpeg_arguments(format, settings, fs::absolute(file_.temporary()));
  std::vector<char*> words{const_cast<char*>(kProgram)};
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  // Ctrl-C is for this program, which then ends ffmpeg.
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int error =
      ::posix_spawnp(&process_, kProgram, &actions, &attributes, words.data(), ::environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (error == 0) {
    killed_.emplace(process_);
    return;
  }
  process_ = -1;
  ::close(input_);
  fail(path, error);
}

FfmpegWriter::~FfmpegWriter() {
  if (input_ >= 0) ::close(input_);
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    reap(0);
  }
}

void FfmpegWriter::add(std::span<const std::uint8_t> frame) {
  constexpr int kPollMilliseconds = 100;
  Patience patience(interrupted_);
  while (!frame.empty()) {
    const ssize_t sent = ::send(input_, frame.data(), frame.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) {
      frame = frame.subspan(static_cast<std::size_t>(sent));
    } else if (errno == EAGAIN) {
      pollfd ready{.fd = input_, .events = POLLOUT, .revents = 0};
      ::poll(&ready, 1, kPollMilliseconds);
      if (patience.is_over(computing_time(process_))) give_up();
    } else if (errno != EINTR) {
      fail_encoding("ffmpeg ended early");
    }
  }
}

void FfmpegWriter::finish() {
  ::close(std::exchange(input_, -1));
  if (!wait()) fail_encoding("ffmpeg failed");
  file_.commit();
}

void FfmpegWriter::fail_encoding(const char* cause) const {
  constexpr std::uintmax_t kFull = 1 << 16;  // bytes; the file was larger
  std::error_code error;
  const fs::space_info space = fs::space(fs::absolute(file_.temporary()).parent_path(), error);
  if (!error && space.available < kFull) fail(shown_, ENOSPC);
  throw render::IoError("write", shown_, cause);
}

void FfmpegWriter::give_up() const {
  throw render::IoError("write", shown_,
                        "ffmpeg did nothing for 5 s after the interruption, and was ended");
}

bool FfmpegWriter::wait() {
  Patience patience(interrupted_);
  for (;;) {
    if (const std::optional<bool> has_succeeded = reap(WNOHANG)) return *has_succeeded;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (patience.is_over(computing_time(process_))) give_up();
  }
}

std::optional<bool> FfmpegWriter::reap(int flags) noexcept {
  siginfo_t ended{};
  while (::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOWAIT | flags) != 0) {
    if (errno != EINTR) return false;
  }
  if (ended.si_pid != process_) return std::nullopt;
  killed_.reset();  // while no other process can have its number
  int status = 0;
  ::waitpid(std::exchange(process_, -1), &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace sdlc::cli
