#!/usr/bin/env bash
# Filters must be learned from matched stills, survive a restart, and be deleted on request.
. "$(dirname "$0")/lib.sh"

ctl="$(dirname "$sim")/mfarctl"
mkdir state
export STATE_DIRECTORY="$work/state"
printf '[engine]\nuse = "simd"\n[trigger]\nmode = "rate"\nrate_hz = 10.0\nmin_interval_s = 0.0\n' >mfard.toml
learn() { run 0 --config mfard.toml --source synthetic:office --pace consumer --size 1152x864 --summary summary.json "$@"; }
stills() { sed -n 's/.*"stills_learned": \([0-9]*\),*/\1/p' summary.json; }

learn --frames 6
first=$(stills)
[ "$first" -ge 1 ] || fail "filters were not learned from any still"
file=$(ls state/filters-*.learned)

echo "after a restart, learning continues with the stored filters"
learn --frames 6
[ "$(stills)" -gt "$first" ] ||
    fail "learning began anew instead of continuing with the stored filters"

echo "a truncated file of filters is reported and replaced"
truncate -s 5000 "$file"
learn --frames 6
says err 'filters-.*\.learned: .*; learning starts again'
[ "$(stills)" = "$first" ] || fail "filters were learned from $(stills) stills instead of $first"
learn --frames 1
if grep -q 'learning starts again' err; then fail "the truncated file was not replaced"; fi

echo "nothing is learned when learning is switched off"
printf '[superres]\nlearn = false\n' >>mfard.toml
learn --frames 6
summary_has stills_learned 0
sed -i '/superres/,$d' mfard.toml

echo "filters are also learned while the GLES engine draws"
sed -i 's/"simd"/"gles"/' mfard.toml
mv "$file" kept
learn --frames 10
[ "$(stills)" -ge 1 ] || fail "filters were not learned from any still"
sed -i 's/"gles"/"simd"/' mfard.toml
mv kept "$file"

echo "mfarctl learn reset deletes the learned filters"
start --config mfard.toml --source synthetic:office,rest --control control
until_true started
"$ctl" --socket control status >answer
says answer '^learned +[1-9][0-9]* stills; '
"$ctl" --socket control learn reset
forgotten() { [ ! -e "$file" ]; }
until_true forgotten
kill -TERM "$pid"
ends_with 0 3000
