"""Pictures of the emulated cameras: functions from a time to a picture in NV12.

The top rows can show the picture's number: 32 blocks side by side, bit 0 first; white stands for 1.
"""

import bisect
import mmap

NUMBER_ROWS = 16
NUMBER_BITS = 32
BLACK, WHITE = 16, 235
OTHER_LOWEST_BIT = bytes(value ^ 1 for value in range(256))


def number_rows(number, width):
    block = width // NUMBER_BITS
    row = b''.join(bytes([WHITE if number >> bit & 1 else BLACK]) * block
                   for bit in range(NUMBER_BITS))
    return row.ljust(width, bytes([BLACK])) * NUMBER_ROWS


class Pattern:
    """A gradient that moves to the left, 60 pixels per second."""

    def __init__(self, width, height):
        self.size = (width, height)
        ramp = bytes(16 + abs((x & 255) - 128) for x in range(width + 256))
        self._ramps = [ramp[shift:shift + width] for shift in range(256)]

    def __call__(self, time, number):
        width, height = self.size
        luma = self._ramps[int(time * 60) & 255] * (height - NUMBER_ROWS)
        return number_rows(number, width) + luma + b'\x80' * (width * height // 2)


class Film:
    """Pictures from a file of mfar-film, which contains them one after the other, with their times [s]
    in a second file. The film runs forwards up to the time `span`, then backwards, and so on, so that
    the view never jumps. Films with the same span stay synchronous. `numbered`: the picture's number is
    drawn into it. `held`: only the first picture is shown. If the number is odd, the lowest bits of this
    picture's first column are inverted, because mfard reports a camera that repeats exactly the same
    picture."""

    held = False

    def __init__(self, path, width, height, span, numbered=False):
        self.size = (width, height)
        self._span = span
        self.numbered = numbered
        self._bytes = width * height * 3 // 2
        self._times = film_times(path)
        with open(f'{path}.nv12', 'rb') as file:
            self._data = memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
        if len(self._data) != len(self._times) * self._bytes:
            raise ValueError(f'{path}.nv12: its size is not that of {len(self._times)} pictures of {width}x{height}')

    def index(self, time):
        """Returns the index of the picture that is nearest to this time."""
        phase = time % (2 * self._span)
        moment = min(phase, 2 * self._span - phase)
        after = bisect.bisect_left(self._times, moment)
        near = range(max(after - 1, 0), min(after + 1, len(self._times)))
        return min(near, key=lambda i: abs(self._times[i] - moment))

    def __call__(self, time, number):
        start = self.index(0 if self.held else time) * self._bytes
        picture = self._data[start:start + self._bytes]
        width, height = self.size
        if self.held and number % 2:
            picture = bytearray(picture)
            column = slice(0, width * height, width)
            picture[column] = picture[column].translate(OTHER_LOWEST_BIT)
        if not self.numbered:
            return picture
        return number_rows(number, width) + bytes(picture[NUMBER_ROWS * width:])


def film_times(path):
    with open(f'{path}.times', encoding='ascii') as file:
        return [float(line) for line in file]
