#!/usr/bin/env bash
# Installs, upgrades, removes and purges the Debian package in a minimal Debian. Takes about two
# minutes. Needs root, mmdebstrap and a package mirror. Usage: check.sh PACKAGE
set -euo pipefail
deb=$(readlink -f "$1")
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
# shellcheck source=toolchains/debian.sh
. "$here/../../toolchains/debian.sh"

work=$(mktemp -d)
chmod 755 "$work" # apt reads packages as a user of its own
root=$work/root
trap 'rm -rf "$work"' EXIT
failures=0

step() { printf '%s\n' "$*"; }

# holds DESCRIPTION COMMAND...: reports a fault with the description if the command fails.
holds() {
    local what=$1
    shift
    if ! "$@" >"$work/said" 2>&1; then
        printf 'FAILED: %s\n' "$what"
        tail -n 5 "$work/said"
        failures=$((failures + 1))
    fi
}

inside() {
    chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive \
        ${http_proxy:+"http_proxy=$http_proxy"} ${https_proxy:+"https_proxy=$https_proxy"} "$@"
}
isNot() { ! "$@"; }

apt() {
    inside apt-get --yes --no-install-recommends -o Dpkg::Options::=--force-confold "$@" \
        >"$work/apt" 2>&1 || { cat "$work/apt"; die "apt-get $* failed"; }
    holds "apt-get $1 prints no warning or error" isNot grep -iE 'warning|error|fail' "$work/apt"
}

makeSuccessor() {
    dpkg-deb -R "$deb" "$work/next"
    sed -i 's/^Version: .*/&+next/' "$work/next/DEBIAN/control"
    echo '# of the next version' >>"$work/next/etc/mfar/mfard.toml"
    (cd "$work/next" && find . -path ./DEBIAN -prune -o -type f -printf '%P\0' |
        xargs -0 md5sum >DEBIAN/md5sums)
    dpkg-deb --root-owner-group -b "$work/next" "$root/next.deb" >/dev/null
}

field() { dpkg-deb --field "$deb" "$1" | tr ',' '\n' | awk '{ print $1 }'; }

# draws EXIT-CODE: runs mfard for one picture and expects this exit code.
draws() {
    local code=0
    inside mfard --source synthetic:flat --display none --frames 1 || code=$?
    [[ $code == "$1" ]]
}
withoutGl() { draws 69 && grep -q 'libEGL.so.1 cannot be loaded: .*install libegl1' "$work/said"; }

enabled=$root/etc/systemd/system/multi-user.target.wants/mfard.service
inGroup() { grep -Eq "^$1:.*[:,]mfar(,|$)" "$root/etc/group"; }

step "A bare Debian"
mapfile -t sources < <(debianSources)
mmdebstrap --quiet --mode=root --variant=minbase "$(debianSuite)" "$root" "${sources[@]}"
cp "$deb" "$root/mfar.deb"
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
makeSuccessor

step "Install"
apt update
apt install /mfar.deb
holds "mfard starts, so all libraries are installed" inside mfard --version
holds "the default configuration is accepted" \
    inside mfard --check-config --config /etc/mfar/mfard.toml
holds "the user mfar exists" grep -q '^mfar:' "$root/etc/passwd"
for group in video render gpio; do
    holds "the user mfar is in the group $group" inGroup "$group"
done
holds "the service is enabled" test -L "$enabled"
holds "systemd accepts the unit" inside systemd-analyze verify --man=no mfard.service
holds "the licence is installed" test -s "$root/usr/share/doc/mfar/copyright"
links=0
while IFS=: read -r page link; do
    holds "${page#"$root"} links to $link" test -s "$(dirname "$page")/${link%%#*}"
    links=$((links + 1))
done < <(grep -roP --include='*.md' '\]\(\K(?!https?:|#)[^)]+' "$root/usr/share/doc/mfar")
holds "the documents have links" test "$links" -gt 0
for page in man1/mfard.1 man1/mfarctl.1 man1/mfar-sim.1 man1/mfar-calibrate.1 man1/mfar-print.1 man5/mfard.toml.5; do
    holds "the manual page $page is installed" test -s "$root/usr/share/man/$page"
done
for program in mfard mfarctl; do
    holds "the bash completion of $program is installed" \
        test -s "$root/usr/share/bash-completion/completions/$program"
done
holds "programs are stripped" isNot grep -q debug_info <(readelf -S "$root/usr/bin/mfard")

step "OpenGL ES is recommended, but not a dependency"
for package in libegl1 libgl1-mesa-dri libgles2; do
    holds "$package is recommended" grep -qx "$package" <(field Recommends)
    holds "$package is not a dependency" isNot grep -qx "$package" <(field Depends)
done
holds "EGL is not installed" test -z "$(find "$root/usr/lib" -name 'libEGL.so*')"
holds "without EGL mfard reports what to install" withoutGl
apt install libegl1 libgl1-mesa-dri libgles2
holds "with EGL mfard draws" draws 0

step "Upgrade of a changed configuration and a disabled service"
echo 'seed = 7' >"$root/etc/mfar/mfard.toml"
inside systemctl disable mfard.service 2>/dev/null
apt install /next.deb
holds "the changed configuration stays" grep -qx 'seed = 7' "$root/etc/mfar/mfard.toml"
holds "the new default configuration is beside it" \
    grep -q 'of the next version' "$root/etc/mfar/mfard.toml.dpkg-dist"
holds "the service stays disabled" test ! -L "$enabled"

step "Remove"
inside systemctl enable mfard.service 2>/dev/null
apt remove mfar
holds "the program is removed" test ! -e "$root/usr/bin/mfard"
holds "the unit is removed" test ! -e "$root/usr/lib/systemd/system/mfard.service"
holds "the configuration stays" test -e "$root/etc/mfar/mfard.toml"

step "Purge"
mkdir -p "$root/var/cache/mfar/shaders" "$root/var/lib/mfar/recording"
apt purge mfar
holds "the configuration is removed" test ! -e "$root/etc/mfar"
holds "the cache is removed" test ! -e "$root/var/cache/mfar"
holds "recordings stay" test -d "$root/var/lib/mfar/recording"
holds "the service is no longer enabled" test ! -L "$enabled"
holds "no other file of mfar stays" \
    test -z "$(find "$root"/{etc,usr,lib,var/lib} -name '*mfar*' ! -path '*/var/lib/mfar*' \
        ! -path '*/dpkg/*' 2>/dev/null)"

step "Install again"
apt install /mfar.deb
holds "the service is enabled again" test -L "$enabled"

[[ $failures == 0 ]] && step "All checks of the package passed"
