#!/bin/sh
# usage: run_core.sh EDITOR PROGRAM
#
# Runs the tests of the language server through an editor or a client: neovim, emacs or node, with PROGRAM as sdlc;
# and vscode, of what the extension does before it starts the server.
# Exit status 77, with a message, where that is not installed.
set -eu
unset CDPATH
editor=$1
SDLC=$(realpath -- "$2")
export SDLC
here=$(cd -P -- "$(dirname -- "$0")" && pwd -P)
root=$here/../..

skip() {
  echo "skipped: $*"
  exit 77
}

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
HOME=$folder
export HOME
case $editor in
  neovim)
    command -v nvim >/dev/null || skip "nvim is not installed"
    nvim --headless --clean -n -c "luafile $here/neovim/core_test.lua"
    ;;
  emacs)
    command -v emacs >/dev/null || skip "emacs is not installed"
    emacs --batch --eval "(require 'eglot)" 2>/dev/null || skip "emacs has no eglot (Debian: elpa-eglot)"
    emacs --batch -L "$root/editors/emacs" -l "$here/emacs/core-test.el"
    ;;
  vscode)
    command -v node >/dev/null || skip "node is not installed"
    node --test "$here/vscode/program_test.mjs"
    ;;
  node)
    command -v node >/dev/null || skip "node is not installed"
    for package in vscode-languageserver-protocol vscode-jsonrpc typescript; do
      [ -e "${SDLC_NODE_MODULES:-}/$package" ] || skip "SDLC_NODE_MODULES has no $package"
    done
    node "$here/protocol/run.mjs"
    ;;
esac
