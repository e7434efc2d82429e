#include <cstdlib>

#include <benchmark/benchmark.h>

#include "bench/benchmarks.hpp"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return EXIT_FAILURE;
  sdlc::bench::register_intersection_benchmarks();
  sdlc::bench::register_material_benchmarks();
  sdlc::bench::register_feature_benchmarks();
  sdlc::bench::register_sampling_benchmarks();
  sdlc::bench::register_text_benchmarks();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return EXIT_SUCCESS;
}
