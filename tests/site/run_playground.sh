#!/bin/sh
# usage: run_playground.sh PROGRAM SITE
#
# Drives the playground of SITE in Chromium, and in Firefox if it is there; PROGRAM computes. Exit status 77, with a
# message, where something is missing.
set -eu
unset CDPATH
SDLC=$(realpath -- "$1")
SDLC_SITE=$2
export SDLC SDLC_SITE
here=$(cd -P -- "$(dirname -- "$0")" && pwd -P)

skip() {
  echo "skipped: $*"
  exit 77
}

command -v node >/dev/null || skip "node is not installed"
[ -e "$SDLC_SITE/playground/index.html" ] || skip "there is no site: ./dev site makes it"
[ -e "${SDLC_NODE_MODULES:-}/puppeteer-core" ] || skip "SDLC_NODE_MODULES has no puppeteer-core"
CHROMIUM=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
FIREFOX=$(command -v firefox-esr || command -v firefox || true)
[ -n "$CHROMIUM$FIREFOX" ] || skip "neither chromium nor firefox is installed"
export CHROMIUM FIREFOX
exec node --test "$here/playground_test.mjs"
