"""The service loses less than 1 % of the video frames, even if its own pictures take long."""

import json

SECONDS = 10


def run(bed):
    bed.fresh_service('display = "none"\n' + bed.cameras)
    bed.wait_for_pictures(12)
    before, begin = counted(bed), bed.guest.clock()
    bed.run(f'sleep {SECONDS}')
    after, end = counted(bed), bed.guest.clock()
    came, lost = (b - a for a, b in zip(before, after))
    rate = (came + lost) / (end - begin)
    print(f'        {rate:.1f} frames per second, {lost} of {came + lost} lost by the sensor or the driver')
    assert 27 < rate < 33, f'{rate:.1f} frames per second'
    assert lost < (came + lost) / 100, f'{lost} of {came + lost} frames lost'


def counted(bed):
    """Returns (number of received frames, used or dropped in the mailbox; number of lost frames)."""
    stats = json.loads(bed.run('mfarctl stats'))
    return stats['frames'] + stats['drops']['mailbox'], stats['drops']['sensor']
