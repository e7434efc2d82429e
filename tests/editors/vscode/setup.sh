#!/usr/bin/env bash
# usage: tests/editors/vscode/setup.sh [FOLDER]
#
# Installs what drive.sh needs below FOLDER (default: /tmp/vscode-tools), about 450 MB: VS Code as code-server, and
# puppeteer. Writes FOLDER/env.sh, which drive.sh and the protocol tests need in their environment. Chromium, a C++
# compiler, make, python3 and Node.js 20 with its headers come from the system.
set -euo pipefail
unset CDPATH
tests=$(cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
folder=$(realpath -m -- "${1:-/tmp/vscode-tools}")
node_prefix=$(dirname -- "$(dirname -- "$(readlink -f -- "$(command -v node)")")")

# The version of VS Code in it is 1.99; newer ones of code-server need a newer Node.js.
code_server=4.99.4
mkdir -p -- "$folder/node"
cp -- "$tests"/package{,-lock}.json "$folder/node"
npm install --prefix "$folder/node" --ignore-scripts --no-audit --no-fund --save-exact puppeteer-core@24.43.1
mkdir -p -- "$folder/code-server"
echo '{ "private": true }' >"$folder/code-server/package.json"
npm install --prefix "$folder/code-server" --ignore-scripts --no-audit --no-fund --save-exact "code-server@$code_server"
cd -- "$folder/code-server/node_modules/code-server/lib/vscode"
npm install --ignore-scripts --omit=dev --no-audit --no-fund
# Their scripts build native modules. The others that have some, kerberos and ripgrep, are not necessary.
npm rebuild @vscode/spdlog native-watchdog
(cd node_modules/node-pty && npx --yes node-gyp@10 rebuild --nodedir="$node_prefix")
(cd "$folder/code-server/node_modules/argon2" &&
  ../.bin/node-pre-gyp rebuild --build-from-source --nodedir="$node_prefix")

cat >"$folder/env.sh" <<END
export SDLC_NODE_MODULES='$folder/node/node_modules'
export SDLC_CODE_SERVER='$folder/code-server/node_modules/code-server/out/node/entry.js'
END
echo "source $folder/env.sh"
