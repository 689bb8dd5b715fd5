#!/bin/bash
# SIGTERM and SIGINT end mfard within one second, whatever it waits for. The limits leave half a
# second for the scheduler.
. "$(dirname "$0")/lib.sh"

limit=1500
# SIGHUP, SIGINT and SIGTERM are blocked as soon as mfard waits for them itself.
signals_watched() { grep -q '^SigBlk:.*4003$' "/proc/$pid/status"; }
record run 3 --source synthetic:flat,rest
mkfifo pipe

echo "while frames come"
start --source synthetic:flat --summary summary.json
until_true started
kill -TERM "$pid"
ends_with 0 $limit
summary_has exit_reason '"SIGTERM"'

echo "while recording: what was taken is written"
start --source synthetic:flat --record cut --summary summary.json
until_true test -s cut/cam0/data.csv
until_true grep -q png cut/cam0/data.csv
kill -TERM "$pid"
ends_with 0 $limit
taken=$(grep -vc '^#' cut/cam0/data.csv)
[ "$(find cut/cam0/data -name '*.png' | wc -l)" = "$taken" ] || fail "a picture is not in the list"
run 0 --recording cut --summary summary.json
summary_has frames "$taken"

echo "while waiting for a frame that comes in an hour"
cp -r run gap
last=$(tail -n 1 gap/cam0/data.csv)
sed -i '$d' gap/cam0/data.csv
echo "$((${last%,*} + 3600000000000)),${last#*,}" >>gap/cam0/data.csv
start --recording gap --pace realtime --summary summary.json
until_true started
kill -INT "$pid"
ends_with 0 $limit
summary_has exit_reason '"SIGINT"'

echo "while waiting for somebody who reads the display pipe"
start --recording run --display y4m:pipe
until_true signals_watched
sleep 1
kill -TERM "$pid"
ends_with 0 $limit

# All of mfard's threads wait, in each of five looks. One that others keep from the processor does not.
at_rest() {
    for _ in 1 2 3 4 5; do
        if cat /proc/"$pid"/task/*/stat | grep -q ') [RD] '; then return 1; fi
        sleep 0.1
    done
}

# The reader takes the first bytes of a picture. The pipe holds a hundredth of the others, so that
# mfard soon waits.
start_blocked() {
    exec 3>&- # nobody has it open any more, so it is empty again
    exec 3<>pipe
    start --recording run --display y4m:pipe --summary summary.json
    timeout $((30 * patience)) head -c 5000 <&3 >/dev/null || fail "no picture comes"
    until_true at_rest
}

echo "while the reader of the display pipe takes nothing more"
# The threads get half a second to give up, then mfard ends without them. A starved machine may need
# longer, which is as good an end; on any other they make it, so one of a few tries must.
for _ in $(seq "$patience"); do
    start_blocked
    kill -TERM "$pid"
    ends_with 0 $limit
    summary_has exit_reason '"SIGTERM"'
    if grep -q 'not everything was written' err; then break; fi
    says err 'did not end in time'
done
says err 'not everything was written'

echo "a second signal ends it at once"
start_blocked
kill -TERM "$pid"
sleep 0.05
kill -INT "$pid"
ends_with 130 $limit
says err 'second SIGINT'
exec 3>&-

echo "during the first milliseconds"
start --source synthetic:flat
sleep 0.02
kill -TERM "$pid"
# Before signals are taken over, the system's own way to end is as good.
code=0
wait "$pid" || code=$?
[ "$code" = 0 ] || [ "$code" = 143 ] || fail "ended with $code"

echo "while shaders are compiled"
for wait in 0.05 0.3 0.8; do
    MESA_SHADER_CACHE_DISABLE=true start --recording gap --engine gles --pace realtime
    until_true signals_watched
    sleep $wait
    kill -TERM "$pid"
    ends_with 0 $limit
done

echo "while nobody takes its messages"
mkfifo words
exec 4<>words
head -c 65536 /dev/zero >&4 # all that a pipe holds
"$mfard" --source synthetic:flat,rest --display none >out 2>words 4>&- &
pid=$!
pids+=("$pid")
until_true signals_watched
sleep 1
kill -TERM "$pid"
ends_with 0 3000
exec 4>&-
