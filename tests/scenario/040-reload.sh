#!/bin/bash
# On SIGHUP, mfard must read its configuration again. It must refuse an invalid configuration and
# keep the old one.
. "$(dirname "$0")/lib.sh"

lines() { [ "$(grep -Ec "$1" err)" -ge "$2" ]; }

echo 'source = "synthetic:flat,rest"' >mfard.toml
start --config mfard.toml --summary summary.json
until_true started

printf '[superres]\nmode = "best"\n' >>mfard.toml
kill -HUP "$pid"
until_true lines 'the old configuration stays' 1
says err 'mfard.toml:3:8: superres.mode'

sed -i 's/best/off/; s/rest"/pan"/' mfard.toml
kill -HUP "$pid"
until_true lines 'mfard.toml: read again; these settings change only after a restart: source$' 1

echo "a number that no double can represent is refused with its line and column"
cp mfard.toml good.toml
printf '[trigger]\nmin_interval_s = 9007199254740993\n' >>mfard.toml
kill -HUP "$pid"
until_true lines 'mfard.toml:5:18: trigger.min_interval_s must be from' 1

rm mfard.toml
kill -HUP "$pid"
until_true lines 'mfard.toml: cannot be read' 1

echo "mfard refuses a pipe as the configuration file and does not wait for it"
mkfifo mfard.toml
kill -HUP "$pid"
until_true lines 'mfard.toml: cannot be read: it is not a regular file' 1
rm mfard.toml
cp good.toml mfard.toml
kill -HUP "$pid"
until_true lines 'mfard.toml: read again' 2

kill -TERM "$pid"
ends_with 0 1500
summary_has mode '"off"'

echo "without --config, SIGHUP reads nothing and mfard says so"
start --source synthetic:flat
until_true started
kill -HUP "$pid"
until_true lines 'started without --config' 1
kill -TERM "$pid"
ends_with 0 1500
