#!/bin/bash
# With a camera at rest, mfard must take exactly one still and use it. The picture must not change
# afterwards.
. "$(dirname "$0")/lib.sh"

# The run is longer than the age limit. Age alone must not cause a request for a still.
printf '[trigger]\nmax_age_s = 0.2\nmin_interval_s = 0.0\n' >mfard.toml
run 0 --config mfard.toml --source synthetic:still --pace consumer --frames 16 \
    --summary summary.json
summary_has triggered 1
summary_has received 1
summary_has used 1
summary_has lost 0
says summary.json '"unchanged": 0\.[6-9]'

printf '[trigger]\nmode = "off"\n' >mfard.toml
run 0 --config mfard.toml --source synthetic:still --pace consumer --frames 3 \
    --summary summary.json
summary_has triggered 0
