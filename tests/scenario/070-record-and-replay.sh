#!/bin/bash
# A recording of a live run must replay with the same frames and the same still. The first picture
# must be the same, too.
. "$(dirname "$0")/lib.sh"

record run 8 --source synthetic:office --size 1152x864 --display png:live --summary summary.json
summary_has recorder 0
summary_has used 1
run 0 --recording run --size 1152x864 --display png:again --summary summary.json
summary_has frames 8
[ "$(grep -vc '^#' run/cam0/data.csv)" = 8 ] || fail "the recording has not 8 frames"
[ "$(grep -vc '^#' run/cam1/data.csv)" = 1 ] || fail "the recording has not exactly one still"

# Later pictures can differ: the replay can already use the still in frames in which the live run
# waited for the still.
first=$(ls live | sort -n | head -n 1)
cmp "live/$first" "again/$first" ||
    fail "the first picture of the replay differs from that of the live run"

# The recording must have a pose for each of its 8 frames.
echo "the scene's tags and the poses from them are recorded, too"
[ "$(grep -c '^id = ' run/tags.toml)" -ge 3 ] ||
    fail "tags.toml of the recording has fewer than 3 tags"
poses=run/state_groundtruth_estimate0/data.csv
[ "$(grep -vc '^#' $poses)" -ge 8 ] || fail "the recording has fewer than 8 poses"
run 0 --recording run --summary summary.json
says err 'poses from a map of [0-9]+ tags; '
echo 'time_offset: 0.0125' >>run/cam1/sensor.yaml
run 0 --recording run --pose recorded --record copy --summary summary.json
summary_has tracked 8
summary_has stills_tracked 1
cmp $poses copy/${poses#run/} || fail "a recording of the replay has other poses"
grep '^time_offset: 0.0125 ' copy/cam1/sensor.yaml ||
    fail "a recording of the replay lacks the clock offset that its stills' times contain"

echo "a display replaces no file if the recording cannot begin"
echo kept >video.y4m
run 74 --recording run --record run --display y4m:video.y4m
says err 'not empty'
[[ $(<video.y4m) == kept ]] || fail "the file of the display was replaced"
