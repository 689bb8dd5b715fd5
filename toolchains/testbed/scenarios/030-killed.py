"""After the service is killed, it runs again within 5 s and is ready within 10 s more. Its trigger line is
released."""

LIMIT = 5  # s
READY_LIMIT = 10  # s
TIMES = 3


def run(bed):
    bed.fresh_service(bed.cameras)
    for _ in range(TIMES):
        old = bed.property('MainPID')
        bed.run(f'kill -KILL {old}')
        seconds = bed.wait_for(
            f'[[ $(systemctl show -P MainPID mfard) != @(0|{old}) ]]', LIMIT)
        ready = bed.wait_for('systemctl -q is-active mfard', READY_LIMIT)
        print(f'        runs again after {seconds:.1f} s, ready {ready:.1f} s later')
        assert bed.guest.edges.level() == 0, 'the trigger line is high'
    assert int(bed.property('NRestarts')) == TIMES
