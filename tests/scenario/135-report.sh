#!/usr/bin/env bash
# mfard --report must write one page with the summary's numbers and with pictures, however the run
# ends.
. "$(dirname "$0")/lib.sh"

has_report() {
    local pattern
    for pattern in '^<!DOCTYPE html>' '^</html>$' "$@"; do says run.html "$pattern"; done
    [ "$(find . -name '*.part' | wc -l)" = 0 ] || fail "a temporary file *.part is left"
}

echo "the report of a run that ends by itself"
run 0 --source synthetic:office --pace consumer --display none --frames 12 --engine simd \
    --summary summary.json --report run.html
has_report '<tr><th>frames</th><td>12</td></tr>' 'Time of each stage' 'flow \[ms\]' \
    'alt="last picture shown" src="data:image/jpeg;base64,/9j/' \
    'alt="last still used" src="data:image/jpeg;base64,/9j/'
summary_has frames 12
[ "$(stat -c %s run.html)" -lt 500000 ] || fail "run.html has 500000 bytes or more"

echo "the report of a run that a signal ends"
start --source synthetic:flat --display none --report run.html
until_true started
has_report 'the run has not ended'
kill -TERM "$pid"
ends_with 0 3500
has_report SIGTERM

echo "the report has its pictures although the current picture takes long"
start --source synthetic:office --display none --engine simd --report run.html
until_true grep -q 'first picture' err
# All threads but the main thread get nearly no processor time until 0.7 s after the signal, because
# a busy loop on the same processor has a higher priority.
cpus=$(sed -n 's/^Cpus_allowed_list:[[:space:]]*//p' /proc/self/status)
cpu=${cpus%%[-,]*}
taskset -c "$cpu" sh -c 'while :; do :; done' &
busy=$!
pids+=("$busy")
for thread in /proc/"$pid"/task/*; do
    [ "${thread##*/}" != "$pid" ] || continue
    # The thread may have ended meanwhile.
    chrt --idle --pid 0 "${thread##*/}" 2>/dev/null || continue
    taskset -pc "$cpu" "${thread##*/}" >/dev/null 2>&1 || true
done
sleep 0.3
begin=$(milliseconds)
kill -TERM "$pid"
sleep 0.7
kill -KILL "$busy"
# From here on, other programs on this machine must not keep the threads from running.
for thread in /proc/"$pid"/task/*; do
    chrt --other --pid 0 "${thread##*/}" 2>/dev/null || true
    taskset -pc "$cpus" "${thread##*/}" >/dev/null 2>&1 || true
done
ends_with 0 3500
has_report SIGTERM
# If the machine is so slow that 1.5 s are too short, the report may lack its pictures.
# mfard writes its last message when it stops waiting for the picture.
waited=$(($(date -r err +%s%3N) - begin))
grep -q 'alt="last picture shown"' run.html || [ "$waited" -ge 1490 ] ||
    fail "the report has no pictures, although there was time to complete the current picture"

echo "the report of a run that fails"
run 66 --recording absent --display none --report run.html
has_report 'error: .*absent'

echo "a report that cannot be written ends mfard with an error"
run 74 --source synthetic:flat --display none --frames 1 --report absent/run.html
says err 'the report cannot be written: absent/run.html: No such file or directory'

echo "a summary that cannot be written is reported with the cause"
run 74 --source synthetic:flat --display none --frames 1 --summary /dev/full
says err 'the summary cannot be written: /dev/full: No space left on device'
