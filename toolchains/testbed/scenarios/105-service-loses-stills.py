"""The service matches fifty stills with their pulses. It requests a missing still again and does not use a
late still."""

import json
import time

CONFIG = '''jitter_ms = 100
arrival_ms = 1500
[superres]
mode = "off"
[pose]
source = "none"
[status]
interval_s = 0.5
'''
GOOD = 50  # the service itself requests the first one
LIMIT = 60  # s


def run(bed):
    bed.held(True)  # at rest, mfard itself requests only the first still
    try:
        counts = lose_stills(bed)
    finally:
        bed.held(False)
    print(f'        {counts}')
    assert bed.property('NRestarts') == '0'
    assert bed.guest.edges.level() == 0, 'the trigger line is high'


def lose_stills(bed):
    bed.fresh_service(bed.devices + CONFIG)
    bed.wait_for_pictures(1)
    counted(bed, fired=1, matched=1, lost=0)
    bed.wait_for_pictures(8)  # so that pictures with the first still have been shown
    for good in range(2, GOOD + 1):
        ask(bed)
        counted(bed, fired=good, matched=good, lost=0)

    bed.still.fault('missing')
    ask(bed)
    counted(bed, fired=GOOD + 2, matched=GOOD + 1, lost=1, repeated=1, unmatched=0)

    bed.still.fault('late', 3)
    ask(bed)
    # mfard repeats the pulse because the still is late. The second pulse's still arrives first and is matched. The
    # late still then stays unmatched, because a USB picture's time is that of its arrival.
    return counted(bed, fired=GOOD + 4, matched=GOOD + 2, lost=2, repeated=2, unmatched=1)


def ask(bed):
    # The guest is slow: mfarctl can give up before mfard answers. The still is captured nevertheless.
    bed.run('mfarctl trigger', check=False)


def counted(bed, **wanted):
    """Waits until these counters have these values. Returns all counters."""
    end = time.monotonic() + LIMIT
    while True:
        counts = json.loads(bed.run('mfarctl stats'))['trigger_line']
        if all(counts[name] == count for name, count in wanted.items()):
            return counts
        assert time.monotonic() < end, f'the counters are {counts}; expected: {wanted}'
        time.sleep(0.1)
