"""Reads PNG files with 8 bits per channel and the channels R G B."""

import struct
import zlib


def read_png(path):
    """Returns (width, height, bytes of R G B)."""
    with open(path, 'rb') as file:
        data = file.read()
    assert data[:8] == b'\x89PNG\r\n\x1a\n', f'{path}: is not a PNG file'
    at, packed, header = 8, b'', None
    while at < len(data):
        length, kind = struct.unpack('>I4s', data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b'IHDR':
            header = struct.unpack('>IIBBBBB', body)
        elif kind == b'IDAT':
            packed += body
        at += length + 12
    width, height = header[:2]
    assert header[2:] == (8, 2, 0, 0, 0), f'{path}: expected 8 bits per channel and R G B, but the header is {header}'
    return width, height, unfiltered(zlib.decompress(packed), 3 * width, height)


def unfiltered(data, stride, height):
    """Undoes the filter of each row, see the PNG specification, 9.2."""
    out = bytearray()
    above = bytes(stride)
    for y in range(height):
        start = y * (stride + 1)
        row = bytearray(data[start + 1:start + 1 + stride])
        predict = PREDICTORS[data[start]]
        if predict:
            for i in range(stride):
                left, corner = (row[i - 3], above[i - 3]) if i >= 3 else (0, 0)
                row[i] = row[i] + predict(left, above[i], corner) & 255
        out += row
        above = row
    return bytes(out)


def paeth(left, up, corner):
    guess = left + up - corner
    return min((abs(guess - left), 0, left), (abs(guess - up), 1, up),
               (abs(guess - corner), 2, corner))[2]


PREDICTORS = (None, lambda left, up, corner: left, lambda left, up, corner: up,
              lambda left, up, corner: (left + up) // 2, paeth)
