"""The emulated board sends 30 frames per second and one still for each pulse. Tested with standard tools."""

import re
import statistics

FRAMES = 60
PULSES = 5
STILL_BYTES = 2304 * 1728 * 3 // 2
# For gpioset of libgpiod 2 (Debian 13) and of libgpiod 1 (Debian 12).
PULSE = ('if gpioset --help | grep -q toggle; then gpioset --toggle 10ms,0 --chip gpiochip0 5=1; '
         'else gpioset -m time -u 10000 gpiochip0 5=1 && gpioset gpiochip0 5=0; fi')


def run(bed):
    bed.run('systemctl stop mfard')
    bed.numbered(True)
    try:
        video(bed)
        stills(bed)
    finally:
        bed.numbered(False)


def video(bed):
    said = bed.run(f'cam -c 1 -C{FRAMES} -s width=640,height=480,pixelformat=NV12 2>&1')
    times = [float(t) for t in re.findall(r'^(\d+\.\d+) \(.* seq:', said, re.MULTILINE)]
    assert len(times) == FRAMES, said
    pauses = [b - a for a, b in zip(times, times[1:])]
    rate = 1 / statistics.median(pauses)
    print(f'        {rate:.1f} frames per second')
    assert 29 < rate < 31, f'{rate:.1f} frames per second'


def stills(bed):
    """The second sensor delivers one still for each pulse, in order, and nothing else."""
    device = bed.run("v4l2-ctl --list-devices | grep -A1 'Bed still' | tail -n 1 | tr -d '\\t'")
    first = bed.still.pulses + 1
    bed.run(f'v4l2-ctl -d {device} --stream-mmap=4 --stream-count={PULSES} --stream-to=/tmp/stills '
            '>/tmp/v4l2-ctl 2>&1 & echo $! >/tmp/v4l2-ctl.pid')
    bed.run('sleep 3')
    for _ in range(PULSES):
        bed.run(PULSE + '; sleep 0.5')
    bed.run('while kill -0 $(cat /tmp/v4l2-ctl.pid) 2>/dev/null; do sleep 0.1; done', 30)
    bed.run('cp /tmp/stills /share; rm /tmp/stills')
    data = (bed.share / 'stills').read_bytes()
    assert len(data) == PULSES * STILL_BYTES, len(data)
    block = 2304 // 32
    numbers = [sum(1 << bit for bit in range(32) if data[i * STILL_BYTES + bit * block] > 128)
               for i in range(PULSES)]
    assert numbers == list(range(first, first + PULSES)), numbers
