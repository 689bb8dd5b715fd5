"""libcamera delivers video at 30 frames per second and loses less than 1 % of the frames."""

import re
import statistics

FRAMES = 300


def run(bed):
    bed.run('systemctl stop mfard')
    said = bed.run(f'/share/libcamera-probe "Bed video" 640x480 {FRAMES}', 120)
    times = [float(t) for t in re.findall(r'^(\d+\.\d+) \d+ 640x480', said, re.MULTILINE)]
    assert len(times) == FRAMES, said
    rate = 1 / statistics.median(b - a for a, b in zip(times, times[1:]))
    dropped = int(re.search(r'^frames \d+ dropped (\d+)', said, re.MULTILINE)[1])
    print(f'        {rate:.1f} frames per second, {dropped} of {FRAMES} frames dropped')
    assert 29 < rate < 31, f'{rate:.1f} frames per second'
    assert dropped < FRAMES / 100, f'{dropped} of {FRAMES} frames dropped'
