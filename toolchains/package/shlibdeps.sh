#!/usr/bin/env bash
# Prints the Debian packages of the shared libraries that programs need, for the field Depends. Like
# dpkg-shlibdeps, but for the packages of any root: of this machine or of a sysroot.
# Usage: shlibdeps.sh ROOT ARCHITECTURE PROGRAM...   (empty ROOT: this machine)
set -euo pipefail
[[ $# -ge 3 ]] || { echo "usage: shlibdeps.sh ROOT ARCHITECTURE PROGRAM..." >&2; exit 2; }
info=$1/var/lib/dpkg/info
architecture=$2
shift 2

# In shlibs files, "libfoo.so.1" and "libfoo-1.so" are both library libfoo, version 1.
split() { sed -E 's/^(.*)\.so\.(.*)$/\1 \2/; t; s/^(.*)-([0-9][^-]*)\.so$/\1 \2/; t; s/$/ -/'; }

needed=$(readelf -d "$@" | sed -n 's/.*(NEEDED).*\[\(.*\)\]$/\1/p' | sort -u | split)
[[ -n $needed ]] || { echo "shlibdeps: these programs need no shared library: $*" >&2; exit 1; }
while read -r library version; do
    # Files of this architecture are searched first, because a machine may have libraries of several
    # architectures.
    found=$(awk -v l="$library" -v v="$version" \
        '$1 == l && $2 == v { $1 = $2 = ""; sub(/^ +/, ""); print; exit }' "$info"/*":$architecture.shlibs" "$info"/*.shlibs)
    [[ -n $found ]] || { echo "shlibdeps: no package in $info has $library $version" >&2; exit 1; }
    echo "$found"
done <<<"$needed" | sort -u | paste -sd, | sed 's/,/, /g'
