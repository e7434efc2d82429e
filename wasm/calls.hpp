#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/overrides.hpp"
#include "lang/program/program.hpp"
#include "lang/workspace/workspace.hpp"
#include "render/kernel/kernel.hpp"

/// The functions of the WebAssembly module: each takes an object of parameters and returns the
/// object that wasm/index.mjs documents. They run on one thread, one at a time; files are those of
/// emscripten in memory.
namespace sdlc::wasm {

using Json = nlohmann::json;

/// A parameter that is missing or wrong. The message is for the caller.
class WrongParameter : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// As in the program, but for calls, because the stack cannot grow
/// (wasm/system/stack_segments.cpp), and for bytes of values and objects: all memory together is at
/// most 2 GB.
inline constexpr lang::Limits kLimits{.memory = std::uint64_t{1} << 28, .calls = 300};

// Parameters that several functions have

/// `limits`, by the names of `--limit`, `sandbox`, and `sets`, values by the names of params.
lang::ProgramOptions program_options(const Json& parameters, lang::Workspace& workspace);
/// The text of `file`; limits are those of `options`. Throws WrongParameter if it cannot be read.
std::shared_ptr<const lang::Document> read_file(const Json& parameters,
                                                const lang::ProgramOptions& options);
/// `render`, properties by their names, and `seconds`, `adaptive`, `denoise`, `pose`, as the flags
/// of `sdlc render`. Throws WrongParameter.
lang::Overrides overrides_of(const Json& parameters);
/// `kernel`, as `--kernel`.
render::KernelRequest request_of(const Json& parameters);
/// What `sdlc lint --format json` prints, of findings that no comment allows.
Json findings_json(const lang::DiagnosticSink& sink);

// language.cpp

Json lint(const Json& parameters);
Json fix(const Json& parameters);
Json format(const Json& parameters);
Json convert(const Json& parameters);
Json explain(const Json& parameters);

// language_server.cpp

Json receive(const Json& parameters);

// render_session.cpp

Json start_render(const Json& parameters);
Json step_render(const Json& parameters);
Json pick(const Json& parameters);
Json end_render(const Json& parameters);
/// The picture after the last step: red, green, blue and 255 of each pixel, row by row from the
/// top.
std::span<const std::uint8_t> rendered_pixels();

// preview.cpp

Json start_preview(const Json& parameters);
Json change_preview(const Json& parameters);
Json send_to_preview(const Json& parameters);
Json step_preview(const Json& parameters);
/// The binary message of docs/serve.md that the last step has made.
std::span<const std::uint8_t> preview_picture();

}  // namespace sdlc::wasm
