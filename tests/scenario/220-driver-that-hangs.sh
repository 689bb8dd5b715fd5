#!/usr/bin/env bash
# A call to a driver never returns. mfard must stop notifying the watchdog. Status, log and service
# manager must get the name of the hanging thread. While mfard waits for a missing camera, it must
# notify the watchdog. A preloaded library simulates the cameras. A program that writes down the
# messages simulates the service manager. Usage: 220-driver-that-hangs.sh MFARD MFAR-SIM
# PRETENDED.so NOTIFY-LISTENER
. "$(dirname "$0")/lib.sh"

pretended=$3
listener=$4
ctl="$(dirname "$sim")/mfarctl"

"$listener" notify heard &
pids+=($!)
until_true test -S notify
export NOTIFY_SOCKET=$PWD/notify WATCHDOG_USEC=10000000 MFAR_PRETENDED_V4L2=$work/cameras
heard() { grep -Eq -- "$1" heard; }
notifications() { grep -c '^WATCHDOG=1$' heard || true; }
notified() { [ "$(notifications)" -gt $((before + $1)) ]; }
status() { timeout $((10 * patience)) "$ctl" --socket control status; }
status_says() { status | grep -Eq -- "$1"; }
is_notified() {
    before=$(notifications)
    until_true notified 2
}
# Fails if mfard notifies the watchdog within four seconds. Usually mfard notifies it every second.
is_not_notified() {
    before=$(notifications)
    sleep 4
    notified 0 && fail "mfard still notifies the watchdog although $1"
    true
}

pretended_cameras
start_hangable() {
    LD_PRELOAD=$pretended start --config mfard.toml --display none --control control
    until_true started
    until_true status_says '^health +ok'
    frames() { [ "$(status | sed -n 's/^frames  *//p')" -gt 12 ]; }
    until_true frames
}

echo "the video driver hangs: status and messages name the thread; mfard stops notifying the watchdog"
start_hangable
is_notified
echo hang >cameras/video90
until_true status_says '^health +stalled for .*: the .*capture thread hangs'
until_true heard '^STATUS=the .*capture thread hangs \(stalled for [0-9.]+ s, last picture [0-9.]+ s ago\)'
says err 'warning: the .*capture thread hangs \(stalled for'
is_not_notified "the driver hangs"

echo "the driver's call returns after all: mfard notifies the watchdog again"
: >cameras/video90
until_true status_says '^health +ok'
is_notified

echo "SIGTERM ends mfard while the driver hangs"
echo hang >cameras/video90
until_true status_says '^health +stalled'
kill -TERM "$pid"
ends_with 0 1500
: >cameras/video90

echo "SIGTERM ends mfard while the drivers hang at opening the devices"
echo hang-open >cameras/video90
echo hang-open >cameras/video91
LD_PRELOAD=$pretended start --config mfard.toml --display none
until_true started
kill -TERM "$pid"
ends_with 0 1500
: >cameras/video90
: >cameras/video91

echo "runs with a limit of seconds or of frames end in time although a driver hangs"
LD_PRELOAD=$pretended start --config mfard.toml --display none --seconds 2 --summary summary.json
until_true started
echo hang >cameras/video90
ends_with 0 6000
summary_has exit_reason '"--seconds"'
: >cameras/video90
LD_PRELOAD=$pretended start --config mfard.toml --display none --frames 40 --summary summary.json
until_true started
echo hang >cameras/video91
ends_with 0 6000
summary_has frames 40
: >cameras/video91

echo "a run that fails while the driver hangs keeps its exit code"
mkfifo pipe
mkdir state
echo hang >cameras/video91
LD_PRELOAD=$pretended STATE_DIRECTORY=$PWD/state start --config mfard.toml --display y4m:pipe \
    --summary summary.json
timeout $((30 * patience)) head -c 5000 <pipe >/dev/null ||
    fail "mfard writes no picture into the display pipe"
ends_with 74 6000
: >cameras/video91
says summary.json '"exit_code": 74'

echo "mfard notifies the watchdog while it waits for an absent camera"
sed -i 's/video90/video92/' mfard.toml
LD_PRELOAD=$pretended start --config mfard.toml --display none --control control
until_true started
until_true status_says '^health +degraded for .*: video camera: '
is_notified
kill -TERM "$pid"
ends_with 0 1500
