#!/usr/bin/env bash
# Texts that are printed from tables must agree with the tables. The programs that read these texts
# must accept them. Usage: check.sh MFAR-TEXTS SOURCE-FOLDER. To write the texts again: cmake
# --build .build/host --target texts
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

"$texts" "$work/tree"
while IFS= read -r file; do
    diff -u "$sources/$file" "$work/tree/$file" ||
        fault "$file differs from what mfar-texts prints; run: cmake --build .build/host --target texts"
done < <(cd "$work/tree" && find . -type f -printf '%P\n')

# The example in docs/flow-method.md must equal the source that is compiled.
diff -u <(sed -n '/^```cpp$/,/^```$/{//!p}' "$sources/docs/flow-method.md") \
    "$sources/tests/measure/eval/shift_flow.cpp" ||
        fault "the example in docs/flow-method.md differs from tests/measure/eval/shift_flow.cpp"

while IFS=: read -r page link; do
    target=${link#*](}
    target=${target%)}
    [[ -e $(dirname "$page")/${target%%#*} ]] ||
        fault "$page links to $target, which does not exist"
done < <(grep -Eo '\]\([^):]+\)' "$sources"/*.md "$sources"/docs/*.md)

# Messages with a remedy in the README must be messages of the programs. "..." stands for varying
# text.
find "$sources/hal" "$sources/daemon" -name '*.cpp' -exec cat {} + |
    perl -0pe 's/(?<!\\)"\s*\n\s*"//g; s/\\"/"/g' >"$work/messages"
while IFS= read -r message; do
    while IFS= read -r words; do
        [[ -z ${words//[ ;:\'()]/} ]] || grep -qF -- "$words" "$work/messages" ||
            fault "README.md: no program says \"$words\""
    done <<<"${message//.../$'\n'}"
done < <(sed -n '/^## Troubleshooting/,/^## /p' "$sources/README.md" | sed -n 's/^| \(`.*`\) | .*/\1/p' |
    grep -Eo '`[^`]+`' | tr -d '`')

# The documents explain the messages and requests without the sources, which the package lacks.
ids=$(grep -Eo '[0-9a-f]{32}' "$sources/daemon/message_ids.h")
for id in $ids; do
    grep -q "^| .$id. | " "$sources/docs/boards.md" ||
        fault "docs/boards.md does not explain the message id $id of daemon/message_ids.h"
done
commands=$(sed -n '/kCommands{/,/;/p' "$sources/daemon/control.cpp" | grep -Eo '"[a-z]+"' | tr -d '"')
for command in $commands; do
    grep -q "^| .{\"command\": \"$command\"" "$sources/docs/boards.md" ||
        fault "docs/boards.md does not explain the request \"$command\" to the control socket"
done

"$sources/run" help >"$work/help"
grep -q '^Debian packages' "$work/help" || fault "./run help lists no packages"
while IFS= read -r package; do
    fault "./run help lists the package $package twice"
done < <(sed '1,/^Debian packages/d' "$work/help" | awk '{ print $1 }' | sort | uniq -d)

# completes EXPECTED PROGRAM WORD...: bash must complete the last word to EXPECTED.
completes() {
    local expected=$1 program=$2 got
    shift
    # shellcheck source=/dev/null
    got=$(. "$work/tree/systemd/$program.bash-completion" && COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) &&
        "_$program" "$program" "${!#}" "${*: -2:1}" && printf '%s ' "${COMPREPLY[@]}")
    [[ $got == "$expected " ]] || fault "bash completes \"$*\" to: $got"
}
completes blend mfard --mode b
completes --print-config mfard --print
completes "$work/tree/docs" mfard --config "$work/tree/do"
completes 'status stats' mfarctl sta
completes 'snapshot' mfarctl --socket /run/status sn
completes "$work/tree/docs" mfarctl --socket "$work/tree/do"
completes --screen mfarctl snapshot --s
completes "$work/tree/docs" mfarctl snapshot "$work/tree/do"
completes --stop mfarctl record --s
completes --stop mfarctl record learn --s
completes reset mfarctl learn r

while IFS= read -r program; do
    [[ -s $work/tree/docs/man/$program.1 ]] || fault "$program has no manual page"
    grep -q "[( ]$program[ )]" "$sources/systemd/CMakeLists.txt" ||
        fault "the package does not install the manual page $program.1"
done < <(sed -n 's/^install(TARGETS \(.*\) RUNTIME DESTINATION bin)/\1/p' "$sources"/daemon/CMakeLists.txt \
    "$sources"/daemon/tools/CMakeLists.txt | tr ' ' '\n')

if command -v groff >/dev/null; then
    for page in "$work"/tree/docs/man/*; do
        said=$(groff -man -Tascii -wall "$page" 2>&1 >"$work/page") || fault "groff fails: $said"
        [[ -z $said ]] || fault "groff warns about $page: $said"
        [[ -s $work/page ]] || fault "groff prints nothing for $page"
    done
fi

[[ $failures == 0 ]]
