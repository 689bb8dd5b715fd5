"""mfar's V4L2 code gets pictures from the kernel's test driver vivid and sets its controls."""


def run(bed):
    bed.run('systemctl stop mfard; modprobe vivid n_devs=1 node_types=0x1; udevadm settle', 120)
    try:
        device = bed.run("v4l2-ctl --list-devices | sed -n '/vivid/,/^$/p' | "
                         "sed -n 's/^\\t\\(.dev.video[0-9]*\\)$/\\1/p' | head -n 1")
        # timestamp_source=1: a frame's timestamp is the start of its exposure. By default it is the frame's end,
        # which with vivid lies in the future.
        said = bed.run(f'/share/v4l2-probe {device} 640x480 30 --format YUYV --rate 30 '
                       'timestamp_source=1 Brightness=200', 120)
        assert bed.run(f'v4l2-ctl -d {device} -C brightness') == 'brightness: 200', said
        refused = bed.guest.status(f'/share/v4l2-probe {device} 640x480 1 trigger_mode=1')
        assert refused == 2, f'a control that does not exist was not refused: exit status {refused}'
    finally:
        bed.run('modprobe -r vivid')
