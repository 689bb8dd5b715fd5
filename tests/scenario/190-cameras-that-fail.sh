#!/usr/bin/env bash
# Two simulated V4L2 cameras fail in many ways. The video must continue while the video camera
# works. Status, counters or log must report each fault.
. "$(dirname "$0")/lib.sh"

ctl="$(dirname "$sim")/mfarctl"
pretended=$3
pretended_cameras

# says_of CAMERA FAULT...: sets the faults that the simulated camera has from now on.
says_of() {
    local camera=$1
    shift
    echo "$*" >cameras/.new
    mv cameras/.new "cameras/$camera"
}

begin() {
    rm -f summary.json
    export LD_PRELOAD=$pretended MFAR_PRETENDED_V4L2=$work/cameras
    start --config mfard.toml --display none --control control --summary summary.json
    unset LD_PRELOAD MFAR_PRETENDED_V4L2
    until_true shows_pictures 5
}
stop_now() {
    kill -TERM "$pid"
    ends_with 0 "$1"
}
status() { timeout -s KILL $((30 * patience)) "$ctl" --socket control status >answer 2>err.ctl; }
stats() { timeout -s KILL $((30 * patience)) "$ctl" --socket control stats >stats.json 2>err.ctl; }
shows_pictures() { status && [ "$(awk '$1 == "frames" {print $2}' answer)" -ge "$1" ] 2>/dev/null; }
goes_on() {
    status || fail "mfard does not answer mfarctl status"
    until_true shows_pictures $(($(awk '$1 == "frames" {print $2}' answer) + 20))
}
fault_is() { status && grep -Eq "^fault +$1" answer; }
counts() {
    awk -v camera="\"$1\": {" -v key="\"$2\":" \
        '/"cameras": {/ {in_cameras = 1} in_cameras && index($0, camera) {here = 1}
         here && index($0, key) {gsub(/[",]/, ""); print $2; exit}' stats.json
}
at_least() { stats && [ "$(counts "$1" "$2")" -ge "$3" ] 2>/dev/null; }
warned() { grep -q -- "$1" err; }

echo "the still driver hangs: the video continues, and status names the still camera"
begin
until_true fault_is none
says_of video91 hang
until_true fault_is 'still camera: its driver does not answer'
goes_on
echo "the still driver that hangs does not delay the end of mfard"
stop_now 1500
summary_has exit_code 0
says_of video91

echo "the still camera works again"
begin
says_of video91 hang
until_true fault_is 'still camera: its driver does not answer'
says_of video91
until_true fault_is none
goes_on

echo "status names a still camera that sends nothing"
says_of video91 silent
until_true fault_is 'still camera: sends no pictures'
goes_on
says_of video91
until_true fault_is none

echo "the video driver hangs: status names the video camera"
says_of video90 hang
until_true fault_is 'video camera: its driver does not answer'
says_of video90
until_true fault_is none
goes_on

echo "a video camera that repeats one picture is reported"
says_of video90 repeat
until_true warned 'video camera: repeats the same picture'
says_of video90
goes_on
stats
awk -v age="$(counts video distinct_age_s)" 'BEGIN {exit !(age < 1)}' ||
    fail "the video camera has sent no new picture for a second"

echo "frames that are broken, short, or have impossible times are counted; the video continues"
says_of video90 error 3 short 5 backward 7 future 11
until_true at_least video broken 10
until_true at_least video bad_times 10
goes_on
says_of video90

echo "missing frame numbers are counted exactly; numbers that restart at 0 do not count as missing"
stats
before=$(counts video missed)
says_of video90 skip 12
until_true at_least video missed $((before + 12))
says_of video90 restart
goes_on
stats
[ "$(counts video missed)" = $((before + 12)) ] ||
    fail "mfard counts $(counts video missed) missed frames; expected: 12 more than the earlier $before"
stop_now 1500

echo "a camera with half its configured rate is reported, but its frames do not count as missed"
says_of video90 rate 15
begin
until_true warned 'video camera: sends 1[45]\.[0-9] frames per second instead of the configured 30'
stats
[ "$(counts video missed)" -le 3 ] ||
    fail "$(counts video missed) missed frames of a camera with half its rate; limit: 3"
stop_now 1500

echo "a driver that grants few buffers can be used"
for buffers in 1 3; do
    says_of video90 buffers $buffers
    says_of video91 buffers $buffers
    begin
    goes_on
    until_true warned "/dev/video90: the driver allocated only $buffers of 6 buffers, so every picture is copied"
    stats
    stop_now 1500
done

echo "a camera is absent at boot: the other camera runs, and status reports only the absent one"
for absent in video still; do
    device=video90
    [ $absent = video ] || device=video91
    rm cameras/$device
    rm -f summary.json
    export LD_PRELOAD=$pretended MFAR_PRETENDED_V4L2=$work/cameras
    begun=$(milliseconds)
    start --config mfard.toml --display none --control control --summary summary.json
    unset LD_PRELOAD MFAR_PRETENDED_V4L2
    until_true started
    [ $(($(milliseconds) - begun)) -le $((5000 * patience)) ] ||
        fail "mfard was not ready within 5 s times MFAR_PATIENCE ($patience)"
    other=still
    [ $absent = video ] || other=video
    until_true at_least $other delivered 3
    until_true fault_is "$absent camera: .*$device"
    status && grep -q "^fault .*$other camera" answer &&
        fail "status reports a fault of the $other camera"
    [ $absent = video ] || goes_on
    touch cameras/$device
    until_true fault_is none
    goes_on
    stop_now 1500
done
