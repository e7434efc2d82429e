#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/lint/lint.hpp"
#include "lang/workspace/workspace.hpp"

// What somebody who types waits for: one character of a scene of 5,000 lines changes, and the
// diagnostics of the scene with its imports are ready again. Also how long a request to stop may
// wait for the next poll. Single-threaded; processor time.
namespace sdlc::bench {
namespace {

using Texts = std::map<std::string, std::string>;

constexpr int kLines = 5'000;
constexpr const char* kRoot = "root.scene";

/// Processor time of this process: other programs do not count.
double milliseconds() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

class MemoryFiles final : public lang::FileSystem {
 public:
  explicit MemoryFiles(Texts texts) : texts_(std::move(texts)) {}
  std::optional<std::string> read(const std::filesystem::path& path, std::uint64_t /*most*/,
                                  std::error_code& error) const override {
    const auto found = texts_.find(path.generic_string());
    if (found != texts_.end()) return found->second;
    error = std::make_error_code(std::errc::no_such_file_or_directory);
    return std::nullopt;
  }

 private:
  Texts texts_;
};

/// 500 lines of values, functions and kinds.
std::string library(std::string_view import) {
  std::string text = fmt::format("scene 1\n{}", import);
  for (int i = 0; i < 124; ++i) {
    text += fmt::format(
        "/// Number {0}.\nlet value{0} = {0} * 0.5 + 1\n"
        "fn curve{0}(x) = value{0} * sin(x * 1deg) ^ 2\n"
        "def pair{0}(gap = 1) {{ sphere {{ center: (gap, 0, 0), radius: 0.1 }} }}\n",
        i);
  }
  return text;
}

/// Half of the lines are spheres, the others what people write around them.
std::string scene() {
  std::string text =
      "scene 1\nimport \"shapes.scene\" as shapes\nimport \"paints.scene\" as paints\n"
      "camera main { from: (0, 40, 300), at: (0, 0, 0), fov: 40deg }\nbackground { color: white "
      "}\n";
  for (int i = 0; std::ranges::count(text, '\n') < kLines - 9; ++i) {
    const int x = i % 50 * 4, z = i / 50 * 4;
    text += fmt::format("// Row {0}\nlet size{0} = 0.25 + shapes.value{1} / 400\n", i, i % 124);
    text += "group { material: diffuse(color: rgb(200, 100, 50))\n";
    for (int k = 0; k < 5; ++k) {
      text += fmt::format("  sphere {{ center: ({}, {}, {}), radius: size{} }}\n", x, k * 3, z, i);
    }
    text +=
        fmt::format("  shapes.pair{} {{ gap: 2, translate: ({}, 0, {}) }}\n}}\n", i % 124, x, z);
  }
  return text +
         "for i in range(99) { sphere { center: (0, -9 - i, 0), radius: 0.3, "
         "material: unlit(red) } }\n";
}

std::size_t diagnostics_of(lang::Workspace& workspace, const lang::StopRequest* stop) {
  std::error_code error;
  const auto document = workspace.load(kRoot, lang::Limits().any_file(), error);
  lang::DiagnosticSink sink(stop);
  lang::Compiler compiler(*document, {.workspace = &workspace, .limits = {}}, sink);
  lang::lint(compiler, *document, sink);
  return select_unallowed(sink).shown.size();
}

/// Notes the longest time between two polls.
class PollClock final : public lang::StopRequest {
 public:
  bool is_made() const override {
    longest_ = longest();
    last_ = milliseconds();
    return false;
  }
  double longest() const { return std::max(longest_, milliseconds() - last_); }

 private:
  mutable double last_ = milliseconds();
  mutable double longest_ = 0;
};

/// Replaces a letter or digit at a random place by another one: sometimes a mistake, mostly not.
void change_a_character(std::string& text, std::minstd_rand& random) {
  while (true) {
    char& c = text[random() % text.size()];
    const bool is_digit = c >= '0' && c <= '9';
    if (!is_digit && !(c >= 'a' && c <= 'z')) continue;
    c = static_cast<char>(is_digit ? '1' + random() % 9 : 'a' + random() % 26);
    return;
  }
}

void print_times(std::string_view what, std::vector<double> times) {
  std::ranges::sort(times);
  fmt::print("{:24} median {:6.2f} ms, p95 {:6.2f} ms, max {:6.2f} ms\n", what,
             times[times.size() / 2], times[times.size() * 95 / 100], times.back());
}

void run(int edits) {
  const std::string original = scene();
  const MemoryFiles files({{"shapes.scene", library("import \"paints.scene\" as paints\n")},
                           {"paints.scene", library("")}});
  lang::Workspace workspace(files);
  workspace.open(kRoot, original);
  diagnostics_of(workspace, nullptr);
  std::minstd_rand random(7);
  std::vector<double> times, stops;
  std::size_t found = 0;
  for (int i = 0; i < edits; ++i) {
    std::string text = original;
    change_a_character(text, random);
    const double begin = milliseconds();
    workspace.open(kRoot, text, i);
    found += diagnostics_of(workspace, nullptr);
    times.push_back(milliseconds() - begin);

    workspace.open(kRoot, text + ' ', i);
    const PollClock clock;
    diagnostics_of(workspace, &clock);
    stops.push_back(clock.longest());
  }
  fmt::print("{} lines, {} bytes, {} edits, {} diagnostics\n", std::ranges::count(original, '\n'),
             original.size(), edits, found);
  print_times("diagnostics (p95 < 30)", std::move(times));
  print_times("answer to a stop (< 10)", std::move(stops));
}

}  // namespace
}  // namespace sdlc::bench

int main(int argc, char** argv) {
  const int edits = argc > 1 ? std::atoi(argv[1]) : 200;
  if (edits < 1) {
    fmt::print(stderr, "usage: latency_benchmark [EDITS]\n");
    return EXIT_FAILURE;
  }
  sdlc::bench::run(edits);
  return EXIT_SUCCESS;
}
