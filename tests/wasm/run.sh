#!/bin/sh
# usage: run.sh TEST PROGRAM
#
# Compares the WebAssembly module, in SDLC_WASM or build/wasm/sdlc-wasm, with PROGRAM. Exit status 77, with a message,
# where the module or Node is missing.
set -eu
unset CDPATH
SDLC=$(realpath -- "$2")
here=$(cd -P -- "$(dirname -- "$0")" && pwd -P)
SDLC_WASM=${SDLC_WASM:-$here/../../build/wasm/sdlc-wasm}
export SDLC SDLC_WASM

skip() {
  echo "skipped: $*"
  exit 77
}

command -v node >/dev/null || skip "node is not installed"
[ -e "$SDLC_WASM/sdlc.wasm" ] || skip "there is no $SDLC_WASM/sdlc.wasm: cmake --workflow --preset wasm makes it"
exec node --test "$here/$1_test.mjs"
