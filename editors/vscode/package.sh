#!/usr/bin/env bash
# usage: editors/vscode/package.sh [--web] [FILE]
#
# Packages the extension as FILE (default: editors/vscode/sdlc-scene.vsix). With --web, packages the one for browsers
# (default: sdlc-scene-web.vsix), with the engine in SDLC_WASM (default: build/wasm/sdlc-wasm, where the preset wasm
# builds it). The schema of configs comes from the program sdlc: that of SDLC, else that of build/release, else that of
# the PATH. Works without a network if node_modules is there; otherwise it runs `npm ci` first.
set -euo pipefail
unset CDPATH
folder=$(cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
root=$folder/../..
target=native
if [[ ${1:-} == --web ]]; then
  target=web
  shift
fi
suffix=
[[ $target == native ]] || suffix=-web
output=$(realpath -m -- "${1:-$folder/sdlc-scene$suffix.vsix}")

say() { printf 'package.sh: %s\n' "$*" >&2; }
die() {
  say "$@"
  exit 1
}

find_sdlc() {
  local candidate
  for candidate in "${SDLC:-}" "$root/build/release/bin/sdlc" "$(command -v sdlc || true)"; do
    if [[ -x $candidate ]]; then
      realpath -- "$candidate"
      return
    fi
  done
  die "there is no sdlc: build it with ./dev build, or set SDLC to its path"
}

command -v node >/dev/null || die "there is no node: install Node.js 20 or later"
sdlc=$(find_sdlc)
if [[ $target == web ]]; then
  SDLC_WASM=$(realpath -m -- "${SDLC_WASM:-$root/build/wasm/sdlc-wasm}")
  export SDLC_WASM
  [[ -e $SDLC_WASM/sdlc.wasm ]] || die "there is no $SDLC_WASM/sdlc.wasm: cmake --workflow --preset wasm makes it"
fi
cd -- "$folder"
[[ -e syntaxes/scene.tmLanguage.json ]] || die "there is no syntaxes/scene.tmLanguage.json"
if [[ ! -e node_modules/.package-lock.json ]]; then
  say "fetching the packages of package-lock.json"
  npm ci --ignore-scripts --no-audit --no-fund >&2
fi

node build.mjs "$target" "dist/$target"
cd -- "dist/$target"
mkdir schemas
"$sdlc" schema >schemas/sdlc-config.schema.json
options=()
if [[ $target == web ]]; then
  "$sdlc" explain --format json >dist/web/explain.json
  options=(--target web)
fi
# The same sources give the same bytes.
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || echo 0)}
export SOURCE_DATE_EPOCH
options+=(--no-dependencies --allow-missing-repository --out "$output")
"$folder/node_modules/.bin/vsce" package "${options[@]}" >&2
printf '%s\n' "$output"
