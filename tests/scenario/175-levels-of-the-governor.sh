#!/usr/bin/env bash
# A level of [governor] must change what mfard computes. Without time for better levels, the fastest
# one must be used.
. "$(dirname "$0")/lib.sh"

"$sim" --scene office --path handheld --seconds 0.3 --stills 3 --no-truth \
    --out run >/dev/null || fail "mfar-sim made no recording"

# last NAME [ARGUMENT...]: plays the recording. NAME.raw gets the last shown picture.
last() {
    local name=$1
    shift
    run 0 --recording run --size 1152x864 --display "y4m:$name.y4m" "$@"
    tail -c $((1152 * 864 * 3 / 2)) "$name.y4m" >"$name.raw"
}

last best
last off --mode off
! cmp -s best.raw off.raw || fail "mode \"off\" has no effect on the picture"
printf '[governor]\npin = "off"\n' >pinned.toml
last pinned --config pinned.toml
cmp off.raw pinned.raw || fail "the pinned level \"off\" shows another picture than mode \"off\""

printf '[governor]\ndeadline_ms = 0.01\n' >late.toml
run 0 --recording run --config late.toml --display none --summary summary.json
says summary.json '"off-linear": [1-9]'
