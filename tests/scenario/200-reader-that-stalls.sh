#!/usr/bin/env bash
# The program that reads the display's pipe stalls. With a live source, the pictures must continue,
# and the status must report that the reader stalls. With a recording, mfard must wait for the
# reader and report this. mfard must end when the reader closes the pipe, and after a signal. It
# must report output that it could not write.
. "$(dirname "$0")/lib.sh"

ctl="$(dirname "$sim")/mfarctl"
status() { timeout $((10 * patience)) "$ctl" --socket control status; }
status_says() { status | grep -Eq -- "$1"; }
frames() { status | sed -n 's/^frames  *//p'; }
mkfifo pipe
record run 3 --source synthetic:flat,rest

echo "with live cameras, pictures continue although the reader accepts no data"
printf '[superres]\nmode = "off"\n[trigger]\nmode = "off"\n' >mfard.toml
exec 3<>pipe
start --config mfard.toml --source synthetic:flat,rest --display y4m:pipe --control control \
    --summary summary.json 3>&-
until_true started
until_true status_says '^health +degraded for .*: y4m:pipe: the reader of the pipe accepts no data'
shown=$(frames)
more() { [ "$(frames)" -gt $((shown + 20)) ]; }
until_true more
until_true status_says '^line .*the reader of the pipe accepts no data.* [0-9]+ not written'
says err 'warning: y4m:pipe: the reader of the pipe accepts no data \(degraded'

echo "the reader reads again: mfard's state is ok"
cat <pipe >/dev/null 3>&- &
reader=$!
pids+=("$reader")
until_true status_says '^health +ok'

echo "the reader closes the pipe: mfard ends with exit code 74"
exec 3>&-
kill -KILL "$reader"
ends_with 74 10000
says err 'pipe: the reading program has closed the pipe'
says summary.json '"display": [1-9]'

echo "the replay of a recording waits for the reader; SIGTERM ends it"
exec 3<>pipe
start --recording run --display y4m:pipe --control control 3>&-
until_true status_says 'waiting for the reader of the pipe'
kill -TERM "$pid"
ends_with 0 1500

echo "the reader of the summary accepts no data: SIGTERM ends mfard, which reports the missing output"
mkfifo full
exec 3<>full
head -c 65000 /dev/zero >&3
start --source synthetic:flat,rest --display none --summary full 3>&-
until_true started
kill -TERM "$pid"
ends_with 0 3500
says err 'warning: shutdown after SIGTERM took longer than 2.5 s; ended without waiting'
