#!/bin/bash
# With --pose recorded, mfard must use recorded poses instead of tags, and must refuse a recording
# without poses.
. "$(dirname "$0")/lib.sh"

"$sim" --scene office --path pan --seconds 0.2 --stills 5 --no-truth \
    --out run >/dev/null || fail "mfar-sim made no recording"
frames=$(grep -vc '^#' run/cam0/data.csv)

run 0 --recording run --pose recorded --summary summary.json
says err 'recorded poses; '
summary_has frames "$frames"
summary_has tracked "$frames"
summary_has measured 0
summary_has stills_tracked 1
summary_has stills_measured 0
says summary.json '"epipolar_frames": [1-9]'

echo "without --pose recorded, a replay uses the tags of the recording"
run 0 --recording run --summary summary.json
says err 'poses from a map of [0-9]+ tags; '
summary_has measured "$frames"

echo "an invalid tags.toml is refused with its file"
sed -i 's/^size = .*/size = 0/' run/tags.toml
run 65 --recording run
says err 'run/tags.toml:[0-9]+: size must be from 0.001 to 100 m'

echo "without a tag map, the largest tag of the recording is the origin of the world"
rm run/tags.toml
run 0 --recording run --summary summary.json
says err 'poses from the first tag, whose edge is 0.1 m; '
summary_has measured "$frames"

echo "a recording without poses is refused"
rm -r run/state_groundtruth_estimate0
run 65 --recording run --pose recorded
says err 'recording run: has no poses'
[ "$(wc -l <err)" = 1 ] || fail "mfard did not write exactly one message"
run 78 --source synthetic:flat --pose recorded
says err '--pose: "recorded" needs a recording'
run 64 --recording run --pose gps
says err 'tags, recorded, none'
