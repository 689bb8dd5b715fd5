"""The service can open its devices and write to its own folder, but cannot open other devices and files."""

ALLOWED = ('/dev/video0', '/dev/media0', '/dev/dri/card0', '/dev/fb0', '/dev/gpiochip0')
DENIED = ('/dev/vda', '/dev/mem', '/etc/passwd', '/etc/mfar/mfard.toml', '/root/x',
          '/dev/virtio-ports/bed')


def run(bed):
    bed.run('touch /root/x')
    allowed = ''.join(f'( exec 3<>{path} ) || echo denied {path}; ' for path in ALLOWED)
    allowed += 'echo written >/var/lib/mfar/x || echo denied /var/lib/mfar'
    denied = ''.join(f'( exec 3<>{path} ) 2>/dev/null && echo open {path}; ' for path in DENIED)
    denied += 'echo looked'
    # "!" runs the command as root, but in the unit's sandbox. The user mfar could not open these
    # paths even without a sandbox, because of their permissions.
    bed.fresh_service(bed.cameras, f"ExecStartPre=/bin/bash -c '{allowed}'\n"
                                   f"ExecStartPre=!/bin/bash -c '{denied}'\n")
    said = [line for line in bed.journal().splitlines()
            if line.startswith(('denied', 'open', 'looked'))]
    assert said == ['looked'], said
