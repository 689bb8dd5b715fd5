#!/usr/bin/env bash
# On a machine without EGL, or without GLES, mfard starts, says what to install and ends: 69 is the
# code for a device that cannot be had.
. "$(dirname "$0")/lib.sh"

record take 3 --source synthetic:flat --display none

# The dynamic linker takes the first file of a name, and gives up where that is no library.
mkdir hidden
for library in libEGL.so.1 libGLESv2.so.2; do
    : >"hidden/$library"
    export LD_LIBRARY_PATH=$PWD/hidden${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
    run 0 --version
    run 0 --check-config
    for source in "--recording take" "--source synthetic:flat"; do
        # shellcheck disable=SC2086 # a list of words
        run 69 $source --frames 1 --display png:shown
        says err "error: (synthetic:flat: )?$library cannot be loaded: .*; install libegl1 and libgles2, or use the SIMD engine"
    done
    [ ! -e shown ] || fail "there are pictures"
    rm "hidden/$library"
done
run 0 --recording take --frames 1 --display none
