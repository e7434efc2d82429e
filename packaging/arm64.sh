#!/usr/bin/env bash
# usage: packaging/arm64.sh FOLDER [TEST...]
#
# Builds for 64-bit ARM in a Debian 12 of its own in FOLDER, which is made once, writes the packages to
# FOLDER/build/packages, and runs the programs of tests (TEST: render_kernel_test, render_math_test) under qemu. In the
# same Debian the libraries of both architectures would exclude each other. It needs root and debootstrap.
set -euo pipefail
unset CDPATH
source "$(dirname -- "${BASH_SOURCE[0]}")/debian.sh"
source_folder=$(cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
root=${1:?usage: packaging/arm64.sh FOLDER [TEST...]}
shift
tools=(g++ cmake ninja-build pkg-config git python3 dpkg-dev file crossbuild-essential-arm64 qemu-user-static
  tao-pegtl-dev libcli11-dev nlohmann-json3-dev libboost-dev)
libraries=(libpng-dev libopenexr-dev libfmt-dev zlib1g-dev libgtest-dev libgmock-dev libhwy-dev libtomlplusplus-dev
  libopenimageio-dev)

if [[ ! -d $root/build ]]; then
  mkdir -p -- "$root"
  make_debian "$root"
  mkdir "$root/build"
fi
mounts=(/proc /dev /mnt)
leave() { for folder in "${mounts[@]}"; do umount "$root$folder" 2>/dev/null || true; done; }
trap leave EXIT
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount --bind "$source_folder" "$root/mnt"
inside "$root" dpkg --add-architecture arm64
inside "$root" apt-get -qq update
inside "$root" apt-get -qq -y install --no-install-recommends "${tools[@]}" "${libraries[@]/%/:arm64}" >/dev/null
inside "$root" git config --global --replace-all safe.directory '*'
inside "$root" cmake -S /mnt -B /build -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_TOOLCHAIN_FILE=/mnt/cmake/aarch64-linux-gnu.cmake
SOURCE_DATE_EPOCH=$(git -C "$source_folder" log -1 --format=%ct)
inside "$root" cmake --build /build --target sdlc package_files sdlc_static "$@"
inside "$root" env SOURCE_DATE_EPOCH="$SOURCE_DATE_EPOCH" cmake --build /build --target archives
# The target `package` would build everything.
inside "$root" env SOURCE_DATE_EPOCH="$SOURCE_DATE_EPOCH" cpack --config /build/CPackConfig.cmake
for test; do inside "$root" qemu-aarch64-static "/build/test_bin/$test"; done
