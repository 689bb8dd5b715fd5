#!/usr/bin/env bash
# A GPU that does not finish a picture is named, while control and cameras go on; one that never does
# and a context that is lost end mfard with 70, so that the service manager starts it again.
# Usage: 240-gpu-that-fails.sh MFARD MFAR-SIM PRETENDED.so FAULTY-GL-FOLDER
. "$(dirname "$0")/lib.sh"

pretended=$3
faulty=$4
ctl="$(dirname "$sim")/mfarctl"
status() { timeout 10 "$ctl" --socket control status; }
status_says() { status | grep -Eq -- "$1"; }
frames() { [ "$(status | sed -n 's/^frames  *//p')" -gt "$1" ] 2>/dev/null; }
# What is wrong with the GPU from now on.
gpu_says() {
    echo "$1" >gl.new
    mv gl.new gl
}

pretended_cameras
begin() {
    gpu_says ""
    LD_LIBRARY_PATH=$faulty LD_PRELOAD=$pretended MFAR_PRETENDED_V4L2=$PWD/cameras \
        MFAR_FAULTY_GL=$PWD/gl start --config mfard.toml --engine gles --display none \
        --control control --summary summary.json "$@"
    until_true frames 12
    status_says '"state":"ok"' || fail "it is not ok"
}

echo "it is late: named, and all is well when it goes on"
begin
gpu_says never
until_true status_says '"state":"degraded","cause":"the GPU does not finish a picture"'
gpu_says ""
until_true status_says '"state":"ok"'
until_true frames $(($(status | sed -n 's/^frames  *//p') + 10))

echo "it never finishes"
gpu_says never
ends_with 70 10000
says err 'error: the GPU has not finished a picture for [5-9]'
summary_has exit_code 70

echo "a driver that does not return from drawing is named, and holds up no run of some seconds"
begin --seconds 4
gpu_says hang
until_true status_says '"state":"stalled","cause":"the picture thread hangs"'
ends_with 0 6000
says err 'the picture thread hangs, ended without it'
summary_has exit_reason '"--seconds"'

echo "its context is lost"
begin
gpu_says lost
ends_with 70 1500
says err 'error: the context of OpenGL ES is lost'
