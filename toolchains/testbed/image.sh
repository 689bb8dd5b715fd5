#!/usr/bin/env bash
# Makes the disk of the test bed, unless it is there: a Debian for arm64 that boots under QEMU, with
# what a package to be tested depends on. Prints the folder of root.img, vmlinuz and initrd. Needs
# root; about 80 s and 1 GB. Nothing in the disk has been executed.
# Usage: image.sh CACHE PACKAGE...   (what the package to be tested depends on)
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
# shellcheck source=toolchains/debian.sh
. "$here/../debian.sh"

# The guest without mfar: enough for systemd, dpkg and scripts, and the tools to look at devices.
guestPackages() {
    cat <<'LIST'
base-files base-passwd bash busybox-static coreutils dash debianutils diffutils dpkg findutils grep
gzip init-system-helpers kmod libc-bin linux-image-arm64 mawk mount perl-base procps sed
systemd-sysv tar udev util-linux
gpiod libcamera-ipa libcamera-tools libdrm-tests v4l-utils
LIST
}

# Users and groups, made by scripts otherwise, and what systemd expects of a disk.
completeRoot() {
    local root=$1
    cp "$root/usr/share/base-passwd/passwd.master" "$root/etc/passwd"
    cp "$root/usr/share/base-passwd/group.master" "$root/etc/group"
    printf '%s\n' input:x:104: sgx:x:105: kvm:x:106: render:x:107: >>"$root/etc/group"
    sed 's/^\([^:]*\):.*/\1:*:19000:0:99999:7:::/' "$root/etc/passwd" >"$root/etc/shadow"
    mkdir -p "$root"/{proc,sys,run,root,share,tmp}
    chmod 1777 "$root/tmp"
    ln -sf mawk "$root/usr/bin/awk"
    echo mfar-bed >"$root/etc/hostname"
    # A fixed identity, or each start would be a first one, on which all services are enabled.
    echo 6d6661722d6265642d74657374626564 >"$root/etc/machine-id"
    cat >"$root/etc/fstab" <<'TAB'
/dev/vda / ext4 rw,noatime 0 0
share /share 9p trans=virtio,version=9p2000.L,msize=262144,nofail 0 0
TAB
    printf '%s\n' virtio_console 9pnet_virtio 9p >"$root/etc/modules-load.d/bed.conf"
}

# A root shell on a virtio port: the host writes commands and reads what they say.
addShell() {
    local units=$1/etc/systemd/system unit
    mkdir -p "$units/multi-user.target.wants"
    cat >"$units/bed-shell.service" <<'UNIT'
[Unit]
After=basic.target systemd-udev-settle.service
Wants=systemd-udev-settle.service
[Service]
ExecStart=/bin/bash -c 'until [[ -c /dev/virtio-ports/bed ]]; do sleep 0.1; done; exec bash <>/dev/virtio-ports/bed >&0 2>&1'
WorkingDirectory=/root
KillMode=process
UNIT
    ln -s ../bed-shell.service "$units/multi-user.target.wants/"
    # What nothing here needs: a fourth of the time of the start.
    for unit in getty@tty1.service getty-static.service serial-getty@ttyAMA0.service \
        systemd-update-utmp.service systemd-journal-flush.service systemd-random-seed.service \
        dev-hugepages.mount dev-mqueue.mount sys-kernel-debug.mount sys-kernel-tracing.mount \
        modprobe@configfs.service modprobe@dm_mod.service modprobe@fuse.service \
        modprobe@loop.service; do
        ln -s /dev/null "$units/$unit"
    done
}

# Prints the files of a kernel module and of all it needs, in the order of loading.
moduleFiles() {
    local modules=$1 entry
    entry=$(grep -m 1 "/$2\.ko" "$modules/modules.dep") || die "no kernel module $2"
    # modules.dep names the last to be loaded first.
    tr ' ' '\n' <<<"${entry/:/}" | tac
}

# Loads the modules for the disk and goes on to systemd; quicker to make than Debian's, and it needs
# none of the guest's programs.
makeInitrd() {
    local root=$1 kernel=$2 out=$3 tree module file
    tree=$(mktemp -d)
    mkdir -p "$tree"/{bin,dev,lib,root}
    cp "$root/usr/bin/busybox" "$tree/bin/"
    for module in virtio_pci virtio_blk crc32c_generic ext4; do
        moduleFiles "$root/lib/modules/$kernel" "$module"
    done | awk '!seen[$0]++' | while read -r file; do
        cp "$root/lib/modules/$kernel/$file" "$tree/lib/"
        echo "/lib/${file##*/}" >>"$tree/modules"
    done
    cat >"$tree/init" <<'INIT'
#!/bin/busybox sh
busybox=/bin/busybox
$busybox mount -t devtmpfs none /dev
while read -r module; do $busybox insmod "$module"; done </modules
until [ -b /dev/vda ]; do $busybox sleep 0.05; done
$busybox mount -t ext4 -o noatime /dev/vda /root || $busybox poweroff -f
$busybox mount -o move /dev /root/dev
exec $busybox switch_root /root /sbin/init
INIT
    chmod +x "$tree/init"
    (cd "$tree" && find . | cpio --quiet -o -H newc) | gzip -1 >"$out"
    rm -rf "$tree"
}

makeImage() {
    local part=$1 root=$1/root kernel
    shift
    mkdir -p "$part"
    # shellcheck disable=SC2046 # a list of words
    extractPackages arm64 "$root" $(guestPackages) "$@"
    linkAlternatives "$root"
    completeRoot "$root"
    addShell "$root"
    kernel=$(basename "$root"/lib/modules/*)
    depmod -b "$root" "$kernel"
    cp "$root/boot/vmlinuz-$kernel" "$part/vmlinuz"
    makeInitrd "$root" "$kernel" "$part/initrd"
    rm -rf "${root:?}"/boot/*
    truncate -s 2G "$part/root.img"
    mke2fs -q -t ext4 -O ^has_journal -d "$root" "$part/root.img"
    rm -rf "$root"
}

[[ $# -ge 1 ]] || die "usage: image.sh CACHE PACKAGE..."
cache=$1
shift
mapfile -t packages < <(printf '%s\n' "$@" | sort -u)
hash=$(inputHash "$(debianSuite)" "${packages[@]}" "$(cat "$here/image.sh" "$here/../debian.sh")")
image=$cache/testbed-$hash
if [[ ! -d $image ]]; then
    printf 'Making %s, about 80 s\n' "$image" >&2
    rm -rf "$image.part"
    makeImage "$image.part" "${packages[@]}"
    chmod -R a+rX "$image.part"
    mv "$image.part" "$image"
fi
touch "$image"
find "$cache" -maxdepth 1 -name 'testbed-*' -mtime +14 -exec rm -rf {} +
echo "$image"
