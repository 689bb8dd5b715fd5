#!/usr/bin/env bash
# The wall clock steps by an hour and by ten years, as on a board that gets the time late. mfard
# must continue to show frames, refuse none of them and write no warning. The times in a recording
# must increase, and each start must record into its own folder. Usage:
# 250-wall-clock-steps.sh MFARD MFAR-SIM PRETENDED.so CLOCK.so
. "$(dirname "$0")/lib.sh"

libraries=$3:$4
ctl="$(dirname "$sim")/mfarctl"
status() { timeout $((10 * patience)) "$ctl" --socket control status; }
frames() { status | sed -n 's/^frames  *//p'; }
more() { [ "$(frames)" -gt $((shown + 15)) ] 2>/dev/null; }
step() {
    echo "$1" >clock.new
    mv clock.new clock
}

pretended_cameras '[record]
directory = "films"'
begin() {
    LD_PRELOAD=$libraries MFAR_PRETENDED_V4L2=$PWD/cameras MFAR_CLOCK_IS_OFF=$PWD/clock start \
        --config mfard.toml --display none --control control --summary summary.json
    until_true started
}

step 0
begin
for seconds in 3600 -3600 315360000 -315360000 0; do
    step $seconds
    shown=$(frames)
    until_true more
    says <(status) '^health +ok'
done
kill -TERM "$pid"
ends_with 0 1500
summary_has faults 1 # the one fault: mfard waited until the cameras were open
summary_has bad_times 0
summary_has broken 0
if grep -q 'warning' err; then fail "mfard wrote a warning: $(grep warning err)"; fi

echo "the recorded times increase, and the next recording has its own folder"
film=$(echo films/*)
grep -v '^#' "$film/cam0/data.csv" | cut -d, -f1 >times
sort -n -u times | cmp - times || fail "the times in the recording do not increase"
[ "$(wc -l <times)" -ge 60 ] ||
    fail "only $(wc -l <times) pictures were recorded; expected: 60 or more"
step 315360000
begin
kill -TERM "$pid"
ends_with 0 1500
[ "$(find films -mindepth 1 -maxdepth 1 | wc -l)" = 2 ] ||
    fail "there are not two folders of recordings"
