"""Descriptors and requests of a USB camera (USB Video Class 1.0) with one size of NV12 pictures.

The stream has one alternate setting with a bulk endpoint. A picture is one payload: a header of 12
bytes and the pixels. A packet shorter than the others ends the payload.
"""

import struct

VENDOR = 0x1d6b  # Linux Foundation, product "webcam gadget"
PRODUCT = 0x0102
DEVICE_CLASS = (0xef, 2, 1)  # several interfaces, grouped by an association descriptor
BULK_PACKET = 512
NV12 = b'NV12' + bytes.fromhex('00001000800000aa00389b71')
HEADER = 12

SET_CUR, GET_CUR, GET_LEN, GET_INFO = 0x01, 0x81, 0x85, 0x86
PROBE, COMMIT = 1, 2


def descriptor(kind, *fields):
    """A USB descriptor. Each field is a bytes object, a number (one byte), or (number, struct format)."""
    body = b''.join(f if isinstance(f, bytes) else struct.pack('<' + f[1], f[0]) if
                    isinstance(f, tuple) else bytes([f]) for f in fields)
    return bytes([len(body) + 2, kind]) + body


def u16(value):
    return (value, 'H')


def u32(value):
    return (value, 'I')


class UvcDescription:
    """Descriptors of a camera. `rate`: frames per second."""

    def __init__(self, name, serial, width, height, rate):
        self.frame_size = width * height * 3 // 2
        self.interval = round(1e7 / rate)  # in 100 ns
        bits = min(int(self.frame_size * 8 * rate), 0xffffffff)
        self.device = descriptor(1, u16(0x0200), *DEVICE_CLASS, 64, u16(VENDOR), u16(PRODUCT),
                                 u16(0x0100), 1, 2, 3, 1)
        body = (descriptor(11, 0, 2, 14, 3, 0, 0)  # interfaces 0 and 1 form one video function
                + self._control_interface() + self._stream_interface(width, height, bits))
        self.configuration = descriptor(2, u16(9 + len(body)), 2, 1, 0, 0x80, 50) + body
        self.strings = [b'\x04\x03\x09\x04'] + [
            descriptor(3, text.encode('utf-16le')) for text in ('mfar test bed', name, serial)]
        self.probe = struct.pack('<HBBIHHHHHII', 1, 1, 1, self.interval, 0, 0, 0, 0, 0,
                                 self.frame_size, HEADER + self.frame_size)

    @staticmethod
    def _control_interface():
        camera = descriptor(0x24, 2, 1, u16(0x0201), 0, 0, u16(0), u16(0), u16(0), 3, bytes(3))
        output = descriptor(0x24, 3, 2, u16(0x0101), 0, 1, 0)
        header = descriptor(0x24, 1, u16(0x0100), u16(13 + len(camera) + len(output)),
                            u32(48000000), 1, 1)
        return descriptor(4, 0, 0, 0, 14, 1, 0, 0) + header + camera + output

    def _stream_interface(self, width, height, bits):
        picture = descriptor(0x24, 4, 1, 1, NV12, 12, 1, 0, 0, 0, 0)
        frame = descriptor(0x24, 5, 1, 0, u16(width), u16(height), u32(bits), u32(bits),
                           u32(self.frame_size), u32(self.interval), 1, u32(self.interval))
        colour = descriptor(0x24, 13, 1, 1, 4)  # BT.601
        length = 14 + len(picture) + len(frame) + len(colour)
        header = descriptor(0x24, 1, 1, u16(length), 0x81, 0, 2, 0, 0, 0, 1, 0)
        return (descriptor(4, 1, 0, 1, 14, 2, 0, 0) + header + picture + frame + colour
                + descriptor(5, 0x81, 2, u16(BULK_PACKET), 0))

    def standard_request(self, kind, request, value):
        """Returns the answer to a standard USB request, or None if the camera does not support it."""
        if (kind, request) == (0x80, 6):
            which, number = value >> 8, value & 255
            if which == 3 and number < len(self.strings):
                return self.strings[number]
            return {1: self.device, 2: self.configuration}.get(which)
        if (kind, request) == (0x80, 0):
            return b'\0\0'
        if (kind, request) == (0x81, 10):
            return b'\0'
        return b'' if kind in (0x00, 0x01, 0x02) else None

    def stream_request(self, kind, request, selector):
        """Returns the answer to a request about the stream's only format, or None if the selector is unknown."""
        if selector not in (PROBE, COMMIT):
            return None
        if kind == 0x21 and request == SET_CUR:
            return b''
        return {GET_INFO: b'\x03', GET_LEN: struct.pack('<H', len(self.probe))}.get(
            request, self.probe)
