#!/usr/bin/env bash
# Compiles and tests the sources that use libgpiod or libcamera with another Debian release's versions
# of these libraries, in a root folder with that release. Usage: compile_against.sh CACHE SUITE, where
# SUITE is bookworm, trixie or sid. Needs root and mmdebstrap. The root folder takes two minutes to
# create and is kept in CACHE for a week.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
# shellcheck source=toolchains/debian.sh
. toolchains/debian.sh

[[ $# == 2 ]] || die "usage: compile_against.sh CACHE SUITE"
[[ $(id -u) == 0 ]] || die "chroot needs root"
cache=$1 suite=$2
packages=g++,pkg-config,libfmt-dev,libgpiod-dev,libcamera-dev,libgtest-dev,libgmock-dev
root=$cache/native-$suite-$(inputHash "$packages")
find "$cache" -maxdepth 1 -name 'native-*' -mtime +7 -exec rm -rf {} +
if [[ ! -d $root ]]; then
    printf 'Making %s, about two minutes\n' "$root" >&2
    rm -rf "$root.part"
    mirror=$(debianMirror)
    mmdebstrap --quiet --mode=root --variant=minbase --include="$packages" "$suite" "$root.part" \
        ${mirror:+"$mirror"}
    mv "$root.part" "$root"
fi

work=$(mktemp -d -p "$root/tmp" mfar.XXXXXX)
trap 'rm -rf "$work"' EXIT
tar -cf - base hal tests/device tests/unit/*.h | tar -xf - -C "$work"

# These commands are executed inside the root folder. Their argument is the folder of the sources.
# shellcheck disable=SC2016
inside='
set -eu
cd "$1"
version() { pkg-config --modversion "$1"; }
warnings="-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Werror"
objects() { # objects PACKAGES SOURCES...: compiles each source into the current folder
    # -isystem makes the compiler ignore warnings in headers of the library.
    flags=$(pkg-config --cflags "$1" | sed "s/-I/-isystem /g")
    shift
    for source; do
        g++ -std=c++20 $warnings -I. $flags -c "$source" -o "$(basename "$source" .cpp).o"
    done
}
link() { # link NAME PACKAGES PARTS...: links a test
    name=$1 libraries=$(pkg-config --libs "$2")
    shift 2
    g++ $(printf "%s.o " "$@") -o "$name" $libraries -lgmock_main -lgmock -lgtest -lfmt -pthread
}
case $(version libgpiod) in 1.*) v=1 ;; *) v=2 ;; esac
echo "libgpiod $(version libgpiod): trigger_gpiod_v$v.cpp"
trigger="gpio_selection pulse_trigger trigger_gpiod"
objects libgpiod $(printf "hal/device/%s.cpp tests/device/%s_test.cpp " \
    $(for part in $trigger; do echo $part $part; done)) hal/device/trigger_gpiod_v$v.cpp
link trigger-tests libgpiod $trigger trigger_gpiod_v$v $(printf "%s_test " $trigger)
./trigger-tests --gtest_brief=1

echo "libcamera $(version libcamera)"
tested="camera_selection field_of_view picture_layout picture_times request_cycle sensor_clock
    libcamera_buffers libcamera_controls libcamera_log"
parts="$tested camera_libcamera libcamera_manager libcamera_setup libcamera_stream"
objects libcamera hal/frame.cpp hal/frame_drops.cpp base/image_layout.cpp tests/device/libcamera_test.cpp \
    $(printf "hal/device/%s.cpp " $parts) $(printf "tests/device/%s_test.cpp " $tested) \
    tests/device/libcamera_probe.cpp
parts="frame frame_drops image_layout $parts"
link camera-tests libcamera $parts libcamera_test $(printf "%s_test " $tested)
link probe libcamera $parts libcamera_probe
# Without this setting, libcamera logs its version and everything that is missing in a chroot.
export LIBCAMERA_LOG_LEVELS="*:FATAL"
./camera-tests --gtest_brief=1
./probe
'
chroot "$root" /bin/sh -c "$inside" sh "/tmp/${work##*/}"
