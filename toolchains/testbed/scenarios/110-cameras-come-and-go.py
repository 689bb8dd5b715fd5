"""Each camera of the board is unplugged and plugged in again. The service reports the loss and continues."""

import re
import time

CONFIG = '''jitter_ms = 100
[superres]
mode = "off"
[pose]
source = "none"
[status]
interval_s = 0.1
'''
TIMES = 10
SAID_LIMIT = 2  # largest time until the picture reports a lost camera [s]; a picture takes about 1 s in the guest
BACK_LIMIT = 3  # largest time until a plugged camera is used again [s]


def run(bed):
    bed.held(True)  # so that only the banner changes the picture
    try:
        come_and_go(bed)
    finally:
        bed.held(False)


def come_and_go(bed):
    seconds = bed.fresh_service('display = "auto"\n' + bed.devices + CONFIG, 'WatchdogSec=120\n')
    print(f'        ready after {seconds:.1f} s')
    bed.wait_for_pictures(10)  # the first pictures take long, because shaders are compiled
    before = None
    for round_ in range(TIMES):
        for camera, role in ((bed.video, 'video camera'), (bed.still, 'still camera')):
            said = reported_after(bed, camera.unplug)
            bed.wait_for(status(role), 20)
            back = back_after(bed, camera.plug, role)
            print(f'        {role}: loss reported after {said:.2f} s, used again after {back:.2f} s')
            assert said < SAID_LIMIT, f'{role}: loss reported after {said:.1f} s'
            assert back < BACK_LIMIT, f'{role}: used again after {back:.1f} s'
        if round_ == 0:
            before = used(bed)
    after = used(bed)
    print(f'        (file descriptors, threads): {before} -> {after}')
    assert all(a <= b for a, b in zip(after, before)), \
        f'(file descriptors, threads) grew from {before} to {after}'
    assert bed.property('NRestarts') == '0'


def reported_after(bed, event):
    """Returns the time from `event` until the picture on the screen changes [s]."""
    before = bed.guest.screen()
    begin = time.monotonic()
    event()
    while time.monotonic() < begin + 20:
        if differ(before[2], bed.guest.screen()[2]):
            return time.monotonic() - begin
    raise AssertionError('the picture on the screen did not change within 20 s')


def back_after(bed, event, role):
    """Returns the time from the kernel's message about the new device until the service's status no longer names the
    camera, on the guest's clock [s]. The journal would be of no use, because it names an event at most once in 10 s."""
    event()
    wait = f'while {status(role)}; do sleep 0.05; done; cut -d " " -f 1 /proc/uptime'
    service = float(bed.run(wait, 20))
    found = bed.run('dmesg | grep "Found UVC" | tail -n 1')
    return service - float(re.search(r'\[ *([\d.]+)\]', found)[1])


def differ(a, b):
    """True if more than a thousandth of the bytes differ, judged by every 97th byte."""
    return a != b and sum(x != y for x, y in zip(a[::97], b[::97])) > len(a) / 97 / 1000


def status(words):
    return f"systemctl show mfard --value -p StatusText | grep -q '{words}'"


def used(bed):
    pid = bed.property('MainPID')
    return (int(bed.run(f'ls /proc/{pid}/fd | wc -l')), int(bed.run(f'ls /proc/{pid}/task | wc -l')))
