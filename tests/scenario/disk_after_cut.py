#!/usr/bin/env python3
"""Makes a disk image as a power cut at a random moment would leave it, from a log of all writes.

Usage: disk_after_cut.py START LOG MARKS SEED OUT

START is the disk image before the first write. LOG has all later writes and flushes in the format
of Linux's dm-log-writes, as QEMU's blklogwrites makes it. Each line of MARKS is "BYTES ROWS": ROWS
rows of the recording's list were synchronised when the log had BYTES bytes. OUT is the disk image
that is written. Prints how many rows were synchronised before the cut.

A disk keeps everything that was written before its last flush or with the flag FUA. It may keep any
blocks of 4 KiB of other writes, each as a whole. SEED determines the cut and the kept blocks."""

import random
import shutil
import struct
import sys
from pathlib import Path

MAGIC = 0x6a736677736872
FLUSH, FUA, DISCARD = 1, 2, 4
ENTRY = struct.Struct('<QQQQ')  # first sector, number of sectors, flags, bytes of data
SECTOR, BLOCK = 512, 4096


def entries(log):
    """Returns the log's entries in order: (end of the entry, flags, position on the disk, data)."""
    magic, version, _, sector_size = struct.unpack_from('<QQQI', log)
    if (magic, version, sector_size) != (MAGIC, 1, SECTOR):
        sys.exit(f'LOG is not a dm-log-writes log with sectors of {SECTOR} bytes')
    at, out = SECTOR, []
    while at + SECTOR <= len(log):
        sector, count, flags, _ = ENTRY.unpack_from(log, at)
        at += SECTOR
        if flags & DISCARD:
            sys.exit('LOG contains a discard of sectors, which this script does not support')
        data = log[at:at + count * SECTOR]
        if len(data) < count * SECTOR:
            break
        at += len(data)
        out.append((at, flags, sector * SECTOR, data))
    return out


def blocks(place, data):
    """Yields the parts of a write. A disk keeps each part either wholly or not at all."""
    begin = 0
    while begin < len(data):
        end = min(len(data), begin + BLOCK - (place + begin) % BLOCK)
        yield place + begin, data[begin:end]
        begin = end


def after_cut(start, done, chance, share, out):
    """Writes to `out` the disk image that a power cut after the entries `done` leaves. Each block that
    was written after the last flush, without FUA, is kept with the probability `share`."""
    flushed = max((i for i, entry in enumerate(done) if entry[1] & FLUSH), default=0)
    shutil.copyfile(start, out)
    with open(out, 'r+b') as disk:
        for i, (_, flags, place, data) in enumerate(done):
            for begin, block in blocks(place, data):
                if i < flushed or flags & FUA or chance.random() < share:
                    disk.seek(begin)
                    disk.write(block)


def main():
    start, log, marks, seed, out = sys.argv[1:]
    chance = random.Random(int(seed))
    written = entries(Path(log).read_bytes())
    done = written[:chance.randrange(1, len(written) + 1)]
    after_cut(start, done, chance, chance.choice([0, chance.random(), 1]), out)
    rows = 0
    for line in Path(marks).read_text(encoding='ascii').splitlines():
        size, safe = map(int, line.split())
        if size <= done[-1][0]:
            rows = safe
    print(rows)


main()
