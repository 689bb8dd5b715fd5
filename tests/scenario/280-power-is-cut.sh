#!/usr/bin/env bash
# The power is cut while mfard records on a real file system. All writes to its disk are logged.
# From the log, a script makes disks as power cuts at random moments would leave them. Each disk
# must be mountable and contain everything that was synchronised before the cut. Every picture in
# the recording's list must be readable. Usage: 280-power-is-cut.sh MFARD MFAR-SIM PRETENDED.so
# [CUTS]. Exit status 77: root, loop devices, qemu-storage-daemon or FUSE are missing.
for needed in qemu-storage-daemon mkfs.ext4 losetup python3; do
    command -v $needed >/dev/null || { echo "$needed is not installed" && exit 77; }
done
if [ "$(id -u)" != 0 ] || [ ! -e /dev/fuse ] || [ ! -e /dev/loop-control ]; then
    echo "no file system can be mounted on this machine"
    exit 77
fi
if [ -z "${MFAR_MOUNTS:-}" ]; then MFAR_MOUNTS=1 exec unshare --mount "$0" "$@"; fi
tools=$(dirname "$(readlink -f "$0")")
. "$tools/lib.sh"

pretended=$3
cuts=${4:-10}
seed=${MFAR_SEED:-7}
loop=
trap 'umount --lazy disk after shown 2>/dev/null || true; losetup --detach "$loop" 2>/dev/null || true; clean_up' EXIT

# QEMU exports disk.img as the file "shown" and logs all writes to it.
truncate --size 64M disk.img
mkfs.ext4 -q disk.img
cp --sparse=always disk.img start.img
mkdir disk after state
touch shown log
qemu-storage-daemon --blockdev driver=file,node-name=image,filename=disk.img \
    --blockdev driver=file,node-name=log,filename=log \
    --blockdev driver=blklogwrites,node-name=logged,file=image,log=log \
    --export type=fuse,id=export,node-name=logged,mountpoint="$PWD/shown",writable=on &
pids+=($!)
exported() { [ -s shown ]; }
until_true exported
loop=$(losetup --find --show shown)
# By default, ext4 writes all data every five seconds. This would hide a missing synchronisation in
# mfard. commit=300 makes the interval 300 s, which is longer than this test.
mount -t ext4 -o commit=300 "$loop" disk

export STATE_DIRECTORY=$PWD/state
pretended_cameras '[record]
directory = "disk/films"
least_free_mb = 0'
LD_PRELOAD=$pretended MFAR_PRETENDED_V4L2=$PWD/cameras start --config mfard.toml --display none
named() { cat disk/films/*/cam0/data.csv 2>/dev/null | grep -c '^[0-9]' || true; }
has_grown() { [ "$(named)" -gt "$rows" ]; }
rows=0
for _ in 1 2 3 4; do
    until_true has_grown
    # The previous rows are safe, because mfard synchronises them before it adds further rows.
    echo "$(stat --format %s log) $rows" >>marks
    rows=$(named)
done
kill -KILL "$pid"
wait "$pid" 2>/dev/null || true
cp log log.whole
echo "$(stat --format %s log.whole) bytes of log"

readable=0
for cut in $(seq "$cuts"); do
    safe=$(python3 -B "$tools/disk_after_cut.py" start.img log.whole marks $((seed + cut)) cut.img)
    mount -t ext4 -o loop cut.img after || fail "cut $cut: the file system cannot be mounted"
    film=$(ls -d after/films/* 2>/dev/null || true)
    rows=0
    # The list's file may be longer than the written data. Its end then has other bytes, which do
    # not look like rows.
    if [ -n "$film" ]; then rows=$(grep -acE '^[0-9]+,[0-9]+\.png$' "$film/cam0/data.csv" || true); fi
    [ "$rows" -ge "$safe" ] ||
        fail "cut $cut: the list has $rows pictures, but $safe were synchronised before the cut"
    if [ "$rows" -gt 0 ]; then
        run 0 --recording "$film" --pace consumer --display none --summary summary.json
        summary_has frames "$rows"
        readable=$((readable + 1))
    fi
    umount after
done
echo "$cuts cuts; $readable readable recordings with pictures"
[ $readable -ge $((cuts / 2)) ] ||
    fail "only $readable recordings have pictures; expected: $((cuts / 2)) or more"
