"""An emulated USB camera. It sends pictures at a rate, or one for each trigger pulse, with faults on demand."""

import struct
import threading
import time
from collections import deque

import usbredir
import uvc

END_OF_PICTURE = 0x8e  # flags of the UVC header: end of picture, both times present, end of header
ERROR = 0x40


class Fault:
    """A fault of one picture. `seconds`: delay of a late picture."""

    def __init__(self, kind, seconds=0.0):
        if kind not in ('missing', 'late', 'torn', 'long', 'error'):
            raise ValueError(f'unknown fault: {kind}')
        self.kind = kind
        self.seconds = seconds


class Camera:
    """A camera. `picture(time, number)` gives the pixels of a picture; `time` is in seconds since `epoch`
    (a value of time.monotonic()).

    With a rate above 0, it sends pictures at this rate, and their numbers count from the epoch. Pictures
    that it cannot send in time are skipped, as a real sensor skips them; their numbers are missing. With
    rate 0, it sends one picture for each pulse(), and the numbers count the pulses from 1.
    """

    def __init__(self, name, picture, rate, epoch):
        width, height = picture.size
        self._picture = picture
        self._rate = rate
        self._epoch = epoch
        self._description = uvc.UvcDescription(name, f'{width}x{height}', width, height,
                                               rate or 10)
        self._changed = threading.Condition()
        self._requests = deque()
        self._pulses = deque()
        self._faults = deque()
        self._streaming = False
        self._generation = 0  # number of the stream; pictures of an older stream are not sent
        self._toggle = 0
        self.pulses = 0
        self.ignored_pulses = 0
        self.sent = []  # (number, time.monotonic() of its last byte)
        self.plugged = False
        self.link = None
        threading.Thread(target=self._stream, daemon=True).start()

    # Functions that scenarios and the guest call.

    def attach(self, connection):
        self.link = usbredir.UsbRedirLink(connection, self)
        return self

    def plug(self):
        self.plugged = True
        self.link.plug(uvc.DEVICE_CLASS, uvc.VENDOR, uvc.PRODUCT, uvc.BULK_PACKET)

    def unplug(self):
        self._stop()
        self.plugged = False
        self.link.unplug()

    def pulse(self):
        with self._changed:
            self.pulses += 1
            if self._streaming:
                self._pulses.append((self.pulses, time.monotonic()))
                self._changed.notify_all()
            else:
                self.ignored_pulses += 1

    def fault(self, kind, seconds=0.0, count=1):
        """Gives the next `count` pictures this fault."""
        with self._changed:
            self._faults.extend([Fault(kind, seconds)] * count)

    @property
    def streaming(self):
        return self._streaming

    # Functions that UsbRedirLink calls.

    def connected(self):
        if self.plugged:
            self.plug()

    def bulk_requested(self, ident, length):
        with self._changed:
            self._requests.append((ident, length))
            self._changed.notify_all()

    def bulk_cancelled(self, ident):
        with self._changed:
            for request in self._requests:
                if request[0] == ident:
                    self._requests.remove(request)
                    return True
        return False

    def control(self, kind, request, value, index, _data):
        if kind & 0x60 == 0x20:  # a class request
            if index & 0xff != 1:
                return None
            if (kind, request, value >> 8) == (0x21, uvc.SET_CUR, uvc.COMMIT):
                self._start()
            return self._description.stream_request(kind, request, value >> 8)
        if (kind, request, index) == (0x02, 1, 0x81):  # the driver clears the endpoint: end of the stream
            self._stop()
        return self._description.standard_request(kind, request, value)

    def _start(self):
        with self._changed:
            self._streaming = True
            self._generation += 1
            self._pulses.clear()
            self._changed.notify_all()

    def _stop(self):
        with self._changed:
            self._streaming = False
            self._generation += 1
            self._requests.clear()
            self._changed.notify_all()

    # The thread that sends pictures.

    def _stream(self):
        while True:
            number, moment, generation = self._next()
            fault = self._next_fault()
            if fault and fault.kind == 'missing':
                continue
            pixels = self._picture(moment - self._epoch, number)
            if fault and fault.kind == 'late':
                time.sleep(fault.seconds)
            try:
                if self._deliver(self._payload(pixels, fault), generation):
                    self.sent.append((number, time.monotonic()))
            except (BrokenPipeError, ConnectionResetError):
                return  # the guest has ended

    def _next(self):
        """Waits until the next picture is due. Returns its number, its time and the number of the stream."""
        with self._changed:
            while True:
                while not self._streaming:
                    self._changed.wait()
                generation = self._generation
                if self._rate == 0:
                    if self._pulses:
                        return (*self._pulses.popleft(), generation)
                    self._changed.wait()
                    continue
                now = time.monotonic()
                number = int((now - self._epoch) * self._rate) + 1
                moment = self._epoch + number / self._rate
                self._changed.wait_for(lambda: self._generation != generation, moment - now)
                if self._generation == generation:
                    return number, moment, generation

    def _next_fault(self):
        with self._changed:
            return self._faults.popleft() if self._faults else None

    def _payload(self, pixels, fault):
        self._toggle ^= 1
        flags = END_OF_PICTURE | self._toggle
        if fault and fault.kind == 'error':
            flags |= ERROR
        ticks = int(time.monotonic() * 48e6) & 0xffffffff
        header = struct.pack('<BBIIH', uvc.HEADER, flags, ticks, ticks, 0)
        if fault and fault.kind == 'torn':
            pixels = pixels[:len(pixels) // 2]
        if fault and fault.kind == 'long':
            pixels = bytes(pixels) + bytes(4096)
        return header + bytes(pixels)

    def _deliver(self, payload, generation):
        payload = memoryview(payload)
        offset = 0
        while offset < len(payload):
            with self._changed:
                self._changed.wait_for(
                    lambda: self._requests or self._generation != generation)
                if self._generation != generation:
                    return False
                ident, length = self._requests.popleft()
            self.link.send_bulk(ident, payload[offset:offset + length])
            offset += length
        return True
