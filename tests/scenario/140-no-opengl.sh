#!/usr/bin/env bash
# Without EGL or GLES, the SIMD engine must draw the pictures and mfard must report why. Options
# that need GL must fail with code 69 (missing device) and name the packages to install.
. "$(dirname "$0")/lib.sh"

record take 3 --source synthetic:flat --display none
run 0 --recording take --size 1152x864 --frames 2 --engine simd --display png:with

echo "a wrong value of MFAR_GL_DEVICE is reported"
fault='MFAR_GL_DEVICE is "sofware", but its only valid value is "software"'
for needing in "--recording take --engine gles" "--source synthetic:flat"; do
    # shellcheck disable=SC2086 # $needing is a list of words
    MFAR_GL_DEVICE=sofware run 69 $needing --frames 1 --display none
    says err "error: .*$fault"
done
MFAR_GL_DEVICE=sofware run 0 --recording take --frames 1 --display none
says err "warning: .*$fault"

# The dynamic linker loads the first file with a library's name. Here this file is empty, so loading fails.
mkdir hidden
for library in libEGL.so.1 libGLESv2.so.2; do
    : >"hidden/$library"
    export LD_LIBRARY_PATH=$PWD/hidden${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
    run 0 --version
    run 0 --check-config
    missing="$library cannot be loaded: .*; install libegl1 and libgles2, or use the SIMD engine"
    for needing in "--recording take --engine gles" "--source synthetic:flat"; do
        # shellcheck disable=SC2086 # $needing is a list of words
        run 69 $needing --frames 1 --display png:refused
        says err "error: (synthetic:flat: )?$missing"
    done
    [ ! -e refused ] || fail "mfard wrote pictures although it refused to run"
    for engine in auto simd; do
        run 0 --recording take --size 1152x864 --frames 2 --engine $engine --display "png:shown-$engine"
        says err "engine simd"
        cmp "shown-$engine/$(ls "shown-$engine" | head -n 1)" "with/$(ls with | head -n 1)" ||
            fail "the picture differs from that of a machine with OpenGL ES"
        rm -r "shown-$engine"
    done
    run 0 --recording take --frames 1 --display none
    says err "warning: OpenGL ES is not available, so the CPU computes the pictures: $missing"
    rm "hidden/$library"
done
run 0 --recording take --frames 1 --display none
