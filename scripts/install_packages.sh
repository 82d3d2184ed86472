#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Installs what Foothold needs from Debian's or Ubuntu's packages. Does nothing, at once, when all of it is there.
#
#   scripts/install_packages.sh [--developer | --aarch64]
#
# --developer adds clang for the fuzz targets, and clang-format-14, clang-tidy-14, Doxygen and Valgrind, which checks use where present.
# --aarch64 adds a cross-compiler and QEMU for 64-bit Arm, and unpacks the libraries for it into build/aarch64-sysroot.
# Needs root or sudo only if something is missing. CUDA is optional and never installed by this script.
set -euo pipefail

libraries=(                                                                 # also for other processors
  libeigen3-dev libtbb-dev                                                  # the libraries
  libopencv-dev libopenexr-dev zlib1g-dev nlohmann-json3-dev libcli11-dev libopenni2-dev  # reading sequences, cameras, and the apps
  catch2                                                                    # the tests
)
packages=(
  build-essential cmake ninja-build ccache pkgconf                          # to build
  "${libraries[@]}"
  python3 xvfb xauth locales                                                # the tests; Python also writes the report
)
case "${1:-}" in
  "") ;;
  --developer) packages+=(clang clang-format-14 clang-tidy-14 doxygen valgrind) ;;
  --aarch64) packages+=(g++-aarch64-linux-gnu qemu-user mmdebstrap) ;;
  *) echo "usage: $0 [--developer | --aarch64]; got '$1'" >&2; exit 2 ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "install_packages: this is not Debian or Ubuntu; continuing, please see to it that these are installed: ${packages[*]}" >&2
  exit 0
fi

missing=()
installed=" $(dpkg-query --show --showformat='${Package}:${db:Status-Status} ' "${packages[@]}" 2>/dev/null || true)"
for package in "${packages[@]}"; do
  [[ $installed == *" $package:installed "* ]] || missing+=("$package")
done

# An arm64 system of the libraries alone, unpacked and not installed: this machine's packages stay as they are.
unpack_aarch64() {
  local sysroot
  sysroot=$(dirname "$0")/../build/aarch64-sysroot
  [[ -d $sysroot ]] && return
  echo "install_packages: unpacking libraries for 64-bit Arm into build/aarch64-sysroot (a few minutes, 1 GB)"
  mkdir -p "$(dirname "$sysroot")"
  rm -rf "$sysroot.part"
  # Nothing is run of it, so that root is not needed; two links are what scripts of packages would make.
  mmdebstrap --quiet --mode=chrootless --variant=extract --architectures=arm64 --include="$(IFS=, && echo "${libraries[*]}")" \
    --extract-hook='ln -s blas/libblas.so.3 lapack/liblapack.so.3 "$1/usr/lib/aarch64-linux-gnu"' \
    "$(. /etc/os-release && echo "$VERSION_CODENAME")" "$sysroot.part"
  mv "$sysroot.part" "$sysroot"
}
finish() {
  [[ ${1:-} != --aarch64 ]] || unpack_aarch64
  exit 0
}
[[ ${#missing[@]} -eq 0 ]] && finish "$@"

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "install_packages: root or sudo is needed to install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
  [[ -t 0 ]] || as_root=(sudo --non-interactive)  # nobody is there to type a password
fi

install() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install --yes --quiet --no-install-recommends "${missing[@]}" </dev/null
}
echo "install_packages: installing ${missing[*]} (a few minutes on a bare machine)"
# Package lists may be absent or stale; refreshing them costs time only when that shows.
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! install >"$log" 2>&1; then
  "${as_root[@]}" apt-get update --quiet </dev/null || echo "install_packages: the package lists could not be refreshed" >&2
  if ! install; then
    echo "install_packages: could not install ${missing[*]}" >&2
    exit 1
  fi
fi
finish "$@"
