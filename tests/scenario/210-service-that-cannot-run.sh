#!/usr/bin/env bash
# A service lacks something that it needs, and the service manager restarts it at once. mfard must
# log the remedy. After each further failure, it must wait longer before it ends. On a command line
# it must end at once. Usage: 210-service-that-cannot-run.sh MFARD MFAR-SIM NOTIFY-LISTENER
. "$(dirname "$0")/lib.sh"

listener=$3
missing=(--source synthetic:flat --control nowhere/control --frames 1)

run 69 "${missing[@]}"
grep -q 'systemd restarts it' err && fail "mfard announces a restart although no service manager runs it"

"$listener" notify heard &
pids+=($!)
until_true test -S notify
export NOTIFY_SOCKET=$PWD/notify STATE_DIRECTORY=$PWD/state
mkdir state
run 69 "${missing[@]}"
says err 'nowhere/control: No such file or directory'
says err 'mfard: a device or OpenGL ES is not available; if this does not change, .*engine.use'
says err 'mfard failed once; it exits in 0 s, then systemd restarts it'
run 69 "${missing[@]}"
says err 'mfard failed 2 times in a row; it exits in 1 s, then systemd restarts it'
run 69 "${missing[@]}"
says err 'mfard failed 3 times in a row; it exits in 3 s, then systemd restarts it'
says heard '^STATUS=.*nowhere/control: No such file or directory; restart in 3 s'

echo "SIGTERM ends mfard at once while it waits before a restart"
start "${missing[@]}"
waits() { grep -q 'mfard failed 4 times in a row; it exits in 7 s' err; }
until_true waits
kill -TERM "$pid"
ends_with 69 1500

echo "after a usage or configuration error, mfard announces no restart"
run 64 --no-such-option
grep -q 'systemd restarts it' err && fail "mfard announces a restart, which would not help"
echo "nonsense = 1" >bad.toml
run 78 --config bad.toml
grep -q 'systemd restarts it' err && fail "mfard announces a restart, which would not help"
true
