"""Started without a display, it shows the picture within a second after one is plugged in."""

import re

BOOT = {'display': False}
LIMIT = 1  # s


def run(bed):
    bed.run('systemctl stop mfard')
    assert bed.guest.status('ls /dev/dri/card0') != 0
    # The guest's own clock tells when the device came and when the picture was there.
    bed.run('/share/mfar-display-probe auto 3 /share/shown.ppm 600 2>&1 '
            '| while read -r line; do echo "$(cut -d " " -f 1 /proc/uptime) $line"; done '
            '>/tmp/probe & echo started')
    bed.wait_for('grep -q "no screen yet" /tmp/probe', 180)
    bed.guest.plug_display()
    bed.wait_for('grep -q kms:card /tmp/probe', 60)
    said = bed.run('cat /tmp/probe')
    picture = float(re.search(r'^([\d.]+) .*: kms:card', said, re.MULTILINE)[1])
    device = float(bed.run('dmesg | sed -n "s/^\\[ *\\([0-9.]*\\)\\].*Initialized virtio_gpu.*/\\1/p" '
                           '| tail -n 1'))
    print(f'        picture {picture - device:.2f} s after the device')
    assert picture - device < LIMIT, said
    bed.run('for p in /proc/[0-9]*; do [[ $(readlink $p/exe) != */mfar-display-probe ]] || '
            'kill -KILL ${p#/proc/}; done')
