"""Fifty pulses give fifty stills, which are matched correctly. Late and missing stills are detected."""

import re

PULSES = 50
PERIOD = 600  # time between pulses [ms]
JITTER = 100  # jitter of the stills' times [ms], because USB pictures get their time on arrival
PROBE = '/share/trigger-probe "Bed still" 2304x1728 gpiochip0 5'


def run(bed):
    bed.run('systemctl stop mfard')
    bed.numbered(True)
    try:
        every_still_belongs_to_its_pulse(bed)
        late_and_missing_stills(bed)
    finally:
        bed.numbered(False)
    assert bed.guest.edges.level() == 0, 'the trigger line is high'


def fire(bed, pulses):
    """Fires pulses. Returns the matched stills as (number of pulses so far, number of the still's own pulse),
    both counted from 1 at the first of these pulses, and the counters."""
    first = bed.still.pulses
    said = bed.run(f'{PROBE} {pulses} {PERIOD} {JITTER} 2>/tmp/probe.err || cat /tmp/probe.err',
                   pulses * PERIOD / 1000 + 60)
    stills = [(int(pulse), int(still) - first)
              for pulse, still in re.findall(r'pulse (\d+) still (\d+)', said)]
    counters = re.search(r'^fired .*', said, re.MULTILINE)
    assert counters, said
    words = counters[0].split()
    return stills, dict(zip(words[::2], map(int, words[1::2])))


def every_still_belongs_to_its_pulse(bed):
    stills, counters = fire(bed, PULSES)
    print(f'        {counters}')
    assert counters['fired'] == counters['matched'] == PULSES, counters
    assert [still for _, still in stills] == list(range(1, PULSES + 1)), stills


def late_and_missing_stills(bed):
    bed.still.fault('late', 0.25)
    bed.still.fault('missing')
    stills, counters = fire(bed, 6)
    print(f'        {counters}')
    # The late still can arrive within the matching window or after it. The missing still is
    # requested again.
    assert counters['lost'] >= 1 and counters['repeated'] >= 1, counters
    numbers = [still for _, still in stills]
    assert 2 not in numbers, 'the probe reports a still that was never sent'
    assert numbers == sorted(set(numbers)), stills
    assert counters['fired'] == 6 + counters['repeated'], counters
