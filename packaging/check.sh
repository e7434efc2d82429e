#!/usr/bin/env bash
# usage: packaging/check.sh PACKAGES [PART...]
#
# Installs and uses each package of the folder PACKAGES, as `./dev package` wrote them, in an empty Debian 12 of its
# own, and prints how many packages and megabytes each brings. PART is deb, file, wheel or npm. It needs root and
# debootstrap, and some minutes. lintian judges the Debian packages where it is installed. The status is not 0 if
# anything fails.
set -euo pipefail
unset CDPATH
source "$(dirname -- "${BASH_SOURCE[0]}")/debian.sh"
packages=$(cd -P -- "${1:?usage: packaging/check.sh PACKAGES [PART...]}" && pwd -P)
shift
(($#)) || set -- deb file wheel npm
work=$(mktemp -d /var/tmp/sdlc-check.XXXXXX)
empty=$work/empty root=$work/root

leave() {
  umount "$root/proc" 2>/dev/null || true
  rm -rf -- "$work"
}
trap leave EXIT

make_debian "$empty"

now() { date +%s.%N; }
# minus A B [UNIT]: A - B, in units of UNIT.
minus() { awk -v a="$1" -v b="$2" -v unit="${3:-1}" 'BEGIN { printf "%.1f", (a - b) / unit }'; }

# Begins with an empty Debian that has the packages in /packages.
begin() {
  printf '\n%s\n' "$1"
  umount "$root/proc" 2>/dev/null || true
  rm -rf -- "$root"
  cp -a -- "$empty" "$root"
  mkdir "$root/packages"
  find "$packages" -maxdepth 1 -type f -exec cp -t "$root/packages" {} +
  mount -t proc proc "$root/proc"
  inside "$root" apt-get -qq update
}

# shell COMMAND: runs it in the Debian.
shell() { inside "$root" sh -ec "$1"; }
sizes() { inside "$root" dpkg-query -W -f='${Installed-Size}\n' | awk '{kb += $1} END {print NR, kb}'; }

# install COMMAND: runs it, and prints what it brought.
install() {
  local before after start
  read -r -a before < <(sizes)
  start=$(now)
  shell "$1" >"$work/log" 2>&1 || { tail -n 20 "$work/log" && return 1; }
  read -r -a after < <(sizes)
  printf '  %s: %d packages of Debian, %s MB, %s s\n' "$1" $((after[0] - before[0])) \
    "$(minus "${after[1]}" "${before[1]}" 1024)" "$(minus "$(now)" "$start")"
}

# use COMMAND: the command `sdlc` and its pictures.
use() {
  local start
  start=$(now)
  shell "$1 new ball && $1 render ball.scene --error 2% && test -s ball.png"
  printf '  first picture, to 2 %%: %s s\n' "$(minus "$(now)" "$start")"
  shell "$1 lint . && $1 fmt --check . && $1 explain E104 >/dev/null && $1 schema >/dev/null"
  shell "printf 'scene 1\nsphere a { radus: 1 }\n' >bad.scene; ! $1 lint bad.scene >found 2>&1; grep -q 'did you mean' found"
}

check_deb() {
  begin "Debian packages"
  [[ ! $(command -v lintian) ]] || lintian --allow-root --fail-on error,warning "$packages"/*.deb
  shell 'find / -xdev | sort >/packages/before' 2>/dev/null
  install 'apt-get install -y --no-install-recommends /packages/sdlc_*.deb'
  use sdlc
  shell 'sdlc render ball.scene -o ball.exr --width 64; ! sdlc render ball.scene -o ball.jpg 2>error; grep -q sdlc-openimageio error'
  shell 'test -s /usr/share/man/man1/sdlc-render.1.gz && test -s /usr/share/bash-completion/completions/sdlc'
  # As in the image for Kubernetes of docs/farm.md.
  shell 'sdlc farm ball.scene --engine kubernetes -o job --width 64 --samples 4 && sh job/task.sh render.tasks 0 && sh job/merge.sh && sdlc farm status job'
  shell 'rm -rf /mnt/*; apt-get purge -y --auto-remove sdlc >/dev/null 2>&1; find / -xdev | sort >/packages/after'
  if shell 'diff /packages/before /packages/after | grep "^>" | grep -vE " /(packages|proc|var/(cache|lib|log)|etc/ld.so.cache)"'; then
    echo '  left behind, see above'
    return 1
  fi
  install 'apt-get install -y --no-install-recommends /packages/*.deb'
  shell 'sdlc new ball && sdlc render ball.scene --width 64 -o ball.jpg && test -s ball.jpg'
}

check_file() {
  begin "One file, in an empty folder"
  tar -C "$work" -xzf "$packages"/sdlc-*-linux-*.tar.gz
  file=$(echo "$work"/sdlc-*/bin/sdlc)
  ! ldd "$file" >/dev/null 2>&1 || { echo "  it is a dynamic executable" && exit 1; }
  mkdir -p "$work/nothing/mnt"
  cp -- "$file" "$work/nothing/sdlc"
  alone() { (cd "$work/nothing/mnt" && env -i "$(command -v chroot)" "$work/nothing" /sdlc "$@"); }
  alone new /mnt/ball
  alone lint /mnt/ball.scene
  alone fmt --check /mnt/ball.scene
  alone render /mnt/ball.scene --error 2% -o /mnt/ball.png
  alone explain E104 >/dev/null
  alone schema >/dev/null
  printf '  %s MB\n' "$(minus "$(stat -c %s "$file")" 0 1000000)"
}

check_wheel() {
  begin "Wheel"
  install 'apt-get install -y --no-install-recommends python3-venv'
  install 'python3 -m venv /mnt/v && /mnt/v/bin/pip install -q --no-index /packages/*.whl'
  use /mnt/v/bin/sdlc
}

check_npm() {
  begin "npm"
  install 'apt-get install -y --no-install-recommends npm'
  install 'npm install --offline --no-audit --no-fund /packages/*.tgz'
  use node_modules/.bin/sdlc
  shell 'rm bad.scene; npx --offline sdlc-lint ball.scene'
  shell 'mkdir new && cd new && mv ../ball.scene . && npx --offline --yes --package /packages/sdlc-linux-*.tgz --package /packages/sdlc-lint-*.tgz sdlc-lint ball.scene'
}

for part; do "check_$part"; done
