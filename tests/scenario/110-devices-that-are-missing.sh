#!/usr/bin/env bash
# Without its cameras or its screen, mfard must run. The log must name the missing devices.
. "$(dirname "$0")/lib.sh"

cat >mfard.toml <<'END'
source = "cameras"
[cameras.video]
driver = "v4l2"
camera = "/dev/no-such-camera"
[cameras.still]
driver = "v4l2"
camera = "no such card"
[cameras.trigger]
chip = "no such chip"
line = "5"
END

start --config mfard.toml --display png:frames --summary summary.json --seconds 2
ends_with 0 6000
says err 'warning: video camera: '
says err 'still camera: .*no such card'
[ "$(find frames -name '*.png' | wc -l)" -ge 5 ] ||
    fail "mfard showed fewer than 5 pictures while the cameras were missing"
summary_has frames 0
summary_has faults 1

# The trigger line is also missing. So releasing it must fail with a reason.
run 69 --config mfard.toml --release-trigger
says err 'no such chip'
sed -i '/trigger/,$d' mfard.toml
run 0 --config mfard.toml --release-trigger

# mfard waits for missing devices, but a missing calibration is an error.
sed -i '1a [cameras]\ncalibration = "lenses"' mfard.toml
run 66 --config mfard.toml
says err 'lenses'

echo "without a screen, pictures are drawn and not shown"
run 0 --source synthetic:flat --display kms:card97 --frames 2
says err 'first picture drawn [0-9]+ ms .*, but not shown: no screen yet .*card97'
says err '2 pictures in [0-9.]+ s, [0-9.]+ fps: the requested number of pictures has been made$'
