#!/usr/bin/env bash
# clang-tidy must find exactly the faults in planted.h and planted.cpp. Usage: check.sh OPTION..., with
# the options that `./run lint` gives to clang-tidy. Prints the difference. Exit status 1: there is a
# difference.
set -euo pipefail
options=("$@")
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."

# Prints each fault as FILE:LINE CHECK. The check's name is at the end of the line.
planted() {
    sed -nE 's|^(.*):([0-9]+):.*// ([a-z]+-[a-z-]+)$|\1:\2 \3|p' < <(grep -n '' tests/lint/planted.*)
}

found() {
    { clang-tidy-19 "${options[@]}" tests/lint/planted.cpp -- -std=c++20 -DNDEBUG -I"$PWD" -Wunused-variable 2>/dev/null || true; } |
        sed -nE "s|^$PWD/([^:]+):([0-9]+):.*\[([a-z-]+).*\]\$|\1:\2 \3|p"
}

diff --label planted --label found <(planted | sort) <(found | sort -u)
