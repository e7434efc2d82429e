#!/usr/bin/env bash
# Writes src/parser.c, src/grammar.json, src/node-types.json, src/tree_sitter/parser.h and tree-sitter-sdlc.wasm from
# grammar.js, words.json and src/scanner.c, and checksums.txt about all of them.
# Needs tree-sitter 0.20 (TREE_SITTER names the program), node and emcc.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")"

tree_sitter=${TREE_SITTER:-tree-sitter}
"$tree_sitter" generate --abi 14 --no-bindings
"$tree_sitter" build-wasm
chmod 644 tree-sitter-sdlc.wasm
{
  echo "# Written by generate.sh. Generator: $("$tree_sitter" --version), ABI 14."
  echo "# WebAssembly: Emscripten $(emcc -dumpversion)."
  sha256sum grammar.js words.json src/scanner.c src/words.h \
    src/parser.c src/grammar.json src/node-types.json src/tree_sitter/parser.h tree-sitter-sdlc.wasm
} >checksums.txt
