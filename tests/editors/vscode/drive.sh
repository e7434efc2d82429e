#!/usr/bin/env bash
# usage: tests/editors/vscode/drive.sh [NAME…]
#
# Drives the packaged extension and the real server in a real VS Code; with names, only the checks whose names contain
# one of them. README.md describes it. Environment: what setup.sh prints; SDLC, the program (default:
# build/release/bin/sdlc); SDLC_WASM, the folder of the engine (default: build/wasm/sdlc-wasm; without it the extension
# for browsers is not driven); SDLC_SCREENS, the folder for screenshots (default: a new one, which is printed);
# CHROMIUM.
set -euo pipefail
unset CDPATH
folder=$(cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
root=$(cd -P -- "$folder/../../.." && pwd -P)

die() {
  printf 'drive.sh: %s\n' "$*" >&2
  exit 2
}

export SDLC=${SDLC:-$root/build/release/bin/sdlc}
export CHROMIUM=${CHROMIUM:-$(command -v chromium || true)}
[[ -x $SDLC ]] || die "there is no $SDLC: build it with ./dev build, or set SDLC"
[[ -e ${SDLC_CODE_SERVER:-} ]] || die "SDLC_CODE_SERVER is not set: run setup.sh, and source the file that it prints"
[[ -e ${SDLC_NODE_MODULES:-}/puppeteer-core ]] || die "SDLC_NODE_MODULES has no puppeteer-core: run setup.sh"
[[ -x $CHROMIUM ]] || die "there is no chromium: install it, or set CHROMIUM"

home=$(mktemp -d)
trap 'rm -rf -- "$home"' EXIT
export SDLC_SCREENS=${SDLC_SCREENS:-$(mktemp -d)}
mkdir -p -- "$SDLC_SCREENS"
"$root/editors/vscode/package.sh" "$home/sdlc-scene.vsix" >"$home/package.log" 2>&1 || {
  cat "$home/package.log" >&2
  die "the extension cannot be packaged"
}
export SDLC_WASM=${SDLC_WASM:-$root/build/wasm/sdlc-wasm}
if [[ -e $SDLC_WASM/sdlc.wasm ]]; then
  "$root/editors/vscode/package.sh" --web "$home/sdlc-scene-web.vsix" >"$home/package.log" 2>&1 || {
    cat "$home/package.log" >&2
    die "the extension for browsers cannot be packaged"
  }
else
  echo "there is no $SDLC_WASM/sdlc.wasm: the extension for browsers is not driven"
fi
echo "screenshots: $SDLC_SCREENS"
node "$folder/drive.mjs" "$home" "$@"
