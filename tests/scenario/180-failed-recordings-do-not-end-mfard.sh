#!/usr/bin/env bash
# Every start must record into a new folder. If mfard cannot write a recording, the recording must
# end and mfard must continue.
. "$(dirname "$0")/lib.sh"

ctl="$(dirname "$sim")/mfarctl"
status() { "$ctl" --socket control status; }
frames() { status | sed -n 's/^frames  *//p'; }
goes_on() {
    local shown
    shown=$(frames)
    more() { [ "$(frames)" -gt $((shown + 5)) ]; }
    until_true more
}
# No stills are taken: a still would reach the size limit before the recording has a complete frame.
quiet='source = "synthetic:flat,rest"
[superres]
mode = "off"
[trigger]
mode = "off"
[record]
directory = "films"'
stop_it() {
    kill -TERM "$pid"
    ends_with 0 3000
}

echo "two starts record into two folders"
echo "$quiet" >mfard.toml
run 0 --config mfard.toml --check-config
for count in 1 2; do
    start --config mfard.toml --control control
    until_true started
    listed() { [ "$(cat films/*/cam0/data.csv 2>/dev/null | wc -l)" -gt $((4 * count)) ]; }
    until_true listed
    named() { status | grep -Eq '^recording +films/[0-9]{8}-[0-9]{6}(-[0-9]+)?$'; }
    until_true named
    stop_it
    [ "$(find films -mindepth 1 -maxdepth 1 | wc -l)" = "$count" ] ||
        fail "there are not $count folders of recordings"
done

echo "a recording that becomes too large ends; mfard continues"
rm -rf films
printf '%s\nmost_mb = 0.05\n' "$quiet" >mfard.toml
start --config mfard.toml --control control
until_true started
ended() { grep -q 'the recording has ended: films/.*: the recording has become larger than' err; }
until_true ended
says <(status) '^recording +none$'
goes_on
"$ctl" --socket control record more
listed() { [ "$(cat more/cam0/data.csv 2>/dev/null | wc -l)" -gt 1 ]; }
until_true listed
stop_it
run 0 --recording films/* --frames 1
run 0 --recording more --frames 1

echo "mfard continues if the disk is full or the folder of recordings cannot be made"
printf '%s\nleast_free_mb = 1e9\n' "$quiet" >mfard.toml
start --config mfard.toml --control control
ended() { grep -q 'the recording has ended: films/.*MB are free on the disk' err; }
until_true ended
goes_on
stop_it
run 74 --config mfard.toml --record films/new --frames 60 --pace consumer
says err 'MB are free on the disk'
echo "${quiet/films//dev/null/films}" >mfard.toml
start --config mfard.toml --control control
refused() { grep -q 'nothing is recorded: .*/dev/null/films' err; }
until_true refused
until_true started
goes_on
stop_it

echo "a lost recording of --record is a failure, also after a signal"
printf '%s\nmost_mb = 0.05\n' "$quiet" >mfard.toml
ended() { grep -q 'the recording has ended: .*: the recording has become larger than' err; }
# The screen card9 does not exist, so pictures cannot be shown.
for display in none kms:card9; do
    start --config mfard.toml --record lost --display "$display" --summary summary.json
    until_true ended
    kill -TERM "$pid"
    ends_with 74 3000
    says summary.json '"exit_code": 74'
    rm -rf lost
done
