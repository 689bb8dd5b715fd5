#!/usr/bin/env bash
# Recordings, state and a log file are on a small file system that becomes full. mfard must start,
# continue, and report what it could not write. Everything that it wrote must be readable.
# Usage: 270-full-var.sh MFARD MFAR-SIM PRETENDED.so. Exit status 77: no file system can be mounted.
if [ -z "${MFAR_MOUNTS:-}" ]; then
    for how in "--mount" "--mount --map-root-user"; do
        # shellcheck disable=SC2086 # $how is a list of options
        if unshare $how mount -t tmpfs none /mnt 2>/dev/null; then
            MFAR_MOUNTS=1 exec unshare $how "$0" "$@"
        fi
    done
    echo "no file system can be mounted on this machine"
    exit 77
fi
. "$(dirname "$0")/lib.sh"

pretended=$3
ctl="$(dirname "$sim")/mfarctl"
status() { timeout $((10 * patience)) "$ctl" --socket control status; }
frames() { status | sed -n 's/^frames  *//p'; }
goes_on() {
    shown=$(frames)
    more() { [ "$(frames)" -gt $((shown + 15)) ] 2>/dev/null; }
    until_true more
    says <(status) '^health +ok'
}
trap 'umount --lazy "$work/var"; clean_up' EXIT
mkdir var
mount -t tmpfs -o size=6m none var
# mfard runs in the folder var, as the service runs in /var/lib/mfar. The file with mfard's messages
# is in another folder.
printf '#!/bin/sh\ncd "%s/var" && exec "%s" "$@"\n' "$work" "$mfard" >mfard
chmod +x mfard
mfard=$work/mfard
fill() { dd if=/dev/zero of=var/fill bs=4k 2>/dev/null || true; }
is_full() {
    local took=0
    echo more 2>/dev/null >var/probe || took=1
    rm -f var/probe
    [ $took = 1 ]
}
mkdir var/state
export STATE_DIRECTORY=$PWD/var/state
pretended_cameras '[record]
directory = "films"
least_free_mb = 0'
begin() {
    LD_PRELOAD=$pretended MFAR_PRETENDED_V4L2=$PWD/cameras start --config "$work/mfard.toml" \
        --display none --control "$work/control"
    until_true started
}

echo "the disk becomes full during a recording: the recording ends"
begin
# Waits until mfard has begun a recording, and sets "film" to its folder.
find_film() {
    has_film() { film=$(ls -d var/films/* 2>/dev/null); }
    until_true has_film
}
find_film
listed() { [ "$(grep -c '^[0-9]' "$film/cam0/data.csv" 2>/dev/null)" -gt 3 ]; }
until_true listed
fill
no_room='(the disk is full|No space left)'
ended() { grep -Eq "the recording has ended: .*${film#var/}.*$no_room" err; }
until_true ended
is_full || fail "the disk is not full"
goes_on
says <(status) '^recording +none$'

echo "a new recording is refused or ends"
"$ctl" --socket control record more 2>refused || says refused "$no_room"
goes_on
kill -TERM "$pid"
ends_with 0 1500
run 0 --recording "${film#var/}" --frames 1
says err 'first picture'

echo "the disk is full from the start: nothing is recorded"
fill
begin
refused() { grep -Eq "(nothing is recorded|the recording has ended): .*$no_room" err; }
until_true refused
goes_on
kill -TERM "$pid"
ends_with 0 1500

echo "the disk has space again: mfard records"
rm -rf var/fill var/films
begin
find_film
until_true listed
goes_on
kill -TERM "$pid"
ends_with 0 1500

echo "filters that cannot be stored are reported"
rm -rf var/films
printf '[engine]\nuse = "simd"\n[trigger]\nmode = "rate"\nrate_hz = 10.0\nmin_interval_s = 0.0\n' >learn.toml
fill
run 0 --config "$work/learn.toml" --source synthetic:office --pace consumer --frames 6 --display none
says err 'warning: .*filters-.*: No space left.*; learned filters cannot be written'
[ -z "$(ls var/state)" ] || fail "a part of a file is left in var/state"

echo "mfard continues if its log file cannot grow"
is_full || fail "the disk is not full"
sed -i '/^\[record\]/,$d' mfard.toml
LD_PRELOAD=$pretended MFAR_PRETENDED_V4L2=$PWD/cameras "$mfard" --config "$work/mfard.toml" \
    --display none --control "$work/control" 2>var/log >/dev/null &
pid=$!
pids+=("$pid")
answers() { status >answer 2>&1; }
until_true answers
goes_on
kill -TERM "$pid"
ends_with 0 1500
