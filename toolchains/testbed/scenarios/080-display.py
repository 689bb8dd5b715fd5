"""The screen shows exactly the pictures that were sent to it, over KMS and over the framebuffer."""

PICTURES = 5


def run(bed):
    bed.run('systemctl stop mfard')
    for screen in ('kms', 'fbdev'):
        show(bed, screen)


def show(bed, screen):
    bed.run(f'rm -f /share/shown.ppm; cd /root; /share/mfar-display-probe {screen} {PICTURES} '
            '/share/shown.ppm 600 >/tmp/probe 2>&1 & echo $! >/tmp/probe.pid')
    try:
        bed.wait_for('grep -q saved /tmp/probe', 180)
        said = bed.run('cat /tmp/probe')
        assert f'{screen}:' in said, said
        print(f'        {screen}: {said.splitlines()[-2]}')
        expected = read_ppm(bed.share / 'shown.ppm')
        shown = bed.guest.screen()
        assert shown[:2] == expected[:2], f'{screen}: the picture has the size {shown[:2]} instead of {expected[:2]}'
        wrong = sum(1 for a, b in zip(shown[2], expected[2]) if a != b)
        assert wrong == 0, f'{screen}: {wrong} of {len(shown[2])} bytes differ'
    finally:
        bed.run('kill -KILL $(cat /tmp/probe.pid)')


def read_ppm(path):
    with open(path, 'rb') as file:
        magic, size, depth = (file.readline() for _ in range(3))
        assert (magic, depth) == (b'P6\n', b'255\n'), magic
        width, height = map(int, size.split())
        return width, height, file.read()
