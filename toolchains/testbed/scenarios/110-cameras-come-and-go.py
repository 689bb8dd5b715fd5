"""The service on the board's cameras: pictures flow, and each camera may be unplugged and comes back."""

CONFIG = '''jitter_ms = 100
[superres]
mode = "off"
[pose]
source = "none"
[status]
interval_s = 0.1
'''
TIMES = 10
SAID_LIMIT = 2  # s: a picture takes about one in the guest
BACK_LIMIT = 3  # s


def run(bed):
    seconds = bed.fresh_service('display = "auto"\n' + bed.devices + CONFIG, 'WatchdogSec=120\n')
    print(f'        ready after {seconds:.1f} s')
    bed.wait_for(status('fps'), 60)
    before = None
    for round_ in range(TIMES):
        for camera, role in ((bed.video, 'video camera'), (bed.still, 'still camera')):
            camera.unplug()
            said = bed.wait_for(status(role), 20)
            camera.plug()
            bed.wait_for("lsusb -t >/dev/null; ls /dev/v4l/by-id | grep -c Bed | grep -q '[24]'", 20)
            back = bed.wait_for(f'! {status(role)}', 20)
            print(f'        {role}: said after {said:.2f} s, back after {back:.2f} s')
            assert said < SAID_LIMIT, f'{role}: said after {said:.1f} s'
            assert back < BACK_LIMIT, f'{role}: back after {back:.1f} s'
        if round_ == 0:
            before = used(bed)
    after = used(bed)
    print(f'        descriptors and threads {before} -> {after}')
    assert after <= before, f'descriptors and threads grew from {before} to {after}'
    assert bed.property('NRestarts') == '0'


def status(words):
    return f"systemctl show mfard --value -p StatusText | grep -q '{words}'"


def used(bed):
    pid = bed.property('MainPID')
    return (int(bed.run(f'ls /proc/{pid}/fd | wc -l')), int(bed.run(f'ls /proc/{pid}/task | wc -l')))
