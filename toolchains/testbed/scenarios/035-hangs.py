"""If the service stops making pictures, the watchdog ends it and systemd restarts it. Its trigger line is
released."""

WATCHDOG = 20  # systemd's watchdog timeout [s]; mfard makes it six times as long until ten pictures are shown
LIMIT = WATCHDOG + 10  # largest time until the restart [s]; systemd first sends SIGABRT, then SIGKILL


def run(bed):
    bed.fresh_service(bed.cameras, f'WatchdogSec={WATCHDOG}\n')
    bed.wait_for_pictures(12)
    hung = bed.property('MainPID')
    bed.run(f'kill -STOP {hung}')
    seconds = bed.wait_for(f'[[ $(systemctl show -P MainPID mfard) != @(0|{hung}) ]]', LIMIT)
    print(f'        runs again after {seconds:.1f} s')
    assert seconds > WATCHDOG / 2, f'restarted after {seconds:.1f} s, before the watchdog could act'
    assert int(bed.property('NRestarts')) == 1
    assert bed.guest.edges.level() == 0, 'the trigger line is high'
