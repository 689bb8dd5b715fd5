#!/bin/bash
# The tags of the scene must give every frame and still a pose. Flow must be searched along epipolar
# lines.
. "$(dirname "$0")/lib.sh"

run 0 --source synthetic:office --pace consumer --frames 8 --summary summary.json
says err 'poses from a map of [0-9]+ tags; '
summary_has asked 8
summary_has tracked 8
summary_has measured 8
summary_has used 1
summary_has stills_measured 1
summary_has jumps 0
says summary.json '"epipolar_frames": [1-8],$'

echo "without poses the same frames are matched in both dimensions"
run 0 --source synthetic:office --pace consumer --frames 4 --pose none --summary summary.json
says err 'no poses; '
summary_has asked 0
summary_has epipolar_frames 0
summary_has used 1

echo "an invalid or missing tag map is refused with its file, also by --check-config"
printf '[pose]\ntags = "map.toml"\n' >mfard.toml
for check in "" --check-config; do
    run 66 --config mfard.toml $check
    says err 'map.toml: is missing$'
done
printf 'family = "tag36h11"\n[[tags]]\nid = 3\nsize = -0.1\n' >map.toml
for check in "" --check-config; do
    run 65 --config mfard.toml $check
    says err 'map.toml:[0-9]+: '
    [ "$(wc -l <err)" = 1 ] || fail "mfard did not write exactly one message"
done
