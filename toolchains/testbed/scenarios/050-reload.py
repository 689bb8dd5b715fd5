"""A reload takes the new configuration, and keeps the old one when the new one is wrong."""

GOOD = 'source = "synthetic:flat,rest"\nsuperres.mode = "off"\n'
BAD = GOOD.replace('off', 'best')


def run(bed):
    bed.fresh_service(GOOD)
    pid = bed.property('MainPID')
    for config, answer in ((BAD, 'the old configuration stays'), (GOOD, 'mfard.toml: read again')):
        begin = bed.now()
        bed.write('/etc/mfar/mfard.toml', config)
        bed.run('systemctl reload mfard')
        bed.wait_for(f'journalctl -q -u mfard -o cat --since "{begin}" | grep -q "{answer}"', 5)
        assert bed.property('ActiveState') == 'active'
    assert bed.property('MainPID') == pid
