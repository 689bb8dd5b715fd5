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

echo "a reload that changes nothing keeps what the governor has measured"
# The times of the table are far too short, so the governor first tries the slow level.
cat >short.table <<'END'
[[level]]
name = "fast"
ms = 0.002
psnr_db = 20
mode = "off"
[[level]]
name = "slow"
ms = 0.004
psnr_db = 30
mode = "detail"
END
printf 'source = "synthetic:moving"\n[governor]\ndeadline_ms = 0.01\ntable = "short.table"\n' >short.toml
ctl="$(dirname "$sim")/mfarctl"
framesOf() { "$ctl" --socket control stats | sed -n "s/.*\"$1\": \([0-9]*\).*/\1/p"; }
start --config short.toml --display none --control control
passed() { [ "$(framesOf fast || true)" -gt 20 ]; }
until_true passed
slow=$(framesOf slow)
[ "$slow" -gt 0 ] || fail "the slow level was not tried"
"$ctl" --socket control reload >/dev/null
before=$(framesOf fast)
passed() { [ "$(framesOf fast)" -gt $((before + 20)) ]; }
until_true passed
[ "$(framesOf slow)" = "$slow" ] || fail "after the reload, the slow level was tried again"
kill -TERM "$pid"
ends_with 0 3000
