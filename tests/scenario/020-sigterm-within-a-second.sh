#!/bin/bash
# SIGTERM and SIGINT must end mfard within one second, whatever it waits for, and within 2.5 s if
# even its log blocks. The limits in this test are half a second longer, because the scheduler may
# delay mfard.
. "$(dirname "$0")/lib.sh"

limit=1500
# True if mfard handles SIGHUP, SIGINT and SIGTERM itself. It then blocks them, which the mask of
# blocked signals shows.
signals_watched() { grep -q '^SigBlk:.*4003$' "/proc/$pid/status"; }
record run 3 --source synthetic:flat,rest
mkfifo pipe

echo "SIGTERM while frames arrive ends mfard"
start --source synthetic:flat --summary summary.json
until_true started
kill -TERM "$pid"
ends_with 0 $limit
summary_has exit_reason '"SIGTERM"'

echo "SIGTERM during a recording: the list of the recording names all pictures that it contains"
start --source synthetic:flat --record cut --summary summary.json
until_true test -s cut/cam0/data.csv
until_true grep -q png cut/cam0/data.csv
kill -TERM "$pid"
ends_with 0 $limit
taken=$(grep -vc '^#' cut/cam0/data.csv)
[ "$(find cut/cam0/data -name '*.png' | wc -l)" = "$taken" ] ||
    fail "the recording has pictures that are not in its data.csv"
run 0 --recording cut --summary summary.json
summary_has frames "$taken"

echo "SIGINT while mfard waits for a frame that comes in an hour"
cp -r run gap
last=$(tail -n 1 gap/cam0/data.csv)
sed -i '$d' gap/cam0/data.csv
echo "$((${last%,*} + 3600000000000)),${last#*,}" >>gap/cam0/data.csv
start --recording gap --pace realtime --summary summary.json
until_true started
kill -INT "$pid"
ends_with 0 $limit
summary_has exit_reason '"SIGINT"'

echo "SIGTERM while mfard waits for a program that reads the display pipe"
start --recording run --display y4m:pipe
until_true signals_watched
sleep 1
kill -TERM "$pid"
ends_with 0 $limit

# True if all threads of mfard sleep in each of five checks. A thread that only waits for a
# processor does not sleep.
at_rest() {
    for _ in 1 2 3 4 5; do
        if cat /proc/"$pid"/task/*/stat | grep -q ') [RD] '; then return 1; fi
        sleep 0.1
    done
}

# The reader takes the first bytes of a picture. The pipe can hold a hundredth of the rest. So mfard
# soon blocks.
start_blocked() {
    exec 3>&- # no process has the pipe open any more, so the pipe is empty again
    exec 3<>pipe
    start --recording run --display y4m:pipe --summary summary.json
    timeout $((30 * patience)) head -c 5000 <&3 >/dev/null ||
        fail "mfard writes no picture into the display pipe"
    until_true at_rest
}

echo "SIGTERM while the reader of the display pipe no longer reads"
# mfard's threads have half a second to stop writing. After that, mfard ends without them. On a busy
# machine, an end without them is accepted, but the threads must stop in time in at least one of a
# few tries.
for _ in $(seq "$patience"); do
    start_blocked
    kill -TERM "$pid"
    ends_with 0 $limit
    summary_has exit_reason '"SIGTERM"'
    if grep -q 'not all output was written' err; then break; fi
    says err "did not stop in time"
done
says err 'not all output was written'

echo "a second signal ends mfard at once"
start_blocked
kill -TERM "$pid"
sleep 0.05
kill -INT "$pid"
ends_with 130 $limit
says err 'SIGINT received after SIGTERM'

echo "SIGTERM that arrives twice, as that of timeout, counts once"
start_blocked
kill -TERM "$pid"
sleep 0.02
kill -TERM "$pid"
ends_with 0 $limit
summary_has exit_reason '"SIGTERM"'
exec 3>&-

echo "SIGTERM during the first milliseconds"
start --source synthetic:flat
sleep 0.02
kill -TERM "$pid"
# Exit code 143: the signal came before mfard handled signals itself, so it ended the process.
code=0
wait "$pid" || code=$?
[ "$code" = 0 ] || [ "$code" = 143 ] || fail "mfard ended with exit code $code instead of 0 or 143"

echo "SIGTERM while shaders are compiled"
for wait in 0.05 0.3 0.8; do
    MESA_SHADER_CACHE_DISABLE=true start --recording gap --engine gles --pace realtime
    until_true signals_watched
    sleep $wait
    kill -TERM "$pid"
    ends_with 0 $limit
done

echo "SIGTERM while nobody reads mfard's messages"
mkfifo words
exec 4<>words
head -c 65536 /dev/zero >&4 # fills the pipe
"$mfard" --source synthetic:flat,rest --display none >out 2>words 4>&- &
pid=$!
pids+=("$pid")
until_true signals_watched
sleep 1
kill -TERM "$pid"
ends_with 0 3000
exec 4>&-
