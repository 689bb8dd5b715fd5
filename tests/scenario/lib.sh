# Common functions of the scenarios. Usage of a scenario: NNN-name.sh MFARD MFAR-SIM LIBRARY, with
# the paths of two programs and of the library built from tests/device/pretended_v4l2.cpp. A
# scenario with other arguments names them in its header. Each scenario works in its own folder.
# MFAR_PATIENCE (default 1) multiplies all time limits, for sanitizers and slow machines.

set -eu -o pipefail

mfard=$1
sim=$2
patience=${MFAR_PATIENCE:-1}
work=$(mktemp -d)
cd "$work"
pids=()

# ThreadSanitizer does not see how threads of TBB, which runs OpenCV's loops, wait for each other.
# On a single CPU, TBB uses only one thread. Races of mfard's own threads are found on a single CPU,
# too, because ThreadSanitizer checks their locking.
if [ -n "${MFAR_ONE_CPU:-}" ]; then
    first=$(sed -n 's/^Cpus_allowed_list:[[:space:]]*\([0-9]*\).*/\1/p' /proc/self/status)
    taskset -pc "$first" $$ >/dev/null
fi

clean_up() {
    for pid in "${pids[@]}"; do kill -KILL "$pid" 2>/dev/null || true; done
    rm -rf "$work"
}
trap clean_up EXIT

fail() {
    echo "FAILED: $*" >&2
    for file in err summary.json; do
        if [ -f "$file" ]; then echo "--- $file" >&2 && tail -n 40 "$file" >&2; fi
    done
    exit 1
}

milliseconds() {
    local now=${EPOCHREALTIME/[.,]/}
    echo $((now / 1000))
}

# run EXIT-CODE ARGUMENT...: runs mfard, which must end with this code. Its messages go to `err`.
run() {
    local expected=$1 code=0
    shift
    timeout -s KILL $((60 * patience)) "$mfard" "$@" >out 2>err || code=$?
    [ "$code" = "$expected" ] || fail "mfard $* ended with exit code $code instead of $expected"
}

# start ARGUMENT...: starts mfard in the background. Sets $pid to its process id.
start() {
    # Empties the file before the start, because it may contain messages of the previous process.
    : >err
    "$mfard" "$@" >out 2>err &
    pid=$!
    pids+=("$pid")
}

until_true() {
    local end=$(($(milliseconds) + 30000 * patience))
    until "$@"; do
        [ "$(milliseconds)" -lt "$end" ] || fail "this condition did not become true in time: $*"
        sleep 0.05
    done
}

# True after mfard has printed its start line, which names the display. Cameras may still be
# missing.
started() { grep -q 'display ' err; }

# If Mesa's zink draws, Vulkan's validation layer writes its messages to standard output. Fails if
# there are any.
no_complaint() {
    if [ -f out ] && grep -aE 'Validation (Error|Warning|Performance)' out >&2; then
        fail "Vulkan's validation layer reports errors"
    fi
}

# ends_with EXIT-CODE LIMIT-MS: mfard in the background must end with this code within this time.
ends_with() {
    local begin code=0 took hangs=$((30 * patience))
    begin=$(milliseconds)
    # Polls the process table instead of waiting for the process. So a process that hangs makes this
    # check fail instead of blocking it.
    while kill -0 "$pid" 2>/dev/null && [ $(($(milliseconds) - begin)) -lt $((1000 * hangs)) ]; do
        sleep 0.02
    done
    took=$(($(milliseconds) - begin))
    kill -0 "$pid" 2>/dev/null && fail "mfard did not end within $hangs s"
    wait "$pid" || code=$?
    echo "mfard ended with exit code $code after $took ms"
    [ "$code" = "$1" ] || fail "mfard ended with exit code $code instead of $1"
    no_complaint
    [ "$took" -le $(($2 * patience)) ] ||
        fail "mfard took $took ms to end; the limit is $2 ms times MFAR_PATIENCE ($patience)"
}

# two_cameras [TOML]: writes a configuration of two V4L2 cameras, with the given lines.
two_cameras() {
    cat >mfard.toml <<END
source = "cameras"
[superres]
mode = "off"
[pose]
source = "none"
[cameras.video]
driver = "v4l2"
camera = "/dev/video90"
width = 64
height = 48
[cameras.still]
driver = "v4l2"
camera = "/dev/video91"
width = 128
height = 96
rate_hz = 5.0
${1:-}
END
}

# pretended_cameras [TOML]: like two_cameras, with simulated cameras. The files cameras/video90 and
# cameras/video91 select their faults.
pretended_cameras() {
    mkdir cameras
    touch cameras/video90 cameras/video91
    two_cameras "$@"
}

says() { grep -Eq -- "$2" "$1" || fail "$1 has no line that matches: $2"; }

summary_has() { says summary.json "\"$1\": $2,?\$"; }

record() {
    local dir=$1 frames=$2
    shift 2
    run 0 --pace consumer --frames "$frames" --record "$dir" "$@"
}
