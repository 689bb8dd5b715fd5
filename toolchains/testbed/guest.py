"""The guest: Debian for arm64 under QEMU with two USB cameras, a GPIO chip, a display and a root shell."""

import json
import os
import re
import socket
import subprocess
import threading
import time

import usbredir

TRIGGER_LINE = 5  # line of the GPIO chip PL061, the guest's /dev/gpiochip0
BOOT_LIMIT = 180  # largest duration of the boot [s]
# Start of a shell loop over the virtio devices that are displays (type 16).
EACH_DISPLAY = 'for d in /sys/bus/virtio/devices/*; do [[ $(<$d/device) == 0x0010 ]] || continue; '


class GuestError(Exception):
    """A command failed in the guest, or a wait for the guest took too long."""


class Result:
    def __init__(self, status, output):
        self.status = status
        self.output = output


class Listener:
    """A socket file that QEMU connects to."""

    def __init__(self, path):
        self.path = path
        self._socket = socket.socket(socket.AF_UNIX)
        self._socket.bind(path)
        self._socket.listen(1)

    def accept(self, limit):
        self._socket.settimeout(limit)
        connection, _ = self._socket.accept()
        self._socket.close()
        connection.settimeout(None)
        return connection


class Shell:
    """Runs commands in the guest's root shell, one after the other."""

    def __init__(self, connection):
        self._connection = connection
        self._count = 0
        self._rest = b''

    def run(self, command, limit):
        """Runs a command line and waits for its end. Throws GuestError after `limit` seconds."""
        self._count += 1
        mark = b'\n\x01%d ' % self._count
        # With eval, printf runs even if the command has a syntax error.
        quoted = command.replace("'", "'\\''")
        self._connection.sendall(f"eval '{quoted}' </dev/null; "
                                 f"printf '\\n\\001{self._count} %d\\n' $?\n".encode())
        end = time.monotonic() + limit
        data = self._rest
        while True:
            start = data.find(mark)
            stop = data.find(b'\n', start + len(mark)) if start >= 0 else -1
            if stop >= 0:
                self._rest = data[stop + 1:]
                output = data[:start].decode(errors='replace')
                return Result(int(data[start + len(mark):stop]), output)
            self._connection.settimeout(max(end - time.monotonic(), 0.01))
            try:
                part = self._connection.recv(65536)
            except TimeoutError:
                raise GuestError(f'the command did not end within {limit:.0f} s: {command}\n'
                                 + data.decode(errors='replace')) from None
            if not part:
                raise GuestError(f'the guest ended during the command: {command}')
            data += part


class Monitor:
    """QEMU's control socket (QMP)."""

    def __init__(self, connection):
        self._file = connection.makefile('rwb', buffering=0)
        self._lines = connection.makefile('rb')
        self._lines.readline()
        self('qmp_capabilities')

    def __call__(self, command, **arguments):
        self._file.write(json.dumps({'execute': command, 'arguments': arguments}).encode() + b'\n')
        while True:
            line = self._lines.readline()
            if not line:
                raise GuestError(f'QEMU ended during the command: {command}')
            answer = json.loads(line)
            if 'error' in answer:
                raise GuestError(f'{command}: {answer["error"]["desc"]}')
            if 'return' in answer:
                return answer['return']


class Edges(threading.Thread):
    """Records the levels to which the guest sets the lines of its GPIO chip. QEMU's trace contains them."""

    LINE = re.compile(rb'setting output (\d+) to (\d)')

    def __init__(self, path, on_rise):
        super().__init__(daemon=True)
        self._path = path
        self._on_rise = on_rise
        self.seen = []  # (time.monotonic(), line, level)

    def run(self):
        with open(self._path, 'rb') as trace:
            for text in trace:
                found = self.LINE.search(text)
                if not found:
                    continue
                line, level = int(found[1]), int(found[2])
                before = self.level(line)
                self.seen.append((time.monotonic(), line, level))
                if line == TRIGGER_LINE and level == 1 and before == 0:
                    self._on_rise()

    def level(self, line=TRIGGER_LINE):
        """Returns the last level of a line; 0 if the guest has not set it."""
        return next((edge[2] for edge in reversed(self.seen) if edge[1] == line), 0)

    def rises(self, line=TRIGGER_LINE):
        return sum(1 for edge in self.seen if edge[1:] == (line, 1))


class Guest:
    """The emulated board. `cameras` are plugged in from the start: the first is the video sensor, the
    second the still sensor, which gets the pulses. The guest sees the folder `share` as /share."""

    def __init__(self, image, work, share, cameras, display=True):
        self._work = work
        self.log = os.path.join(work, 'serial.log')
        self.edges = Edges(self._path('trace'), cameras[1].pulse)
        os.mkfifo(self._path('trace'))
        self.edges.start()
        listeners = {name: Listener(self._path(name)) for name in ('shell', 'qmp')}
        for number, camera in enumerate(cameras):
            camera.plugged = True
            usbredir.serve(self._path(f'camera{number}'), camera.attach)
        self._began = time.monotonic()
        self._process = subprocess.Popen(
            self._command(image, share, len(cameras), display), stdin=subprocess.DEVNULL)
        try:
            self.monitor = Monitor(listeners['qmp'].accept(10))
            self._shell = Shell(listeners['shell'].accept(10))
            self.run('true', BOOT_LIMIT)
        except Exception:
            self.end()
            raise
        self.boot_seconds = time.monotonic() - self._began

    def _path(self, name):
        return os.path.join(self._work, name)

    def _command(self, image, share, cameras, display):
        command = [
            'qemu-system-aarch64', '-M', 'virt', '-cpu', 'cortex-a57', '-smp', '2', '-m', '2048',
            '-accel', 'tcg,thread=multi', '-nodefaults', '-display', 'none', '-no-reboot',
            '-serial', f'file:{self.log}',
            '-kernel', f'{image}/vmlinuz', '-initrd', f'{image}/initrd',
            # vt.global_cursor_default=0 avoids a blinking text cursor in the framebuffer.
            '-append', 'console=ttyAMA0 quiet panic=-1 mitigations=off vt.global_cursor_default=0'
            + ('' if display else ' modprobe.blacklist=virtio_gpu'),
            # A PCI disk, because virtio-mmio disks are numbered in reverse order.
            '-drive', f'if=none,id=disk,file={image}/root.img,format=raw,snapshot=on,cache=unsafe',
            '-device', 'virtio-blk-pci,drive=disk', '-device', 'virtio-rng-pci',
            '-virtfs', f'local,path={share},mount_tag=share,security_model=none',
            '-device', 'virtio-serial-pci',
            '-chardev', f'socket,id=shell,path={self._path("shell")}',
            '-device', 'virtserialport,chardev=shell,name=bed',
            '-qmp', f'unix:{self._path("qmp")}',
            '-trace', 'pl061_set_output', '-D', self._path('trace'),
            '-device', 'virtio-gpu-pci,xres=1280,yres=720',
            '-device', 'qemu-xhci,id=usb']
        for number in range(cameras):
            command += ['-chardev', f'socket,id=usb{number},path={self._path(f"camera{number}")}',
                        '-device', f'usb-redir,chardev=usb{number},bus=usb.0,port={number + 1}']
        return command

    def run(self, command, limit=60, check=True):
        """Runs a command line in the guest and returns its output. `check`: throws if its exit status is not 0."""
        result = self._shell.run(command, limit)
        if check and result.status != 0:
            raise GuestError(f'{command}: ended with {result.status}\n{result.output}')
        return result.output.strip()

    def status(self, command, limit=60):
        """Runs a command line in the guest and returns its exit status."""
        return self._shell.run(command, limit).status

    def wait_for(self, command, limit, pause=0.1):
        """Waits until a command succeeds. Returns the duration of the wait on the guest's clock [s]."""
        loop = (f'begin=$(date +%s%N); until {command}; do sleep {pause}; '
                f'[ $(( $(date +%s%N) - begin )) -lt {int(limit * 1e9)} ] || exit 1; done '
                '>/dev/null 2>&1; echo $(( $(date +%s%N) - begin ))')
        result = self._shell.run(f'( {loop} )', limit + 60)
        if result.status != 0:
            raise GuestError(f'this command did not succeed within {limit} s: {command}')
        return int(result.output.split()[-1]) / 1e9

    def clock(self):
        """Returns the time on the guest's monotonic clock [s]."""
        return float(self.run('cut -d " " -f 1 /proc/uptime'))

    def screen(self):
        """Returns the picture on the display: (width, height, bytes of R G B)."""
        path = self._path('screen.ppm')
        self.monitor('screendump', filename=path)
        with open(path, 'rb') as file:
            magic, size, depth = (file.readline() for _ in range(3))
            if (magic, depth) != (b'P6\n', b'255\n'):
                raise GuestError(f"QEMU's screendump has an unknown format: {magic!r}")
            width, height = map(int, size.split())
            return width, height, file.read()

    # QEMU can neither add nor remove this display while it runs, so the guest's driver is bound and
    # unbound instead.

    def plug_display(self):
        self.run('modprobe virtio_gpu; ' + EACH_DISPLAY
                 + '[[ -e $d/driver ]] || echo ${d##*/} >/sys/bus/virtio/drivers/virtio_gpu/bind; done')

    def unplug_display(self):
        self.run(EACH_DISPLAY + 'echo ${d##*/} >/sys/bus/virtio/drivers/virtio_gpu/unbind; done')

    def end(self):
        self._process.terminate()
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
