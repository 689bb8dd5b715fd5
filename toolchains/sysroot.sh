#!/usr/bin/env bash
# Prints the path of a sysroot: a folder of extracted Debian packages with the headers and libraries
# of another architecture. If it does not exist, makes it. This needs root rights, about two minutes
# and 1 GB.
# Usage: sysroot.sh CACHE ARCHITECTURE PACKAGE...   (ARCHITECTURE: Debian's name: arm64, armhf)
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
# shellcheck source=toolchains/debian.sh
. "$here/debian.sh"

[[ $# -ge 3 ]] || die "usage: sysroot.sh CACHE ARCHITECTURE PACKAGE..."
cache=$1
architecture=$2
shift 2
mapfile -t packages < <(printf '%s\n' libc6-dev "$@" | sort -u)
hash=$(inputHash "$(debianSuite)" "${packages[@]}" "$(codeOf "$here/sysroot.sh" "$here/debian.sh")")
sysroot=$cache/sysroot-$architecture-$hash

if [[ ! -d $sysroot ]]; then
    printf 'Making the sysroot %s; takes about two minutes\n' "$sysroot" >&2
    rm -rf "$sysroot.part"
    mkdir -p "$cache"
    extractPackages "$architecture" "$sysroot.part" "${packages[@]}"
    linkAlternatives "$sysroot.part"
    makeLinksRelative "$sysroot.part"
    chmod -R a+rX "$sysroot.part"
    mv "$sysroot.part" "$sysroot"
fi
touch "$sysroot"
# Removes sysroots that were not used for two weeks. Their inputs (see `hash`) were different.
find "$cache" -maxdepth 1 -name "sysroot-$architecture-*" -mtime +14 -exec rm -rf {} +
echo "$sysroot"
