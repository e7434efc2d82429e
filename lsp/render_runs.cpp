#include "lsp/render_runs.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <list>
#include <map>
#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "lang/text/display_width.hpp"
#include "lsp/child_process.hpp"
#include "lsp/temporary_folder.hpp"
#include "lsp/uri.hpp"

namespace sdlc::lsp {

namespace fs = std::filesystem;

namespace {

/// Where pictures are written.
class PictureFolder {
 public:
  /// The picture of a scene: the same file each time, so that an editor that shows it reloads it.
  fs::path picture_of(const fs::path& scene) {
    const std::size_t number = numbers_.try_emplace(scene, numbers_.size() + 1).first->second;
    const fs::path folder = folder_.path() / std::to_string(number);
    fs::create_directories(folder);
    const fs::path stem = scene.stem();
    return folder / ((stem.empty() ? "picture" : stem.string()) + ".png");
  }

 private:
  TemporaryFolder folder_;
  std::map<fs::path, std::size_t> numbers_;
};

std::string name_of(const RenderOrder& order) {
  const std::string name = lang::printable(order.scene.filename().string());
  return order.camera.empty() ? name : fmt::format("{}, camera {}", name, order.camera);
}

std::vector<std::string> command_of(const std::string& program, const RenderOrder& order,
                                    const fs::path& picture) {
  std::vector<std::string> command{program, "render"};
  if (order.text) {
    command.insert(command.end(), {"-", "--stdin-filename=" + order.scene.string()});
  } else {
    command.push_back(order.scene.string());
  }
  command.insert(command.end(), {"--output=" + picture.string(), "--progress=json", "--overwrite",
                                 "--format=concise"});
  if (!order.camera.empty()) command.push_back("--camera=" + order.camera);
  if (order.frame) command.push_back(fmt::format("--frames={}", *order.frame));
  if (order.threads > 0) command.push_back(fmt::format("--threads={}", order.threads));
  if (order.is_sandboxed) command.emplace_back("--sandbox");
  return command;
}

/// "12 s left"
std::string time_left(const Json& progress) {
  const auto left = progress.find("eta_seconds");
  if (left == progress.end() || !left->is_number()) return "";
  const double seconds = left->get<double>();
  return seconds < 100 ? fmt::format("{:.0f} s left", seconds)
                       : fmt::format("{:.0f} min left", seconds / 60);
}

}  // namespace

/// Work for the thread, which waits for it in poll().
class RenderRuns::Jobs {
 public:
  using Job = std::function<void(Runner&)>;

  void add(Job job) {
    const std::scoped_lock lock(mutex_);
    jobs_.push_back(std::move(job));
    wake();
  }
  void end() {
    const std::scoped_lock lock(mutex_);
    is_ended_ = true;
    wake();
  }
  bool is_ended() const {
    const std::scoped_lock lock(mutex_);
    return is_ended_;
  }
  std::vector<Job> take() {
    const std::scoped_lock lock(mutex_);
    if (std::exchange(is_awake_, false)) {
      char byte = 0;
      [[maybe_unused]] const auto size = ::read(wake_.out.number(), &byte, 1);
    }
    return std::exchange(jobs_, {});
  }
  /// Readable if there is something to do.
  int descriptor() const noexcept { return wake_.out.number(); }

 private:
  void wake() {
    if (std::exchange(is_awake_, true)) return;
    [[maybe_unused]] const auto size = ::write(wake_.in.number(), "!", 1);
  }

  Pipe wake_ = Pipe::make();
  mutable std::mutex mutex_;
  std::vector<Job> jobs_;
  bool is_ended_ = false;
  bool is_awake_ = false;  // there is a byte in the pipe
};

/// The thread of the renders. It starts their processes, because a process ends with the thread
/// that started it.
class RenderRuns::Runner {
 public:
  Runner(std::shared_ptr<Jobs> jobs, std::string program, Notify notify, Request request)
      : jobs_(std::move(jobs)),
        program_(std::move(program)),
        notify_(std::move(notify)),
        request_(std::move(request)) {}

  void run() {
    while (true) {
      for (const Jobs::Job& job : jobs_->take()) job(*this);
      if (jobs_->is_ended()) return;
      std::vector<pollfd> waits{{.fd = jobs_->descriptor(), .events = POLLIN, .revents = 0}};
      for (const Run& run : runs_) {
        waits.push_back({.fd = run.child->descriptor(), .events = POLLIN, .revents = 0});
      }
      ::poll(waits.data(), waits.size(), -1);
      auto wait = waits.begin() + 1;
      for (auto run = runs_.begin(); run != runs_.end(); ++wait) {
        const bool has_ended = wait->revents != 0 && !read(*run);
        run = has_ended ? runs_.erase(run) : std::next(run);
      }
    }
  }

  void start(RenderOrder order, const Abilities& abilities) {
    const auto older =
        std::ranges::find(runs_, order.scene, [](const Run& run) { return run.order.scene; });
    if (older != runs_.end()) {
      end_progress(*older, "replaced");
      runs_.erase(older);
    }
    Run run{.order = std::move(order),
            .abilities = abilities,
            .token = fmt::format("sdlc-render-{}", ++count_)};
    try {
      run.picture = pictures_.picture_of(run.order.scene);
      run.child = std::make_unique<ChildProcess>(
          command_of(program_, run.order, run.picture),
          run.order.text ? std::string_view(*run.order.text) : std::string_view());
    } catch (const std::system_error& error) {
      return show_failure(run, error.what());
    }
    run.order.text.reset();
    if (abilities.has_progress) ask_for_progress(run.token);
    runs_.push_back(std::move(run));
  }

  void cancel(const std::string& token) {
    const auto run = std::ranges::find(runs_, token, &Run::token);
    if (run == runs_.end()) return;
    end_progress(*run, "cancelled");
    runs_.erase(run);  // and kills it
  }

 private:
  struct Run {
    RenderOrder order;
    Abilities abilities;
    std::string token;
    fs::path picture = {};
    std::unique_ptr<ChildProcess> child = nullptr;
    std::string line = {};                ///< of the standard error, so far
    std::vector<std::string> lines = {};  ///< without progress
    bool has_progress = false;            ///< begun
  };

  // Progress

  void ask_for_progress(const std::string& token) {
    const std::weak_ptr<Jobs> jobs = jobs_;
    request_("window/workDoneProgress/create", {{"token", token}},
             [jobs, token](const Json* result) {
               if (result == nullptr) return;  // the client shows no progress after all
               if (const auto held = jobs.lock()) {
                 held->add([token](Runner& runner) { runner.begin_progress(token); });
               }
             });
  }

  void begin_progress(const std::string& token) {
    const auto run = std::ranges::find(runs_, token, &Run::token);
    if (run == runs_.end()) return;
    run->has_progress = true;
    send_progress(*run, {{"kind", "begin"},
                         {"title", "Rendering " + name_of(run->order)},
                         {"cancellable", true},
                         {"percentage", 0}});
  }

  void report_progress(const Run& run, const Json& progress) {
    const auto fraction = progress.find("fraction");
    if (!run.has_progress || fraction == progress.end() || !fraction->is_number()) return;
    const double percentage = std::clamp(fraction->get<double>() * 100, 0.0, 100.0);
    send_progress(run, {{"kind", "report"},
                        {"message", time_left(progress)},
                        {"percentage", static_cast<int>(percentage)}});
  }

  void end_progress(const Run& run, const std::string& message) {
    if (run.has_progress) send_progress(run, {{"kind", "end"}, {"message", message}});
  }

  void send_progress(const Run& run, Json value) {
    notify_("$/progress", {{"token", run.token}, {"value", std::move(value)}});
  }

  // Output of a render

  /// Reads what it has written; false at the end, which is handled.
  bool read(Run& run) {
    const std::string part = run.child->read();
    if (part.empty()) {
      if (!run.line.empty()) read_line(run);
      finish(run);
      return false;
    }
    for (const char c : part) {
      if (c == '\n') {
        read_line(run);
      } else if (run.line.size() < kMaxLine) {
        run.line += c;
      }
    }
    return true;
  }

  void read_line(Run& run) {
    const std::string line = std::exchange(run.line, {});
    if (line.starts_with('{')) {
      const Json progress = Json::parse(line, nullptr, false);
      if (progress.is_object()) report_progress(run, progress);
    } else if (!line.empty() && run.lines.size() < kMaxLines) {
      run.lines.push_back(line);
    }
  }

  void finish(Run& run) {
    const int status = run.child->wait();
    end_progress(run, status == 0 ? "done" : "failed");
    if (status == 0) return show_picture(run);
    const auto error = std::ranges::find_if(run.lines, [](const std::string& line) {
      return line.starts_with("error") || line.find(": error") != std::string::npos;
    });
    if (error != run.lines.end()) return show_failure(run, *error);
    if (!run.lines.empty()) return show_failure(run, run.lines.front());
    show_failure(run, status == kNotStarted ? fmt::format("`{}` cannot be started", program_)
                      : status > 128        ? fmt::format("it was ended by signal {}", status - 128)
                                            : fmt::format("exit status {}", status));
  }

  void show_picture(const Run& run) {
    std::error_code error;
    if (!fs::exists(run.picture, error)) return show_failure(run, "there is no picture");
    const std::string message =
        fmt::format("The picture of {} is {}", name_of(run.order), run.picture.string());
    if (!run.abilities.shows_documents) return show_message(MessageType::Info, message);
    const std::weak_ptr<Jobs> jobs = jobs_;
    request_("window/showDocument", {{"uri", uri_of_path(run.picture)}, {"takeFocus", false}},
             [jobs, message](const Json* result) {
               if (result && result->is_object() && result->value("success", false)) return;
               if (const auto held = jobs.lock()) {
                 held->add([message](Runner& runner) {
                   runner.show_message(MessageType::Info, message);
                 });
               }
             });
  }

  void show_failure(const Run& run, const std::string& reason) {
    show_message(MessageType::Error,
                 fmt::format("Rendering {} failed: {}", name_of(run.order), reason));
  }

  void show_message(MessageType type, const std::string& text) {
    notify_("window/showMessage", {{"type", static_cast<int>(type)}, {"message", text}});
  }

  static constexpr std::size_t kMaxLine = 2000, kMaxLines = 100;
  static constexpr int kNotStarted = 127;

  std::shared_ptr<Jobs> jobs_;
  const std::string program_;
  const Notify notify_;
  const Request request_;
  PictureFolder pictures_;
  std::list<Run> runs_;
  std::uint64_t count_ = 0;
};

RenderRuns::RenderRuns(std::string program, Notify notify, Request request)
    : jobs_(std::make_shared<Jobs>()),
      thread_([jobs = jobs_, program = std::move(program), notify = std::move(notify),
               request = std::move(request)]() mutable {
        Runner(std::move(jobs), std::move(program), std::move(notify), std::move(request)).run();
      }) {}

RenderRuns::~RenderRuns() {
  jobs_->end();
  thread_.join();
}

void RenderRuns::start(RenderOrder order, const Abilities& abilities) {
  jobs_->add(
      [order = std::move(order), abilities](Runner& runner) { runner.start(order, abilities); });
}

void RenderRuns::cancel(const Json& token) {
  if (!token.is_string()) return;
  jobs_->add([name = token.get<std::string>()](Runner& runner) { runner.cancel(name); });
}

}  // namespace sdlc::lsp
