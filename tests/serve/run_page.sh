#!/bin/sh
# usage: run_page.sh PROGRAM
#
# Drives the page of PROGRAM serve in Chromium. Exit status 77, with a message, where a tool is missing.
set -eu
unset CDPATH
SDLC=$(realpath -- "$1")
export SDLC
here=$(cd -P -- "$(dirname -- "$0")" && pwd -P)

skip() {
  echo "skipped: $*"
  exit 77
}

command -v node >/dev/null || skip "node is not installed"
[ -e "${SDLC_NODE_MODULES:-}/puppeteer-core" ] || skip "SDLC_NODE_MODULES has no puppeteer-core"
CHROMIUM=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
  skip "chromium is not installed"
export CHROMIUM
exec node --test "$here/page_test.mjs"
