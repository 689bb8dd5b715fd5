#!/bin/bash
# With validation, mfard checks the values that every pass writes. Super-resolution, depth, path
# tracing and warping of a hand-held view must write no invalid value.
. "$(dirname "$0")/lib.sh"

"$sim" --scene office --path handheld --seconds 0.2 --stills 5 --no-truth \
    --out run >/dev/null || fail "mfar-sim made no recording"
cat >jar.toml <<'END'
[virtual]
budget_ms = 40
resolution = 0.1
[[objects]]
model = "showpiece"
position = [0.02, -0.06, 0.0]
END
run 0 --recording run --config jar.toml --frames 4 --validate --summary summary.json
summary_has faulty_outputs 0
says summary.json '"values_checked": [1-9][0-9]{6,}'
if grep -q 'validation:' err; then fail "the log reports an invalid value, but the summary does not"; fi

run 0 --recording run --frames 1 --summary summary.json
summary_has values_checked 0
