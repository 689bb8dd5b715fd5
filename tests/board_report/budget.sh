#!/usr/bin/env bash
# Checks for every board whose drivers are in the cache that every shader keeps its budget, and that
# model.toml has trip counts for the loops of a frame's shaders. Exit status 77: python3 or all
# drivers are missing. With "planted": checks that a shader with a large local array is reported on
# each board. Usage: budget.sh COMPILE-SHADERS FRAME-WORK [planted]
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
boards=$here/../../toolchains/boards
cache=${MFAR_CACHE:-${XDG_CACHE_HOME:-${HOME:-/root}/.cache}/mfar}
command -v python3 >/dev/null || { echo "python3 is not installed"; exit 77; }
drivers=()
for suite in bookworm trixie; do
    status=0
    libraries=$("$boards/drivers.sh" --if-built "$cache" "$suite") || status=$?
    case $status in
    0) drivers+=(--drivers "$suite=$libraries") ;;
    77) ;; # this release's drivers are not built
    *) exit 1 ;;
    esac
done
[[ ${#drivers[@]} -gt 0 ]] || { echo "the boards' drivers are not built; ./run board-report builds them"; exit 77; }
check=(python3 -B "$boards/report.py" --compile-shaders "$1" --check "${drivers[@]}")
if [[ ${3:-} != planted ]]; then exec "${check[@]}" --frame-work "$2"; fi

found=$("${check[@]}" --budget "$here/planted.csv" --file "$here/planted.comp") && {
    echo "a shader with a large local array was not reported as over its budget"
    exit 1
}
printf '%s\n' "$found"
compiled=$(sed -n 's/^[0-9]* shaders on \([0-9]*\) GPUs.*/\1/p' <<<"$found")
[[ $(grep -c '^planted.comp on .* scratch, the budget is 0$' <<<"$found") == "$compiled" ]]
