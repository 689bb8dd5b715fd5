"""Pictures and controls straight from a V4L2 driver, the kernel's own test driver vivid."""


def run(bed):
    bed.run('systemctl stop mfard; modprobe vivid n_devs=1 node_types=0x1; udevadm settle', 120)
    try:
        device = bed.run("v4l2-ctl --list-devices | sed -n '/vivid/,/^$/p' | "
                         "sed -n 's/^\\t\\(.dev.video[0-9]*\\)$/\\1/p' | head -n 1")
        # By default the time stamps of vivid's frames are their ends, in the future.
        said = bed.run(f'/share/v4l2-probe {device} 640x480 30 --format YUYV --rate 30 '
                       'timestamp_source=1 Brightness=200', 120)
        assert bed.run(f'v4l2-ctl -d {device} -C brightness') == 'brightness: 200', said
        refused = bed.guest.status(f'/share/v4l2-probe {device} 640x480 1 trigger_mode=1')
        assert refused == 2, f'a control that is not there: {refused}'
    finally:
        bed.run('modprobe -r vivid')
