#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <benchmark/benchmark.h>

#include "bench/benchmarks.hpp"
#include "bench/sphere_field.hpp"
#include "lang/compile/compile.hpp"
#include "lang/format/format.hpp"
#include "lang/lint/lint.hpp"

// `sdlc fmt` and `sdlc lint` on large files, without file I/O.
namespace sdlc::bench {
namespace {

constexpr int kFormattedSpheres = 90'000;  // 10 MB
constexpr int kLintedSpheres = 1'000'000;

std::string formatted(const lang::Document& file) {
  lang::DiagnosticSink sink;
  std::optional<std::string> text = lang::format_file(file, sink);
  if (!text) throw std::runtime_error(sink.diagnostics().front().message);
  return *std::move(text);
}

void count_bytes(benchmark::State& state, const std::string& text) {
  using benchmark::Counter;
  const auto bytes = static_cast<double>(text.size());
  state.counters["bytes"] = Counter(bytes, Counter::kIsIterationInvariantRate);
}

/// A document that has not been parsed. The copy of the text is not measured.
std::unique_ptr<const lang::Document> fresh_document(benchmark::State& state,
                                                     const std::string& text) {
  state.PauseTiming();
  auto document = std::make_unique<const lang::Document>("field.scene", text);
  state.ResumeTiming();
  return document;
}

void format_text(benchmark::State& state, const std::string& text) {
  for (auto _ : state) benchmark::DoNotOptimize(formatted(*fresh_document(state, text)));
  count_bytes(state, text);
}

void format_a_field(benchmark::State& state) {
  format_text(state, field_as_scene(kFormattedSpheres));
}

void format_what_is_formatted(benchmark::State& state) {
  const lang::Document field("field.scene", field_as_scene(kFormattedSpheres));
  format_text(state, formatted(field));
}

void lint_a_field(benchmark::State& state) {
  const std::string text = field_as_scene(kLintedSpheres);
  for (auto _ : state) {
    const auto file = fresh_document(state, text);
    lang::DiagnosticSink sink;
    lang::Compiler compiler(*file, {}, sink);
    lang::lint(compiler, *file, sink);
    benchmark::DoNotOptimize(sink.diagnostics().size());
  }
  count_bytes(state, text);
  using benchmark::Counter;
  state.counters["spheres"] = Counter(kLintedSpheres, Counter::kIsIterationInvariantRate);
}

}  // namespace

void register_text_benchmarks() {
  using benchmark::RegisterBenchmark;
  RegisterBenchmark("text/format", format_a_field)->Unit(benchmark::kMillisecond);
  RegisterBenchmark("text/format_again", format_what_is_formatted)->Unit(benchmark::kMillisecond);
  RegisterBenchmark("text/lint_1e6_spheres", lint_a_field)
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

}  // namespace sdlc::bench
