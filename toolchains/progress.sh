# Shows the progress of a long command on standard error, as base/progress.h does: rewrites one line
# on a terminal; otherwise prints a line every ten seconds.

progressLine=$EPOCHSECONDS

# progress DONE ALL WHAT: shows that DONE of ALL parts are done, and that WHAT is next.
progress() {
    local line
    line=$(printf '%3d %%  %s' $((100 * $1 / ($2 > 0 ? $2 : 1))) "$3")
    if [[ -t 2 ]]; then
        printf '\r\e[K%s' "$line" >&2
    elif ((EPOCHSECONDS >= progressLine + 10)); then
        progressLine=$EPOCHSECONDS
        printf '%s\n' "$line" >&2
    fi
}

clearProgress() { if [[ -t 2 ]]; then printf '\r\e[K' >&2; fi; }

# tick SECONDS WHAT: shows the share of the expected time that has passed. Runs in the background
# until it is killed or until the shell that started it ends.
tick() {
    local begin=$EPOCHSECONDS spent
    while kill -0 "$$" 2>/dev/null; do
        spent=$((EPOCHSECONDS - begin))
        progress $((spent < $1 ? spent : $1)) "$1" "$2; $spent of about $1 s"
        sleep 1
    done
}
