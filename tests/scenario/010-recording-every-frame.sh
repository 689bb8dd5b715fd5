#!/bin/bash
# Every frame of a recording is shown, whatever the machine's speed.
. "$(dirname "$0")/lib.sh"

record run 4 --source synthetic:flat,pan
run 0 --recording run --display png:shown --summary summary.json
frames=$(grep -vc '^#' run/cam0/data.csv)
[ "$frames" = 4 ] || fail "$frames frames were recorded instead of 4"
says err '4 pictures in [0-9.]+ s, [0-9.]+ fps: end of the source'
summary_has frames 4
summary_has mailbox 0
summary_has exit_reason '"end of the source"'
while IFS=, read -r time _; do
    [ -s "shown/$time.png" ] || fail "picture of frame $time is missing"
    # Bytes 16 to 23 of a PNG file are its width and height.
    size=$(od -An -tu1 -j16 -N8 "shown/$time.png" | tr -s ' ')
    [ "$size" = " 0 0 9 0 0 0 6 192" ] || fail "picture $time is not 2304x1728:$size"
done < <(grep -v '^#' run/cam0/data.csv)
[ "$(find shown -type f | wc -l)" = 4 ] ||
    fail "the display's folder contains other files than four pictures: $(ls shown)"
