#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/sphere_field.hpp"
#include "lang/compile/compile.hpp"
#include "lang/workspace/workspace.hpp"

// Speed and memory of compiling texts to scenes for the renderer. The baseline for a megabyte is
// the time of nlohmann::json to parse the same JSON to its tree. Single-threaded; competitors run
// interleaved, and medians are reported.
namespace sdlc::bench {
namespace {

struct Options {
  int spheres = 1000000;
  int repeats = 5;
};

lang::LoweredScene compile(const lang::Document& file, int spheres) {
  lang::DiagnosticSink sink;
  const lang::DiskFileSystem disk;
  lang::Workspace workspace(disk);
  lang::ProgramOptions program;
  program.workspace = &workspace;
  program.limits.file = program.limits.config = file.text().size();
  std::optional<lang::LoweredScene> scene = lang::Compiler(file, program, sink).lower({});
  if (!scene) throw std::runtime_error(sink.diagnostics().front().message);
  if (scene->scene.spheres.size() != static_cast<std::size_t>(spheres)) {
    throw std::runtime_error(fmt::format("{}: spheres are missing", file.name()));
  }
  return std::move(*scene);
}

/// A number of bytes that the system reports for this process, such as VmHWM, its peak memory.
double process_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key + ":")) return std::stod(line.substr(key.size() + 1)) * 1024;
  }
  throw std::runtime_error("/proc/self/status has no " + key);
}

/// The peak memory of making and compiling a text, in multiples of that text. Runs in a separate
/// process, because memory freed by an earlier compilation would not count. Call it before the
/// process has allocated any.
double measure_memory(const std::string& name, std::string (*make_text)(int), int spheres) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) {
    const double before = process_bytes("VmRSS");
    const lang::Document file(name, make_text(spheres));
    compile(file, spheres);
    const double multiple =
        (process_bytes("VmHWM") - before) / static_cast<double>(file.text().size());
    _exit(write(ends[1], &multiple, sizeof multiple) == sizeof multiple ? 0 : 1);
  }
  close(ends[1]);
  double multiple = 0;
  const bool is_read = read(ends[0], &multiple, sizeof multiple) == sizeof multiple;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  if (!is_read) throw std::runtime_error("the child process failed");
  return multiple;
}

/// The time to construct something, without the time to destroy it.
template <typename Make>
double seconds_to(const Make& make) {
  const auto begin = std::chrono::steady_clock::now();
  [[maybe_unused]] const auto made = make();
  const auto end = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(end - begin).count();
}

/// A folder that is removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "sdlc-bench-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

/// The time to compile a text that has not been parsed.
double seconds_to_compile(const lang::SourceFile& file, int spheres) {
  const lang::Document fresh(file.name(), std::string(file.text()));
  return seconds_to([&] { return compile(fresh, spheres); });
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The medians of the functions' results; the functions are called interleaved.
std::vector<double> measure_in_turns(int repeats,
                                     const std::vector<std::function<double()>>& functions) {
  std::vector<std::vector<double>> results(functions.size());
  for (int i = 0; i < repeats; ++i) {
    for (std::size_t k = 0; k < functions.size(); ++k) results[k].push_back(functions[k]());
  }
  std::vector<double> medians;
  for (const auto& values : results) medians.push_back(median(values));
  return medians;
}

Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view name = argv[i];
    int* value = name == "--spheres"   ? &options.spheres
                 : name == "--repeats" ? &options.repeats
                                       : nullptr;
    if (value == nullptr || i + 1 == argc || (*value = std::atoi(argv[i + 1])) < 1) {
      throw std::runtime_error("usage: compile_benchmark [--spheres N] [--repeats N]");
    }
  }
  return options;
}

void run(const Options& options) {
  const int spheres = options.spheres;
  const double json_memory = measure_memory("field.json", field_as_json, spheres);
  const double scene_memory = measure_memory("field.scene", field_as_scene, spheres);

  const lang::SourceFile json("field.json", field_as_json(spheres));
  const lang::SourceFile scene("field.scene", field_as_scene(spheres));
  const lang::SourceFile loop("loop.scene", loop_as_scene(spheres));
  const lang::SourceFile lists("lists.scene", comprehension_as_scene(spheres));
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "field.csv") << field_as_csv(spheres);
  const lang::SourceFile data((folder.path() / "data.scene").string(), data_as_scene());
  const auto seconds = measure_in_turns(
      options.repeats,
      {[&] { return seconds_to([&] { return nlohmann::json::parse(json.text()); }); },
       [&] { return seconds_to_compile(json, spheres); },
       [&] { return seconds_to_compile(scene, spheres); },
       [&] { return seconds_to_compile(loop, spheres); },
       [&] { return seconds_to_compile(lists, 1); },
       [&] { return seconds_to_compile(data, spheres); }});

  const auto speed = [](const lang::SourceFile& file, double time) {
    return static_cast<double>(file.text().size()) / time / 1e6;
  };
  const double json_speed = speed(json, seconds[1]), peer_speed = speed(json, seconds[0]);
  const double scene_speed = speed(scene, seconds[2]);
  fmt::print("{} spheres, medians of {}\n", spheres, options.repeats);
  fmt::print("nlohmann::json         {:8.1f} MB/s\n", peer_speed);
  fmt::print("JSON to scene          {:8.1f} MB/s  {:5.2f} times nlohmann (at least 1.5)\n",
             json_speed, json_speed / peer_speed);
  fmt::print("scene text to scene    {:8.1f} MB/s  {:5.2f} times nlohmann (at least 0.6)\n",
             scene_speed, scene_speed / peer_speed);
  fmt::print("loop to scene          {:8.2f} million spheres/s (at least 2)\n",
             spheres / seconds[3] / 1e6);
  fmt::print("lists of its values    {:8.2f} times the time of the loop (at most 1)\n",
             seconds[4] / seconds[3]);
  fmt::print(
      "rows of a data file    {:8.2f} times the time of the loop (at most 2; reading included)\n",
      seconds[5] / seconds[3]);
  fmt::print("peak memory of JSON    {:8.2f} times the text, itself included (at most 6)\n",
             json_memory);
  fmt::print("peak memory of scene   {:8.2f} times the text, itself included (at most 6)\n",
             scene_memory);
}

}  // namespace
}  // namespace sdlc::bench

int main(int argc, char** argv) {
  try {
    sdlc::bench::run(sdlc::bench::read_options(argc, argv));
  } catch (const std::exception& error) {
    fmt::print(stderr, "compile_benchmark: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
