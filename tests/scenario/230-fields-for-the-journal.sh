#!/usr/bin/env bash
# As a service, mfard must send messages with fields to the journal: kind, camera, count. If there
# is no journal, the messages must go to standard error. Usage:
# 230-fields-for-the-journal.sh MFARD MFAR-SIM JOURNAL.so NOTIFY-LISTENER
ids=$(realpath "$(dirname "$0")/../../daemon/message_ids.h")
. "$(dirname "$0")/lib.sh"

journal=$3
listener=$4
id() { sed -n "s/^constexpr std::string_view $1 = \"\(.*\)\";/\1/p" "$ids"; }

"$listener" socket heard &
pids+=($!)
until_true test -S socket
# heard FIELD FIELD: true if one message in the file `heard` has both fields. Messages end with an
# empty line. A text of several lines is sent with its length (binary) in front of it.
heard() {
    tr '\0' ' ' <heard |
        awk -v RS= -v a="$1" -v b="$2" '$0 ~ a && $0 ~ b {found = 1} END {exit !found}'
}

two_cameras
start_service() {
    : >err
    MFAR_PRETENDED_JOURNAL=$PWD/$1 LD_PRELOAD=$journal JOURNAL_STREAM=$(stat -c %d:%i err) \
        "$mfard" --config mfard.toml --display none >out 2>>err &
    pid=$!
    pids+=("$pid")
}

start_service socket
until_true heard "MESSAGE_ID=$(id kStarted)" 'MESSAGE=engine '
until_true heard "MESSAGE_ID=$(id kDegraded)" 'MFAR_CAMERA=video'
heard 'warning: .*video camera: ' 'MFAR_COUNT=1' ||
    fail "the warning does not name the video camera"
heard 'PRIORITY=4' 'SYSLOG_IDENTIFIER=mfard' ||
    fail "a message has no PRIORITY=4 or no SYSLOG_IDENTIFIER=mfard"
kill -HUP "$pid"
until_true heard "MESSAGE_ID=$(id kReloaded)" 'MESSAGE=mfard.toml: read again'
kill -TERM "$pid"
ends_with 0 1500
[ ! -s err ] || fail "mfard writes messages also to standard error"

echo "without a journal, messages go to standard error"
start_service nowhere
until_true started
says err '^<5>mfard: engine '
kill -TERM "$pid"
ends_with 0 1500
