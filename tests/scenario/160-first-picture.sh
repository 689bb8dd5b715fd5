#!/usr/bin/env bash
# The first picture must come soon after the start. Before it, mfard must not touch memory that this
# picture does not need. (Touching 220 MB more took most of a second.)
. "$(dirname "$0")/lib.sh"

# `./run test` gives malloc large pages. They would hide which memory is touched.
unset GLIBC_TUNABLES
"$sim" --scene flat --path pan --seconds 0.1 --stills 10 --no-truth --out run >/dev/null ||
    fail "mfar-sim made no recording"
run 0 --engine simd --recording run --display "png:shown" --size still --frames 1 \
    --summary summary.json
says err "first picture [0-9]+ ms after the start, [0-9]+ MB resident"
grep -A3 first_picture summary.json
resident=$(sed -n 's/.*"resident_mb": \([0-9]*\).*/\1/p' summary.json)
[ -n "$resident" ] || fail "the summary does not report the memory in use"
[ "$resident" -gt 20 ] ||
    fail "the summary reports only $resident MB of memory, which is implausible"
# About 90 MB are used on x86-64, 30 of them by programs and libraries. If mfard touched all its
# buffers, 310 MB would be used.
[ "$resident" -lt 180 ] || fail "$resident MB of memory are in use at the first picture; limit: 180 MB"
