#include <cstdint>
#include <new>
#include <string>
#include <string_view>

#include <emscripten/emscripten.h>

#include "lang/report/report.hpp"
#include "wasm/calls.hpp"

namespace sdlc::wasm {
namespace {

Json version(const Json& /*parameters*/) { return {{"version", SDLC_VERSION}}; }

struct Call {
  std::string_view name;
  Json (*function)(const Json& parameters);
};

constexpr Call kCalls[] = {
    {"version", version},
    {"lint", lint},
    {"fix", fix},
    {"format", format},
    {"convert", convert},
    {"explain", explain},
    {"receive", receive},
    {"start", start_render},
    {"step", step_render},
    {"pick", pick},
    {"end", end_render},
    {"start_preview", start_preview},
    {"change_preview", change_preview},
    {"send_to_preview", send_to_preview},
    {"step_preview", step_preview},
};

Json result_of(std::string_view name, std::string_view parameters) {
  for (const Call& call : kCalls) {
    if (call.name == name) return call.function(Json::parse(parameters));
  }
  throw WrongParameter("there is no function `" + std::string(name) + "`");
}

Json failure(std::string_view kind, std::string_view message) {
  return {{"failure", {{"kind", kind}, {"message", message}}}};
}

Json answer_to(std::string_view name, std::string_view parameters) {
  try {
    return {{"result", result_of(name, parameters)}};
  } catch (const WrongParameter& error) {
    return failure("parameter", error.what());
  } catch (const Json::exception& error) {
    return failure("parameter", error.what());
  } catch (const std::bad_alloc&) {
    return failure("memory", "out of memory");
  } catch (const std::exception& error) {
    return failure("defect", error.what());
  }
}

}  // namespace
}  // namespace sdlc::wasm

extern "C" {

/// Calls a function: `parameters` and the result are JSON texts, the result an object with `result`
/// or `failure`. It is valid until the next call.
EMSCRIPTEN_KEEPALIVE const char* sdlc_call(const char* name, const char* parameters) {
  static std::string text;
  const sdlc::wasm::Json answer = sdlc::wasm::answer_to(name, parameters);
  text = answer.dump(-1, ' ', false, sdlc::wasm::Json::error_handler_t::replace);
  return text.c_str();
}

EMSCRIPTEN_KEEPALIVE const std::uint8_t* sdlc_preview_picture() {
  return sdlc::wasm::preview_picture().data();
}

EMSCRIPTEN_KEEPALIVE const std::uint8_t* sdlc_pixels() {
  return sdlc::wasm::rendered_pixels().data();
}
}
