"""In the service, too, a still that is missing is asked for once more, and one that is late is told."""

import json
import time

CONFIG = '''source = "cameras"
[cameras.video]
camera = "Bed video"
[cameras.still]
camera = "Bed still"
[cameras.trigger]
chip = "gpiochip0"
line = "5"
jitter_ms = 100
arrival_ms = 1500
[superres]
mode = "off"
[pose]
source = "none"
[trigger]
mode = "off"
'''
GOOD = 3
LIMIT = 60  # s


def run(bed):
    bed.fresh_service(CONFIG)
    bed.wait_for("systemctl show mfard --value -p StatusText | grep -q fps", LIMIT)
    for good in range(1, GOOD + 1):
        trigger(bed, fired=good, matched=good, lost=0)

    bed.still.fault('missing')
    trigger(bed, fired=GOOD + 2, matched=GOOD + 1, lost=1, repeated=1)

    bed.still.fault('late', 3)
    counts = trigger(bed, fired=GOOD + 4, lost=2, late=1, repeated=2)
    print(f'        {counts}')
    assert counts['unmatched'] == 0, counts
    assert bed.property('NRestarts') == '0'
    assert bed.guest.edges.level() == 0, 'the trigger line is high'


def trigger(bed, **wanted):
    """Asks for a still: the counters, once they are as wanted."""
    bed.run('mfarctl trigger')
    end = time.monotonic() + LIMIT
    while True:
        counts = json.loads(bed.run('mfarctl stats'))['trigger_line']
        if all(counts[name] == count for name, count in wanted.items()):
            return counts
        assert time.monotonic() < end, f'{counts} instead of {wanted}'
        time.sleep(0.5)
