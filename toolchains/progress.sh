# Shows on standard error how far a long command is, as base/progress.h does: on a terminal a line
# that is rewritten, elsewhere a line every ten seconds.

progressLine=$EPOCHSECONDS

# progress DONE ALL WHAT
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

# Erases the line, so that other output can follow.
clearProgress() { if [[ -t 2 ]]; then printf '\r\e[K' >&2; fi; }

# tick SECONDS WHAT: shows the elapsed share of the expected time until it is killed or the shell
# that started it ends. To be run in the background.
tick() {
    local begin=$EPOCHSECONDS spent
    while kill -0 "$$" 2>/dev/null; do
        spent=$((EPOCHSECONDS - begin))
        progress $((spent < $1 ? spent : $1)) "$1" "$2; $spent of about $1 s"
        sleep 1
    done
}
