#!/usr/bin/env bash
# Makes the disk of the emulated board, if it does not exist: Debian for arm64 that boots under
# QEMU, with the dependencies of the package to be tested. Prints the folder that contains root.img,
# vmlinuz and initrd. Needs root rights; takes about 80 s and 1 GB. Executes no program of the disk.
# Usage: image.sh CACHE PACKAGE...   (the dependencies of the package to be tested)
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
# shellcheck source=toolchains/debian.sh
. "$here/../debian.sh"

# Prints the packages of the guest (the emulated board) without mfar: enough for systemd, dpkg and
# scripts, and tools for cameras, displays and GPIO lines.
guestPackages() {
    cat <<'LIST'
base-files base-passwd bash busybox-static coreutils dash debianutils diffutils dpkg findutils grep
gzip init-system-helpers kmod libc-bin linux-image-arm64 mawk mount perl-base procps sed
systemd-sysv tar udev util-linux
gpiod libcamera-ipa libcamera-tools libdrm-tests v4l-utils
LIST
}

# completeRoot ROOT: makes the users and groups, which packages' scripts would otherwise make, and
# the files and folders that systemd needs.
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
    # A fixed machine id. Without one, systemd would treat each boot as the first one and enable all
    # services.
    echo 6d6661722d6265642d74657374626564 >"$root/etc/machine-id"
    cat >"$root/etc/fstab" <<'TAB'
/dev/vda / ext4 rw,noatime 0 0
share /share 9p trans=virtio,version=9p2000.L,msize=262144,nofail 0 0
TAB
    printf '%s\n' virtio_console 9pnet_virtio 9p >"$root/etc/modules-load.d/bed.conf"
}

# addShell ROOT: adds a service with a root shell on a virtio port. Through the port, the host
# writes commands and reads their output.
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
    # Disables units that the tests do not need. They take a quarter of the boot time.
    for unit in getty@tty1.service getty-static.service serial-getty@ttyAMA0.service \
        systemd-update-utmp.service systemd-journal-flush.service systemd-random-seed.service \
        dev-hugepages.mount dev-mqueue.mount sys-kernel-debug.mount sys-kernel-tracing.mount \
        modprobe@configfs.service modprobe@dm_mod.service modprobe@fuse.service \
        modprobe@loop.service; do
        ln -s /dev/null "$units/$unit"
    done
}

# moduleFiles FOLDER MODULE: prints the files of a kernel module and of the modules that it needs,
# in the order of loading.
moduleFiles() {
    local modules=$1 entry
    entry=$(grep -m 1 "/$2\.ko" "$modules/modules.dep") || die "$modules has no kernel module $2"
    # modules.dep lists the modules in the opposite order.
    tr ' ' '\n' <<<"${entry/:/}" | tac
}

# makeInitrd ROOT KERNEL OUT: makes an initrd that loads the modules for the disk and then starts
# systemd. It is made faster than Debian's initrd, and without executing programs of the guest.
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

# makeImage FOLDER PACKAGE...: makes root.img, vmlinuz and initrd in a new folder.
makeImage() {
    local part=$1 root=$1/root kernel
    shift
    mkdir -p "$part"
    # shellcheck disable=SC2046 # the package names are a list of words
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
hash=$(inputHash "$(debianSuite)" "${packages[@]}" "$(codeOf "$here/image.sh" "$here/../debian.sh")")
image=$cache/testbed-$hash
if [[ ! -d $image ]]; then
    printf 'Making the disk of the emulated board in %s; takes about 80 s\n' "$image" >&2
    rm -rf "$image.part"
    makeImage "$image.part" "${packages[@]}"
    chmod -R a+rX "$image.part"
    mv "$image.part" "$image"
fi
touch "$image"
# Removes disks that were not used for two weeks.
find "$cache" -maxdepth 1 -name 'testbed-*' -mtime +14 -exec rm -rf {} +
echo "$image"
