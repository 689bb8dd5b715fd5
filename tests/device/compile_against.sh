#!/usr/bin/env bash
# Compiles the sources that depend on the version of a device library inside another Debian's root,
# and runs their tests there: what CMake chooses here by version is thereby seen in both.
# Usage: compile_against.sh ROOT. Needs root; ROOT is made for example by
#   mmdebstrap --variant=minbase --include="$(tests/device/compile_against.sh --packages)" \
#       trixie ROOT
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."

packages=g++,pkg-config,libfmt-dev,libgpiod-dev,libgtest-dev,libgmock-dev

[[ ${1:-} != --packages ]] || { echo "$packages"; exit 0; }
root=${1:?usage: compile_against.sh ROOT | --packages}
[[ $(id -u) == 0 ]] || { echo "compile_against: chroot needs root" >&2; exit 77; }

work=$(mktemp -d -p "$root/tmp" mfar.XXXXXX)
trap 'rm -rf "$work"' EXIT
tar -cf - hal tests/device tests/unit/*.h | tar -xf - -C "$work"

# Expanded and run in the root. Arguments: folder.
# shellcheck disable=SC2016
inside='
set -eu
cd "$1"
version() { pkg-config --modversion "$1"; }
warnings="-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Werror"
compile() { # NAME PACKAGES SOURCES...
    name=$1 packages=$2
    shift 2
    # System headers: their warnings are not ours.
    flags=$(pkg-config --cflags $packages | sed "s/-I/-isystem /g")
    g++ -std=c++20 -O1 $warnings -I. $flags "$@" -o "$name" \
        $(pkg-config --libs $packages) -lgmock_main -lgmock -lgtest -lfmt -pthread
}
case $(version libgpiod) in 1.*) v=1 ;; *) v=2 ;; esac
echo "libgpiod $(version libgpiod): trigger_gpiod_v$v.cpp"
compile trigger libgpiod hal/device/gpio_selection.cpp hal/device/pulse_trigger.cpp \
    hal/device/trigger_gpiod.cpp hal/device/trigger_gpiod_v$v.cpp \
    tests/device/gpio_selection_test.cpp tests/device/pulse_trigger_test.cpp \
    tests/device/trigger_gpiod_test.cpp
./trigger --gtest_brief=1
'
chroot "$root" /bin/sh -c "$inside" sh "/tmp/${work##*/}"
