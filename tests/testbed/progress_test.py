#!/usr/bin/env python3
"""Tests of toolchains/progress.py and progress.sh."""

import io
import os
import pty
import subprocess
import sys
import unittest
from pathlib import Path

TOOLCHAINS = Path(__file__).resolve().parents[2] / 'toolchains'
sys.path.insert(0, str(TOOLCHAINS))

from progress import Progress  # noqa: E402


class Output(io.StringIO):
    def __init__(self, terminal):
        super().__init__()
        self.isatty = lambda: terminal


def shown_by_shell(commands, terminal):
    """Runs commands in bash with progress.sh. Returns what they write to standard error, which is a
    terminal or a pipe."""
    script = f'. {TOOLCHAINS}/progress.sh; {commands}'
    if not terminal:
        return subprocess.run(['bash', '-euc', script], stderr=subprocess.PIPE, check=True).stderr.decode()
    main, other = pty.openpty()
    subprocess.run(['bash', '-euc', script], stderr=other, check=True)
    os.close(other)
    with os.fdopen(main, 'rb') as file:
        return file.read1().decode()


class PythonProgress(unittest.TestCase):
    def test_terminal_has_one_line(self):
        out = Output(True)
        progress = Progress(out)
        progress.show(1, 4, 'install')
        progress.clear()
        self.assertEqual(out.getvalue(), '\r\x1b[K 25 %  install; 0 s\r\x1b[K')

    def test_pipe_gets_a_line_every_ten_seconds(self):
        out, now = Output(False), [0]
        progress = Progress(out, lambda: now[0])
        for now[0] in range(0, 25):
            progress.show(now[0], 50, 'scenario')
        progress.clear()
        self.assertEqual(out.getvalue(), ' 20 %  scenario; 10 s\n 40 %  scenario; 20 s\n')

    def test_without_work_there_is_no_error(self):
        Progress(Output(True)).show(0, 0, 'nothing')


class ShellProgress(unittest.TestCase):
    def test_terminal_has_one_line(self):
        self.assertEqual(shown_by_shell('progress 1 3 fuzz; clearProgress', True),
                         '\r\x1b[K 33 %  fuzz\r\x1b[K')

    def test_pipe_gets_a_line_every_ten_seconds(self):
        self.assertEqual(shown_by_shell('progress 1 3 fuzz; progressLine=0; progress 2 3 fuzz; '
                                        'progress 3 3 fuzz; clearProgress', False), ' 66 %  fuzz\n')

    def test_ticker_ends_with_its_shell(self):
        begin = 'tick 100 fuzz 2>/dev/null & echo $! >&2'
        pid = int(shown_by_shell(begin, False))
        with self.assertRaises(ProcessLookupError):
            for _ in range(300):
                os.kill(pid, 0)
                subprocess.run(['sleep', '0.01'], check=True)


if __name__ == '__main__':
    unittest.main()
