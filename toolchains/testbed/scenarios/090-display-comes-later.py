"""A program that was started without a display shows its picture within a second after a display is plugged in. The
service does so again after the display was unplugged for a while. Tested with mfar-display-probe and the service."""

import re

BOOT = {'display': False}
LIMIT = 1  # s
CONFIG = '''[superres]
mode = "off"
[status]
interval_s = 0.1
'''


def run(bed):
    bed.run('systemctl stop mfard')
    assert bed.guest.status('ls /dev/dri/card0') != 0
    of_the_probe(bed)
    bed.guest.unplug_display()
    bed.wait_for('! ls /dev/dri/card0', 20)
    bed.held(True)
    try:
        of_the_service(bed)
    finally:
        bed.held(False)


def of_the_probe(bed):
    # The guest's clock measures when the device appeared and when the picture was shown.
    bed.run('/share/mfar-display-probe auto 3 /share/shown.ppm 600 2>&1 '
            '| while read -r line; do echo "$(cut -d " " -f 1 /proc/uptime) $line"; done '
            '>/tmp/probe & echo started')
    bed.wait_for('grep -q "no screen yet" /tmp/probe', 180)
    bed.guest.plug_display()
    bed.wait_for('grep -q kms:card /tmp/probe', 60)
    said = bed.run('cat /tmp/probe')
    shown_in_time(bed, float(re.search(r'^([\d.]+) .*: kms:card', said, re.MULTILINE)[1]), said)
    bed.run('for p in /proc/[0-9]*; do [[ $(readlink $p/exe) != */mfar-display-probe ]] || '
            'kill -KILL ${p#/proc/}; done')


def of_the_service(bed):
    # The size is that of the display. With size = "screen" and no display, pictures would be as large as
    # stills and take a second each in the guest.
    bed.fresh_service('display = "auto"\nsize = "1280x720"\n' + bed.cameras + CONFIG)
    bed.wait_for_pictures(10)
    bed.run('mfarctl status | grep -q "no screen"')
    for _ in range(2):
        since = bed.now()
        bed.guest.plug_display()
        bed.wait_for('mfarctl status | grep -q kms:card', 60)
        said = bed.run(f'journalctl --no-pager -q -u mfard -o short-monotonic --since "{since}"')
        shown_in_time(bed, float(re.search(r'^\[ *([\d.]+)\].*display kms:card', said, re.MULTILINE)[1]),
                      said)
        bed.guest.unplug_display()
        bed.wait_for('mfarctl status | grep -q "no screen"', 20)
    assert bed.property('NRestarts') == '0'


def shown_in_time(bed, picture, said):
    device = float(bed.run('dmesg | sed -n "s/^\\[ *\\([0-9.]*\\)\\].*Initialized virtio_gpu.*/\\1/p" '
                           '| tail -n 1'))
    print(f'        picture shown {picture - device:.2f} s after the device appeared')
    assert picture - device < LIMIT, said
