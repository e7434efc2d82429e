#!/usr/bin/env bash
# usage: packaging/files.sh SDLC FOLDER
#
# Writes what packages have beside programs below FOLDER/PACKAGE, as below /usr/share: manual pages, completions,
# copyright, changes, and the type of scene files. The same files at any time.
set -euo pipefail
unset CDPATH
here=$(cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
sdlc=$(realpath -- "$1")
mkdir -p -- "$2"
cd -- "$2"

put() { install -D -m 644 -- /dev/stdin "$1"; }

for package in sdlc sdlc-openimageio; do
  put "$package/doc/$package/copyright" <"$here/copyright"
  gzip -9n <"$here/../CHANGELOG.md" | put "$package/doc/$package/changelog.gz"
done
cd sdlc
"$sdlc" man | gzip -9n | put man/man1/sdlc.1.gz
"$sdlc" complete -- 1 sdlc '' | cut -f1 | while read -r command; do
  "$sdlc" man "$command" | gzip -9n | put "man/man1/sdlc-$command.1.gz"
done
"$sdlc" completions bash | put bash-completion/completions/sdlc
"$sdlc" completions zsh | put zsh/vendor-completions/_sdlc
"$sdlc" completions fish | put fish/vendor_completions.d/sdlc.fish
put mime/packages/sdlc.xml <"$here/sdlc.xml"
put applications/sdlc.desktop <"$here/sdlc.desktop"
put icons/hicolor/scalable/apps/sdlc.svg <"$here/../editors/vscode/icons/scene-light.svg"
