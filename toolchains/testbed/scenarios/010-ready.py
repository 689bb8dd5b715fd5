"""The service starts as the user mfar and is ready within 10 s."""

READY_LIMIT = 10  # s


def run(bed):
    seconds = bed.fresh_service(bed.cameras)
    print(f'        ready after {seconds:.1f} s')
    assert seconds < READY_LIMIT, f'ready only after {seconds:.1f} s'
    assert bed.property('ActiveState') == 'active'
    pid = bed.property('MainPID')
    assert bed.run(f'stat -c %U /proc/{pid}') == 'mfar'
    assert bed.property('NRestarts') == '0'
