#include "lang/compile/compile.hpp"

#include <chrono>

#include "lang/eval/eval.hpp"
#include "lang/json/json.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

std::optional<LoweredScene> compile(const SourceFile& file, const Overrides& overrides,
                                    DiagnosticSink& sink, CompileTimes& times) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  SceneBuilder builder(file, sink);
  switch (file.format()) {
    case SourceFormat::Json: read_config(file, builder, sink); break;
    case SourceFormat::Scene: evaluate(parse(file, sink), builder, sink); break;
  }
  const auto parsed = Clock::now();
  std::optional<LoweredScene> lowered = builder.finish(overrides);
  const auto seconds = [](auto duration) {
    return std::chrono::duration<double>(duration).count();
  };
  times = {.parse_seconds = seconds(parsed - start),
           .lower_seconds = seconds(Clock::now() - parsed)};
  return lowered;
}

}  // namespace sdlc::lang
