#!/usr/bin/env bash
# mfard must report a GPU that is lost or hangs, and set it up again. Control and cameras must
# continue. After three failures within a minute, the CPU must draw, and a text in the picture must
# report this. mfard must report a driver that does not return, and a run with a time limit must
# still end. Usage: 240-gpu-that-fails.sh MFARD MFAR-SIM PRETENDED.so FAULTY-GL-FOLDER EVEN-LAST-ROW
. "$(dirname "$0")/lib.sh"

pretended=$3
faulty=$4
even=$5
ctl="$(dirname "$sim")/mfarctl"
control() { timeout $((10 * patience)) "$ctl" --socket control "$@"; }
status_says() { control status | grep -Eq -- "$1"; }
frames() { [ "$(control status | sed -n 's/^frames  *//p')" -gt "$1" ] 2>/dev/null; }
gpu_says() {
    echo "$1" >gl.new
    mv gl.new gl
}
failed_times() { control stats | grep -Eq "\"gpu_failures\": ?$1,"; }
goes_on() { until_true frames $(($(control status | sed -n 's/^frames  *//p') + 10)); }

# Writes a snapshot. True if it shows a text at its lower edge. The background of a text has one
# colour, whereas the camera's pictures are noise.
has_text() {
    local status=0
    control snapshot "$1"
    "$even" "$1" || status=$?
    [ $status -le 1 ] || fail "$1 cannot be read"
    return $status
}

pretended_cameras '[status]
interval_s = 0.2'
begin() {
    gpu_says ""
    LD_LIBRARY_PATH=$faulty LD_PRELOAD=$pretended MFAR_PRETENDED_V4L2=$PWD/cameras \
        MFAR_FAULTY_GL=$PWD/gl start --config mfard.toml --display none \
        --control control --summary summary.json "$@"
    until_true frames 12
    status_says '^health +ok' || fail "the state in mfard's status is not ok"
}

echo "the OpenGL ES context is lost: mfard restarts the GPU"
begin --engine gles --mode detail
gpu_says "lost once"
until_true failed_times 1
until_true status_says \
    '^health +degraded for .*: the GPU failed and was restarted \(the OpenGL ES context is lost\)'
goes_on
until_true says err 'the GPU failed and was restarted \(.*\); the restart took [0-9]{1,4} ms'

echo "the GPU does not finish a picture: mfard restarts the GPU"
gpu_says never
until_true failed_times 2
gpu_says ""
goes_on
status_says '^health .*: the GPU failed and was restarted \(the GPU does not finish a picture\)' ||
    fail "status does not report that the GPU did not finish a picture"
status_says '^engine +gles' || fail "status does not report that the GLES engine draws"
! has_text before.png || fail "a text in the picture reports a GPU that was restarted"

echo "after the third failure the CPU draws"
gpu_says "lost again"
until_true status_says '^engine +simd'
goes_on
status_says '^health +degraded for .*: the GPU failed 3 times within a minute, so the CPU draws now' ||
    fail "the health in the status does not report that the CPU draws"
status_says '^renderer +without OpenGL ES' || fail "status still names a renderer of OpenGL ES"
has_text after.png || fail "no text in the picture reports that the CPU draws"
kill -TERM "$pid"
ends_with 0 1000
summary_has gpu_failures 3
summary_has engine '"simd"'

echo "if every context is lost at its first use, the CPU draws"
begin --engine gles
gpu_says broken
until_true status_says '^engine +simd'
goes_on
kill -TERM "$pid"
ends_with 0 1000

echo "a driver that does not return from drawing is reported; a run with a time limit still ends"
begin --engine gles --seconds 4
gpu_says hang
until_true status_says '^health +stalled for .*: the picture thread hangs'
ends_with 0 6000
says err 'the picture thread hangs; ended without waiting for it'
summary_has exit_reason '"--seconds"'
