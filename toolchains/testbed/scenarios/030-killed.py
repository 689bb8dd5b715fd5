"""Killed without warning the service is back within 5 s, again and again, its trigger at rest."""

CONFIG = 'source = "synthetic:flat,rest"\n'
LIMIT = 5  # s
TIMES = 3


def run(bed):
    bed.fresh_service(CONFIG)
    for _ in range(TIMES):
        old = bed.property('MainPID')
        bed.run(f'kill -KILL {old}')
        seconds = bed.wait_for(
            f'[[ $(systemctl show -P MainPID mfard) != @(0|{old}) ]] && systemctl -q is-active mfard',
            LIMIT)
        print(f'        back after {seconds:.1f} s')
        assert bed.guest.edges.level() == 0, 'the trigger line is high'
    assert int(bed.property('NRestarts')) == TIMES
