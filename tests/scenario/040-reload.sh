#!/bin/bash
# SIGHUP reads the configuration again; a bad one is refused and the old one stays.
. "$(dirname "$0")/lib.sh"

ctl="$(dirname "$sim")/mfarctl"
lines() { [ "$(grep -Ec "$1" err)" -ge "$2" ]; }

echo 'source = "synthetic:flat,rest"' >mfard.toml
start --config mfard.toml --control control --summary summary.json
until_true started

printf '[superres]\nmode = "best"\n' >>mfard.toml
kill -HUP "$pid"
until_true lines 'the old configuration stays' 1
says err 'mfard.toml:3:8: superres.mode'

sed -i 's/best/off/; s/rest"/pan"/' mfard.toml
kill -HUP "$pid"
until_true lines 'mfard.toml: read again; after a restart only: source$' 1

echo "a number that no double holds is a fault with its place"
cp mfard.toml good.toml
printf '[trigger]\nmin_interval_s = 9007199254740993\n' >>mfard.toml
kill -HUP "$pid"
until_true lines 'mfard.toml:5:18: trigger.min_interval_s must be from' 1

rm mfard.toml
kill -HUP "$pid"
until_true lines 'mfard.toml: cannot be read' 1

echo "pictures go on while the file does not come, and so does the way out"
mkfifo mfard.toml
kill -HUP "$pid"
sleep 0.3
frames() { "$ctl" --socket control status | sed -n 's/^frames  *//p'; }
shown=$(frames)
sleep 1
[ "$(frames)" -gt "$shown" ] || fail "no pictures during a reload"
timeout 1 cat good.toml >mfard.toml || fail "nobody reads the configuration"
until_true lines 'mfard.toml: read again' 2
kill -HUP "$pid"
sleep 0.3

kill -TERM "$pid"
ends_with 0 1500
summary_has mode '"off"'

echo "without a file there is nothing to read again"
start --source synthetic:flat
until_true started
kill -HUP "$pid"
until_true lines 'started without --config' 1
kill -TERM "$pid"
ends_with 0 1500
