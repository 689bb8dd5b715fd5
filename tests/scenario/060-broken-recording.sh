#!/bin/bash
# A broken recording must give one error that names the file, and the line if the file is a list.
. "$(dirname "$0")/lib.sh"

record run 3 --source synthetic:flat,rest

# broken EXIT-CODE PATTERN: a run of the recording "bad" must end with this code and a matching
# message.
broken() {
    rm -rf shown
    run "$1" --recording bad --display png:shown
    says err "$2"
    [ "$(wc -l <err)" -le 2 ] || fail "mfard wrote more than a start line and one error"
    rm -rf bad
}

run 66 --recording missing
says err 'missing: '

cp -r run bad && tac run/cam0/data.csv >bad/cam0/data.csv
broken 65 'bad/cam0/data\.csv:[0-9]+: '

cp -r run bad && rm bad/cam1/sensor.yaml
broken 65 'bad/cam1/sensor\.yaml'

cp -r run bad && rm "bad/cam0/data/$(tail -n 1 run/cam0/data.csv | cut -d, -f2)"
broken 65 'bad/cam0/data\.csv:4: '

# The header of this picture is valid. Only decoding can find the fault.
cp -r run bad && truncate -s 2000 "bad/cam0/data/$(tail -n 1 run/cam0/data.csv | cut -d, -f2)"
broken 65 'bad/cam0/data/[0-9]+\.png'
