#pragma once

/// Registers the groups of benchmarks with Google Benchmark, one per kernel, instruction set and
/// precision that this machine has.
namespace sdlc::bench {

void register_intersection_benchmarks();
void register_material_benchmarks();
void register_feature_benchmarks();
void register_sampling_benchmarks();
void register_text_benchmarks();

}  // namespace sdlc::bench
