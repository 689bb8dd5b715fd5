"""A snapshot of the screen by mfarctl equals the picture on the display, pixel by pixel."""

from png import read_png

CONFIG = '''[superres]
mode = "off"
[status]
interval_s = 0.5
'''
TRIES = 10


def run(bed):
    bed.held(True)
    try:
        for screen in ('kms', 'fbdev'):
            bed.fresh_service(f'display = "{screen}"\n' + bed.cameras + CONFIG)
            bed.wait_for_pictures(5)
            bed.wait_for(f'mfarctl status | grep -q "^display *{screen}:"', 60)
            compare(bed, screen)
    finally:
        bed.held(False)


def compare(bed, screen):
    for _ in range(TRIES):
        shown = bed.guest.screen()
        bed.run('mfarctl snapshot --screen /share/snapshot.png', 60)
        if bed.guest.screen() == shown:
            break
    else:
        raise AssertionError('the picture on the screen keeps changing')
    taken = read_png(bed.share / 'snapshot.png')
    assert taken[:2] == shown[:2], f'{screen}: the snapshot has the size {taken[:2]} instead of {shown[:2]}'
    assert len(set(taken[2])) > 50, f'{screen}: the bytes of the snapshot have at most 50 different values'
    wrong = sum(1 for a, b in zip(taken[2], shown[2]) if a != b)
    print(f'        {screen}: {shown[0]}x{shown[1]}, {wrong} bytes differ')
    assert wrong == 0, f'{screen}: {wrong} of {len(shown[2])} bytes differ'
