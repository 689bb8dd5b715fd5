#!/usr/bin/env bash
# mfard is killed at random moments, again and again: each start shows its first picture within five
# seconds, finds the control socket of the dead one, and every recording can be read.
# Usage: 260-killed-at-random.sh MFARD MFAR-SIM PRETENDED.so
. "$(dirname "$0")/lib.sh"

pretended=$3
ctl="$(dirname "$sim")/mfarctl"
RANDOM=${MFAR_SEED:-7}
mkdir state
pretended_cameras '[record]
directory = "films"'
shows_pictures() {
    [ "$(timeout 10 "$ctl" --socket control status 2>/dev/null | sed -n 's/^frames  *//p')" -gt 0 ] 2>/dev/null
}
begin() {
    begun=$(milliseconds)
    LD_PRELOAD=$pretended MFAR_PRETENDED_V4L2=$PWD/cameras STATE_DIRECTORY=$PWD/state start \
        --config mfard.toml --display none --control control
}

for round in $(seq 20); do
    begin
    sleep 0.$((RANDOM % 3))$((RANDOM % 10))
    # Every second one has shown its first picture before.
    if [ $((round % 2)) = 0 ]; then
        until_true shows_pictures
        took=$(($(milliseconds) - begun))
        [ $took -le $((5000 * patience)) ] || fail "round $round: first picture after $took ms"
    fi
    kill -KILL "$pid"
    wait "$pid" 2>/dev/null || true
done
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
[ $readable -ge 8 ] || fail "only $readable recordings have pictures"
