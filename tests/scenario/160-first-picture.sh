#!/usr/bin/env bash
# The first picture comes soon after the start: memory that it does not need is not touched before
# it. (Touching 220 MB more took most of a second.)
. "$(dirname "$0")/lib.sh"

"$sim" --scene flat --path pan --seconds 0.1 --stills 10 --no-truth --out run >/dev/null ||
    fail "no recording"
run 0 --engine simd --recording run --display "png:shown" --size still --frames 1 \
    --summary summary.json
says err "first picture [0-9]+ ms after the start, [0-9]+ MB resident"
grep -A3 first_picture summary.json
resident=$(sed -n 's/.*"resident_mb": \([0-9]*\).*/\1/p' summary.json)
[ -n "$resident" ] || fail "the summary does not report the memory"
[ "$resident" -gt 20 ] || fail "$resident MB of memory are implausibly little"
# 90 MB on x86-64, 30 of them programs and libraries; 310 MB with all buffers of a run touched.
[ "$resident" -lt 180 ] || fail "$resident MB are in use at the first picture"
