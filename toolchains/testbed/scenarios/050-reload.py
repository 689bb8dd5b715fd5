"""A reload applies the new configuration. If the new one is invalid, the service keeps the old one."""


def run(bed):
    good = bed.cameras + '[superres]\nmode = "off"\n'
    bad = bed.cameras + '[superres]\nmode = "best"\n'
    bed.fresh_service(bed.cameras)
    pid = bed.property('MainPID')
    for config, answer in ((bad, 'the old configuration stays'), (good, 'mfard.toml: read again')):
        begin = bed.now()
        bed.write('/etc/mfar/mfard.toml', config)
        bed.run('systemctl reload mfard')
        bed.wait_for(f'journalctl -q -u mfard -o cat --since "{begin}" | grep -q "{answer}"', 5)
        assert bed.property('ActiveState') == 'active'
    assert bed.property('MainPID') == pid
