#!/usr/bin/env bash
# usage: editors/vscode/package.sh [FILE]
#
# Packages the extension as FILE (default: editors/vscode/sdlc-scene.vsix). The schema of configs comes from the
# program sdlc: that of SDLC, else that of build/release, else that of the PATH. Works without a network if
# node_modules is there; otherwise it runs `npm ci` first.
set -euo pipefail
unset CDPATH
folder=$(cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
root=$folder/../..
output=$(realpath -m -- "${1:-$folder/sdlc-scene.vsix}")

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
cd -- "$folder"
[[ -e syntaxes/scene.tmLanguage.json ]] || die "there is no syntaxes/scene.tmLanguage.json"
if [[ ! -e node_modules/.package-lock.json ]]; then
  say "fetching the packages of package-lock.json"
  npm ci --ignore-scripts --no-audit --no-fund >&2
fi

rm -rf dist schemas
mkdir -p schemas
"$sdlc" schema >schemas/sdlc-config.schema.json
cp "$root/LICENSE" LICENSE.txt
node build.mjs
# The same sources give the same bytes.
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || echo 0)}
export SOURCE_DATE_EPOCH
node_modules/.bin/vsce package --no-dependencies --allow-missing-repository --out "$output" >&2
printf '%s\n' "$output"
