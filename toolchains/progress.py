"""Shows the progress of a long command on standard error, as base/progress.h does."""
import sys
import time


class Progress:
    """Rewrites one line on a terminal; otherwise prints a line every ten seconds."""

    def __init__(self, out=sys.stderr, clock=time.monotonic):
        self._out, self._clock = out, clock
        self._begin = self._line = clock()

    def show(self, done, count, what):
        """Shows that `done` parts of `count` are done, and that `what` is next."""
        now = self._clock()
        text = f'{100 * done // max(count, 1):3} %  {what}; {now - self._begin:.0f} s'
        if self._out.isatty():
            print(f'\r\x1b[K{text}', end='', file=self._out, flush=True)
        elif now >= self._line + 10:
            self._line = now
            print(text, file=self._out, flush=True)

    def clear(self):
        """Erases the line, so that other output can follow."""
        if self._out.isatty():
            print('\r\x1b[K', end='', file=self._out, flush=True)
