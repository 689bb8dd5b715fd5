#!/usr/bin/env bash
# mfard is killed at random moments, also during a trigger pulse. Each start must show its first
# picture within five seconds and replace the control socket of the dead process. The hook that
# systemd runs after a crash must release the trigger line. Every recording must be readable. In the
# second half of the rounds, the trigger line is active when its level is low. Usage:
# 260-killed-at-random.sh MFARD MFAR-SIM PRETENDED.so TIMES RELEASE-TRIGGER
. "$(dirname "$0")/lib.sh"

pretended=$3
times=$4
release=$5
ctl="$(dirname "$sim")/mfarctl"
RANDOM=${MFAR_SEED:-7}
mkdir state run
export STATE_DIRECTORY=$PWD/state RUNTIME_DIRECTORY=$PWD/run MFAR_PRETENDED_V4L2=$PWD/cameras
pretended_cameras '[cameras.trigger]
line = "TRIGGER"
pulse_ms = 100.0
[trigger]
mode = "rate"
rate_hz = 6.0
[record]
directory = "films"'
sed -i 's/^rate_hz = 5.0/rate_hz = 0.0/' mfard.toml
echo triggered >cameras/video91
touch cameras/gpiochip0
shows_pictures() {
    [ "$(timeout $((10 * patience)) "$ctl" --socket control status 2>/dev/null | sed -n 's/^frames  *//p')" -gt 0 ] 2>/dev/null
}
begin() {
    begun=$(milliseconds)
    LD_PRELOAD=$pretended start --config mfard.toml --display none --control control
}
recorded() { cat films/*/cam0/data.csv 2>/dev/null | grep -c '^[0-9]' || true; }
records() { [ "$(recorded)" -gt "$before" ]; }
active_level=1
is_active() { [ "$(cat cameras/line 2>/dev/null)" = $active_level ]; }

active=0
first_low=0
for round in $(seq "$times"); do
    if [ $((2 * round)) -gt "$times" ] && [ $active_level = 1 ]; then
        active_level=0
        first_low=$round
        echo 1 >cameras/line
        sed -i 's/^line = "TRIGGER"/&\nactive_low = true/' mfard.toml
    fi
    before=$(recorded)
    begin
    sleep 0.$((RANDOM % 3))$((RANDOM % 10))
    # Every second process shows its first picture before it is killed. So does the first process
    # with active_level 0, because mfard must write the file from which release-trigger learns the
    # level. Every fourth process is killed while it records and a trigger pulse is active.
    if [ $((round % 2)) = 0 ] || [ $round = $first_low ]; then
        until_true shows_pictures
        took=$(($(milliseconds) - begun))
        [ $took -le $((5000 * patience)) ] ||
            fail "round $round: the first picture came only after $took ms"
    fi
    if [ $((round % 4)) = 0 ]; then
        until_true records
        until_true is_active
    fi
    kill -KILL "$pid"
    wait "$pid" 2>/dev/null || true
    if is_active; then active=$((active + 1)); fi
    LD_PRELOAD=$pretended "$release" || fail "round $round: release-trigger failed"
    if is_active; then fail "round $round: the trigger line is still active"; fi
done
[ $active -ge $((times / 10)) ] || fail "only $active of $times kills happened during a trigger pulse; expected: a tenth or more"
begin
until_true shows_pictures
kill -TERM "$pid"
ends_with 0 1500

readable=0
for film in films/*; do
    [ "$(cat "$film/cam0/data.csv" 2>/dev/null | wc -l)" -gt 1 ] || continue
    run 0 --recording "$film" --frames 1
    readable=$((readable + 1))
done
echo "$times kills, $active of them during a trigger pulse; $readable readable recordings with pictures"
[ $readable -ge $((times / 4)) ] ||
    fail "only $readable recordings have pictures; expected: $((times / 4)) or more"
