#!/usr/bin/env bash
# Texts that are printed from tables are as the tables say, and are understood by who reads them.
# Usage: check.sh MFAR-TEXTS SOURCE-FOLDER. To write them anew: cmake --build .build/host --target texts
set -euo pipefail
texts=$1
sources=$2
failures=0

fault() {
    printf 'FAILED: %s\n' "$*"
    failures=$((failures + 1))
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$texts" "$work"
while IFS= read -r file; do
    diff -u "$sources/$file" "$work/$file" || fault "$file differs from the tables"
done < <(cd "$work" && find . -type f -printf '%P\n')

# The example of the page is the one that is compiled.
diff -u <(sed -n '/^```cpp$/,/^```$/{//!p}' "$sources/docs/flow-method.md") \
    "$sources/tests/measure/eval/shift_flow.cpp" || fault "the example of docs/flow-method.md"

# completes PREVIOUS BEGINNING: what bash offers.
completes() {
    # shellcheck source=/dev/null
    (. "$work/systemd/mfard.bash-completion" && COMP_WORDS=(mfard "$1" "$2") COMP_CWORD=2 &&
        _mfard mfard "$2" "$1" && printf '%s ' "${COMPREPLY[@]}")
}
[[ $(completes --mode b) == 'blend ' ]] || fault "completion of --mode b: $(completes --mode b)"
[[ $(completes mfard --print) == '--print-config ' ]] || fault "completion of --print"
[[ $(completes --config "$work/do") == "$work/docs " ]] || fault "completion of a file"

if command -v groff >/dev/null; then
    for page in "$work"/docs/man/*; do
        said=$(groff -man -Tascii -wall "$page" 2>&1 >"$work/page") || fault "groff: $said"
        [[ -z $said ]] || fault "groff: $said"
        [[ -s $work/page ]] || fault "$page is empty"
    done
fi

[[ $failures == 0 ]]
