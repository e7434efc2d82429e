#!/usr/bin/env bash
# usage: packaging/files.sh VERSION RELEASE MAINTAINER FOLDER COMMAND...
#
# Writes what packages have beside programs below FOLDER/PACKAGE, as below /usr/share: manual pages, completions,
# copyright, changes, documentation, and the type of scene files. The same files at any time.
set -euo pipefail
unset CDPATH
here=$(cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
version=$1 release=$2 maintainer=$3 folder=$4
shift 4
changelog=$here/../CHANGELOG.md
date=$(sed -n "s/^## $version - //p" "$changelog")
[[ $date ]] || {
  echo "files.sh: CHANGELOG.md has no date of version $version" >&2
  exit 1
}
mkdir -p -- "$folder"
folder=$(cd -P -- "$folder" && pwd -P)
cd -- "$folder"

put() { install -D -m 644 -- /dev/stdin "$1"; }

for package in sdlc sdlc-openimageio; do
  put "$package/doc/$package/copyright" <"$here/copyright"
  gzip -9n <"$changelog" | put "$package/doc/$package/changelog.gz"
  printf '%s (%s-%s) unstable; urgency=medium\n\n  * Version %s, see changelog.gz.\n\n -- %s  %s\n' \
    "$package" "$version" "$release" "$version" "$maintainer" "$(LC_ALL=C date -u -d "$date" -R)" |
    gzip -9n | put "$package/doc/$package/changelog.Debian.gz"
done
cd sdlc
"$@" man | gzip -9n | put man/man1/sdlc.1.gz
"$@" complete -- 1 sdlc '' | cut -f1 | while read -r command; do
  "$@" man "$command" | gzip -9n | put "man/man1/sdlc-$command.1.gz"
done
"$@" completions bash | put bash-completion/completions/sdlc
"$@" completions zsh | put zsh/vendor-completions/_sdlc
"$@" completions fish | put fish/vendor_completions.d/sdlc.fish
put mime/packages/sdlc.xml <"$here/sdlc.xml"
put applications/sdlc.desktop <"$here/sdlc.desktop"
put icons/hicolor/scalable/apps/sdlc.svg <"$here/../editors/vscode/icons/scene-light.svg"

# The examples and the documentation: what git has, or all where there is no checkout. The large reports are left out;
# links to them, and to the rest of the sources, become their text.
cd -- "$here/.."
outside='s#\[([^]]*)\]\((reports/|(\.\./)+((editors|grammar|render|wasm)/|CHANGELOG))[^)]*\)#\1#g'
{ [[ -e .git ]] && git -c safe.directory='*' ls-files -- docs examples 2>/dev/null || find docs examples -type f; } |
  LC_ALL=C sort | while read -r file; do
    target=$folder/sdlc/doc/sdlc/$file
    case $file in
      docs/reports/*) ;;
      *.md) sed -E "$outside" "$file" | put "$target" ;;
      *) put "$target" <"$file" ;;
    esac
  done
