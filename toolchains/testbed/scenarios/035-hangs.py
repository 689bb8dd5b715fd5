"""A service that stops making pictures is ended by its watchdog and restarted; its trigger line is released."""

WATCHDOG = 20  # s; six times as long for the first pictures
LIMIT = WATCHDOG + 10  # s: the process is first asked to end, then killed


def run(bed):
    bed.fresh_service(bed.cameras, f'WatchdogSec={WATCHDOG}\n')
    bed.wait_for_pictures(12)
    hung = bed.property('MainPID')
    bed.run(f'kill -STOP {hung}')
    seconds = bed.wait_for(f'[[ $(systemctl show -P MainPID mfard) != @(0|{hung}) ]]', LIMIT)
    print(f'        runs again after {seconds:.1f} s')
    assert seconds > WATCHDOG / 2, 'ended by something else'
    assert int(bed.property('NRestarts')) == 1
    assert bed.guest.edges.level() == 0, 'the trigger line is high'
