"""The service matches fifty stills to their pulses; a missing still is requested again, a late one is not
used."""

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
    bed.held(True)  # at rest only the stills requested here are needed
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
    bed.wait_for_pictures(8)  # some of them use that still
    for good in range(2, GOOD + 1):
        ask(bed)
        counted(bed, fired=good, matched=good, lost=0)

    bed.still.fault('missing')
    ask(bed)
    counted(bed, fired=GOOD + 2, matched=GOOD + 1, lost=1, repeated=1, unmatched=0)

    bed.still.fault('late', 3)
    ask(bed)
    # A USB picture is timed on arrival: when the late one comes, its repetition has been matched
    # already.
    return counted(bed, fired=GOOD + 4, matched=GOOD + 2, lost=2, repeated=2, unmatched=1)


def ask(bed):
    # In the guest a picture may take longer than mfarctl waits; the still is taken nevertheless.
    bed.run('mfarctl trigger', check=False)


def counted(bed, **wanted):
    """Waits until the counters have these values; returns all."""
    end = time.monotonic() + LIMIT
    while True:
        counts = json.loads(bed.run('mfarctl stats'))['trigger_line']
        if all(counts[name] == count for name, count in wanted.items()):
            return counts
        assert time.monotonic() < end, f'{counts} instead of {wanted}'
        time.sleep(0.1)
