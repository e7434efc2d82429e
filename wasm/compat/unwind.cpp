#include <cstdint>

// The part of the runtime of exceptions that shares a variable with the code that catches. Code of
// clang 14 has it global, emscripten's library for threads thread-local, so that no exception of
// that module would match a `catch`. This takes the place of emscripten's Unwind-wasm.c in both
// modules. Threads share the variable for the moment in which an exception looks for its `catch`;
// several do so only where memory ends.
namespace {

struct Exception {
  std::uint64_t kind;
  void (*destroy)(int reason, Exception* exception);
};
struct LandingPad {
  std::uintptr_t index, tables;  // set by the code that catches
  std::uintptr_t selector;       // the answer
};

constexpr int kCleanupPhase = 2, kForeignExceptionCaught = 1;

}  // namespace

extern "C" {

int __gxx_personality_wasm0(int version, int actions, std::uint64_t kind, Exception* exception,
                            LandingPad* context);

LandingPad __wasm_lpad_context;

int _Unwind_CallPersonality(Exception* exception) {
  __wasm_lpad_context.selector = 0;
  return __gxx_personality_wasm0(1, kCleanupPhase, exception->kind, exception,
                                 &__wasm_lpad_context);
}

int _Unwind_RaiseException(Exception* exception) { __builtin_wasm_throw(0, exception); }

void _Unwind_DeleteException(Exception* exception) {
  if (exception->destroy != nullptr) exception->destroy(kForeignExceptionCaught, exception);
}

void _Unwind_SetGR(LandingPad* context, int index, std::uintptr_t value) {
  if (index == 1) context->selector = value;
}

// The personality function counts from 1, after it has taken one less.
std::uintptr_t _Unwind_GetIP(LandingPad* context) { return context->index + 2; }

std::uintptr_t _Unwind_GetLanguageSpecificData(LandingPad* context) { return context->tables; }

void _Unwind_SetIP(LandingPad* /*context*/, std::uintptr_t /*value*/) {}

std::uintptr_t _Unwind_GetRegionStart(LandingPad* /*context*/) { return 0; }
}
