"""The service can open its devices and nothing else on the machine."""

ALLOWED = ('/dev/video0', '/dev/media0', '/dev/dri/card0', '/dev/fb0', '/dev/gpiochip0')
DENIED = ('/dev/vda', '/dev/mem', '/etc/passwd', '/etc/mfar/mfard.toml', '/root/x',
          '/dev/virtio-ports/bed')


def run(bed):
    bed.run('touch /root/x')
    script = ''.join(f'( exec 3<>{path} ) || echo denied {path}; ' for path in ALLOWED)
    script += ''.join(f'( exec 3<>{path} ) 2>/dev/null && echo open {path}; ' for path in DENIED)
    script += 'echo written >/var/lib/mfar/x || echo denied /var/lib/mfar; echo looked'
    bed.fresh_service(bed.cameras, f"ExecStartPre=/bin/bash -c '{script}'\n")
    said = [line for line in bed.journal().splitlines()
            if line.startswith(('denied', 'open', 'looked'))]
    assert said == ['looked'], said
