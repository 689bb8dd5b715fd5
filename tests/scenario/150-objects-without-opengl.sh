#!/usr/bin/env bash
# Without OpenGL ES, mfard must show path-traced objects as usual. If the rendering is "preview",
# which needs OpenGL ES, mfard must say so and show pictures without objects.
. "$(dirname "$0")/lib.sh"

"$sim" --scene office --path handheld --seconds 0.5 --stills 6 --no-truth \
    --out run >/dev/null || fail "mfar-sim made no recording"

# The dynamic linker loads the first file with a library's name. Here this file is empty, so loading fails.
mkdir hidden
: >hidden/libEGL.so.1
: >hidden/libGLESv2.so.2
export LD_LIBRARY_PATH=$PWD/hidden${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}

# last NAME [ARGUMENT...]: plays the recording. NAME.raw gets the last shown picture.
last() {
    local name=$1
    shift
    run 0 --recording run --size 1152x864 --display "y4m:$name.y4m" --summary summary.json "$@"
    says err "engine simd"
    tail -c $((1152 * 864 * 3 / 2)) "$name.y4m" >"$name.raw"
    rm "$name.y4m"
}
differing() { { cmp -l plain.raw "$1.raw" || true; } | wc -l; }

last plain
cat >preview.toml <<'END'
[virtual]
rendering = "preview"
[[objects]]
shape = "box"
size = [0.1, 0.1, 0.1]
position = [0.0, 0.0, 0.06]
END
# CTest sets MFAR_PATIENCE above 1 for slow machines and sanitizers. To save time, the path tracer
# then gets few pixels and samples.
few=
[ "$patience" = 1 ] || few='\nresolution = 0.1\nsamples = 1\nbudget_ms = 60'
sed "s/\"preview\"/\"path-traced\"$few/" preview.toml >traced.toml

last preview --config preview.toml
says err "warning: previews of virtual objects need OpenGL ES 3.1 and are not shown: "
[ "$(differing preview)" = 0 ] ||
    fail "the picture differs from that without objects, although the preview cannot be shown"

last traced --config traced.toml
! grep -q "are not shown" err || fail "mfard reports that path-traced objects are not shown"
shown=$(differing traced)
echo "$shown bytes differ with the path-traced object"
[ "$shown" -gt 12500 ] || fail "the path-traced object is not shown"
