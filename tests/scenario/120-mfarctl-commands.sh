#!/usr/bin/env bash
# mfarctl must get status, a picture, a still and a recording from a running mfard.
. "$(dirname "$0")/lib.sh"

ctl="$(dirname "$sim")/mfarctl"
# refused EXIT-CODE ARGUMENT...: runs mfarctl, which must end with this code. Its output goes to
# `answer` and err.ctl.
refused() {
    local code=$1 got=0
    shift
    timeout -s KILL $((60 * patience)) "$ctl" --socket control "$@" >answer 2>err.ctl || got=$?
    [ "$got" = "$code" ] ||
        fail "mfarctl $* ended with exit code $got instead of $code: $(cat err.ctl)"
}
asks() { refused 0 "$@"; }

refused 69 status
says err.ctl 'no mfard listens'
refused 64 explode
refused 64 record
refused 64
refused 64 snapshot picture.jpg
says err.ctl 'must end with .png'

printf '[trigger]\nmode = "off"\n[superres]\nmode = "off"\n' >mfard.toml
start --config mfard.toml --source synthetic:flat,rest --display png:frames --control control \
    --summary summary.json
until_true started
asks status
says answer '^state +running$'
says answer '^health +ok for [0-9.]+ s'
says answer '^source +synthetic'
says answer '^fault +none$'
code=0
"$ctl" --socket control status >/dev/full 2>err.ctl || code=$?
[ "$code" = 74 ] || fail "mfarctl ended with exit code $code although its output could not be written"
says err.ctl 'standard output cannot be written'
refused 1 record $'K\xfcche' # not UTF-8
says err.ctl "a recording's name must consist of"
run 69 --source synthetic:flat --control control --frames 1
says err 'another process listens'

echo "mfarctl snapshot writes the shown picture"
shows() { ls frames/*.png >/dev/null 2>&1; }
until_true shows
asks snapshot picture.png
says answer 'picture.png: 2304x1728'
file=$(od -An -tx1 -N8 picture.png | tr -d ' ')
[ "$file" = 89504e470d0a1a0a ] || fail "the snapshot is not a PNG file"
asks snapshot -
file=$(od -An -tx1 -N8 answer | tr -d ' ')
[ "$file" = 89504e470d0a1a0a ] || fail "the snapshot on standard output is not a PNG file"
[ ! -e ./- ] || fail "mfarctl snapshot - wrote a file"
refused 1 snapshot --screen x.png
says err.ctl 'there is no screen'

echo "mfarctl trigger requests a still although nothing else does"
asks stats
says answer '"triggered": 0'
asks trigger
received() { asks stats && grep -q '"received": 1' answer; }
until_true received

echo "mfarctl reload reads the configuration again"
sed -i '/superres/,$s/off/detail/' mfard.toml
asks reload
says answer 'mfard.toml: read again'
asks status
says answer '^mode +detail$'
echo 'nonsense = 1' >mfard.toml
refused 1 reload
says err.ctl 'mfard.toml:1:1'

echo "mfarctl record starts and ends a recording"
refused 1 record ../outside
asks record walk
says answer "^folder +$work/walk$"
refused 1 record again
says err.ctl 'already running'
until_true grep -q png walk/cam0/data.csv
asks record --stop
says answer "^folder +$work/walk$"
says answer '^video +[1-9]'
taken=$(sed -n 's/^video *//p' answer)
[ "$(grep -vc '^#' walk/cam0/data.csv)" -ge "$taken" ] ||
    fail "data.csv of the recording lists fewer pictures than mfarctl reports"
refused 1 record --stop

kill -TERM "$pid"
ends_with 0 3000
[ ! -e control ] || fail "the control socket still exists after the end"
run 0 --recording walk --summary summary.json
