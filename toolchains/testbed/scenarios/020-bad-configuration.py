"""With an invalid configuration, the service reports file and line of the fault, ends with exit code 78 and is not
restarted."""

CONFIG = 'source = "cameras"\nsuperres.mode = "sometimes"\n'


def run(bed):
    bed.run('systemctl stop mfard; systemctl reset-failed mfard; true')
    begin = bed.now()
    bed.write('/etc/mfar/mfard.toml', CONFIG)
    bed.run('systemctl start mfard; true')
    bed.wait_for('systemctl is-failed mfard', 20)
    # Longer than the pause before a restart, so that a restart would be noticed.
    bed.run('sleep 3')
    assert bed.property('ActiveState') == 'failed'
    assert bed.property('ExecMainStatus') == '78', bed.property('ExecMainStatus')
    assert bed.property('NRestarts') == '0', bed.property('NRestarts')
    assert '/etc/mfar/mfard.toml:2:17: superres.mode' in bed.journal(begin), bed.journal(begin)
