"""The service stops within a second and with exit status 0."""

LIMIT = 1  # s


def run(bed):
    bed.fresh_service(bed.cameras)
    seconds = float(bed.run('TIMEFORMAT=%R; time systemctl stop mfard'))
    print(f'        stopped after {seconds:.2f} s')
    assert seconds < LIMIT, f'stopped only after {seconds:.2f} s'
    assert bed.property('Result') == 'success', bed.property('Result')
    assert bed.property('ExecMainStatus') == '0'
    assert bed.guest.edges.level() == 0, 'the trigger line is high'
