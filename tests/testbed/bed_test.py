#!/usr/bin/env python3
"""Tests the emulated cameras of the test bed without a guest: their pictures and their faults."""

import struct
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / 'toolchains' / 'testbed'))

import uvc  # noqa: E402
from camera import Camera, Fault  # noqa: E402
from pictures import NUMBER_ROWS, Film, Pattern, number_rows  # noqa: E402

SIZE = (64, 48)
FRAME = 64 * 48 * 3 // 2


def read_number(picture, width):
    return sum(1 << bit for bit in range(32) if picture[bit * (width // 32)] > 128)


class FakeLink:
    """Requests data from a camera again and again, and joins the data to pictures."""

    def __init__(self, camera):
        self.camera = camera
        self.payloads = [b'']

    def send_bulk(self, ident, data, status=0):
        self.payloads[-1] += bytes(data)
        if len(data) < 512:
            self.payloads.append(b'')
        self.camera.bulk_requested(ident, 512)

    def begin(self):
        self.camera.link = self
        self.camera.control(0x21, uvc.SET_CUR, uvc.COMMIT << 8, 1, b'')
        self.camera.bulk_requested(1, 512)

    def wait_for(self, count):
        end = time.monotonic() + 10
        while len(self.payloads) <= count:
            assert time.monotonic() < end, f'only {len(self.payloads) - 1} of {count} pictures came'
            time.sleep(0.005)
        return self.payloads[:count]


class Pictures(unittest.TestCase):
    def test_a_pattern_shows_its_number(self):
        for number in (0, 1, 0x80000001, 0xdeadbeef):
            self.assertEqual(read_number(number_rows(number, 640), 640), number)
        picture = Pattern(*SIZE)(1.5, 77)
        self.assertEqual(len(picture), FRAME)
        self.assertEqual(read_number(picture, SIZE[0]), 77)

    def test_films_of_the_same_length_repeat_in_step(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, times in (('a', (0, 0.1, 0.2, 0.3)), ('b', (0, 0.3))):
                Path(folder, name + '.nv12').write_bytes(
                    b''.join(bytes([i]) * FRAME for i in range(len(times))))
                Path(folder, name + '.times').write_text(''.join(f'{t}\n' for t in times))
            a, b = (Film(Path(folder, name), *SIZE, 0.3) for name in 'ab')
            shown = [(a(t, 1)[0], b(t, 1)[0]) for t in (0, 0.11, 0.29, 0.31, 0.52, 0.6, 0.61, 0.9)]
            self.assertEqual(shown, [(0, 0), (1, 0), (3, 1), (3, 1), (1, 0), (0, 0), (0, 0),
                                     (3, 1)])
            a.held = True
            self.assertEqual([a(t, 2)[0] for t in (0, 0.11, 0.29)], [0, 0, 0])
            # Successive pictures of a held film differ in the first column of luma.
            row = bytes([1]) + bytes(SIZE[0] - 1)
            self.assertEqual(a(0.11, 3), SIZE[1] * row + bytes(FRAME - len(SIZE[1] * row)))

    def test_a_numbered_film_is_unchanged_below_the_number(self):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, 'a.nv12').write_bytes(bytes([9]) * FRAME)
            Path(folder, 'a.times').write_text('0\n')
            picture = Film(Path(folder, 'a'), *SIZE, 1, numbered=True)(0.4, 5)
            self.assertEqual(read_number(picture, SIZE[0]), 5)
            self.assertEqual(picture[NUMBER_ROWS * SIZE[0]:],
                             bytes([9]) * (FRAME - NUMBER_ROWS * SIZE[0]))

    def test_a_film_of_incomplete_pictures_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, 'a.nv12').write_bytes(bytes(FRAME + 1))
            Path(folder, 'a.times').write_text('0\n')
            with self.assertRaises(ValueError):
                Film(Path(folder, 'a'), *SIZE, 1)


class Descriptors(unittest.TestCase):
    def test_the_lengths_of_all_descriptors_add_up_to_the_total(self):
        configuration = uvc.UvcDescription('name', 'serial', 640, 480, 30).configuration
        self.assertEqual(struct.unpack_from('<H', configuration, 2)[0], len(configuration))
        offset = 0
        while offset < len(configuration):
            self.assertGreater(configuration[offset], 1)
            offset += configuration[offset]
        self.assertEqual(offset, len(configuration))


class Cameras(unittest.TestCase):
    def setUp(self):
        self.camera = Camera('test', Pattern(*SIZE), 0, time.monotonic())
        self.link = FakeLink(self.camera)

    def numbers(self, payloads):
        return [read_number(p[uvc.HEADER:], SIZE[0]) for p in payloads]

    def test_a_camera_sends_one_picture_per_pulse(self):
        self.link.begin()
        for _ in range(3):
            self.camera.pulse()
        payloads = self.link.wait_for(3)
        self.assertEqual(self.numbers(payloads), [1, 2, 3])
        self.assertEqual({len(p) for p in payloads}, {uvc.HEADER + FRAME})
        flags = [p[1] for p in payloads]
        self.assertEqual(flags, [0x8f, 0x8e, 0x8f])  # bit 0, the parity, changes after each picture

    def test_a_pulse_before_the_stream_starts_is_lost(self):
        self.camera.pulse()
        self.link.begin()
        self.camera.pulse()
        self.assertEqual(self.numbers(self.link.wait_for(1)), [2])
        self.assertEqual(self.camera.ignored_pulses, 1)

    def test_each_fault_affects_one_picture_in_the_given_order(self):
        self.link.begin()
        for kind in ('missing', 'torn', 'long', 'error'):
            self.camera.fault(kind)
        for _ in range(5):
            self.camera.pulse()
        torn, long, error, good = self.link.wait_for(4)
        self.assertEqual(self.numbers((torn, long, error, good)), [2, 3, 4, 5])
        self.assertLess(len(torn), uvc.HEADER + FRAME)
        self.assertGreater(len(long), uvc.HEADER + FRAME)
        self.assertEqual(error[1] & 0x40, 0x40)
        self.assertEqual((len(good), good[1] & 0x40), (uvc.HEADER + FRAME, 0))

    def test_unknown_fault_is_refused(self):
        with self.assertRaises(ValueError):
            Fault('lost')

    def test_a_pulse_after_the_end_of_the_stream_is_lost(self):
        self.link.begin()
        self.camera.control(0x02, 1, 0, 0x81, b'')
        self.camera.pulse()
        self.link.begin()
        self.camera.pulse()
        self.assertEqual(self.numbers(self.link.wait_for(1)), [2])


if __name__ == '__main__':
    unittest.main()
