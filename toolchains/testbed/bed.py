#!/usr/bin/env python3
"""Boots the emulated board, installs a package on it and runs the scenarios. See README.md."""

import argparse
import importlib.util
import itertools
import os
import shutil
import sys
import tempfile
import time
import traceback
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parent.parent))
from progress import Progress  # noqa: E402 (needs the line above)

from camera import Camera
from guest import Guest, GuestError
from pictures import Film, Pattern, film_times

HERE = Path(__file__).resolve().parent
VIDEO, STILL = (640, 480), (2304, 1728)

# Configuration of mfard with the emulated board's devices. Further keys of [cameras.trigger] may
# follow.
DEVICES = '''source = "cameras"
[cameras.video]
camera = "Bed video"
[cameras.still]
camera = "Bed still"
[cameras.trigger]
chip = "/dev/gpiochip0"
line = "5"
'''

# Configuration for scenarios in which mfard requests no stills.
CAMERAS = DEVICES + '''[pose]
source = "none"
[trigger]
mode = "off"
'''


def pictures(options):
    """The pictures that both cameras send of the same scene: films of a recording, or test patterns."""
    if not options.film:
        return Pattern(*VIDEO), Pattern(*STILL)
    files = options.film / 'video', options.film / 'still'
    span = min(film_times(file)[-1] for file in files)
    return Film(files[0], *VIDEO, span), Film(files[1], *STILL, span)


class Bed:
    """The argument of a scenario: the guest (the emulated board) and the cameras at it."""

    devices, cameras = DEVICES, CAMERAS

    def __init__(self, options, boot):
        self.work = tempfile.mkdtemp(prefix='mfar-bed.')
        self.share = Path(self.work, 'share')
        self.share.mkdir()
        shutil.copy(options.package, self.share / 'mfar.deb')
        for file in options.programs.iterdir() if options.programs else ():
            if file.is_file() and os.access(file, os.X_OK):
                shutil.copy(file, self.share)
        video, still = pictures(options)
        epoch = time.monotonic()
        self.video = Camera('Bed video', video, 30, epoch)
        self.still = Camera('Bed still', still, 0, epoch)
        self._pictures = (video, still)
        self.guest = Guest(str(options.image), self.work, str(self.share),
                           (self.video, self.still), **boot)
        self.run = self.guest.run
        self.wait_for = self.guest.wait_for

    def end(self):
        self.guest.end()
        shutil.rmtree(self.work)

    def numbered(self, on):
        """Sets whether films draw the pictures' numbers. Patterns always do."""
        for picture in self._pictures:
            picture.numbered = on

    def held(self, on):
        """Sets whether films show only their first picture."""
        for picture in self._pictures:
            picture.held = on

    def journal(self, since=None):
        """Returns the messages of mfard.service, without times. `since`: a time from now()."""
        return self.run('journalctl --no-pager -q -u mfard -o cat'
                        + (f' --since "{since}"' if since else ''))

    def now(self):
        """Returns the guest's time of day, in the format for journal()."""
        return self.run('date "+%F %T.%6N"')

    def property(self, name):
        """Returns the value of a property of mfard.service, from `systemctl show`."""
        return self.run(f'systemctl show mfard --value -p {name}')

    def fresh_service(self, config, drop_in=''):
        """Stops mfard and starts it with this configuration. Returns the time until it was ready [s], on
        the guest's clock. `drop_in` is added to the unit's section [Service]."""
        self.run('systemctl stop mfard; systemctl reset-failed mfard; true')
        self.write('/etc/mfar/mfard.toml', config)
        self.write('/etc/systemd/system/mfard.service.d/50-scenario.conf', '[Service]\n' + drop_in)
        self.run('systemctl daemon-reload')
        begin = self.guest.clock()
        self.run('systemctl start mfard', 120)
        return self.guest.clock() - begin

    def wait_for_pictures(self, count, limit=120):
        """Waits until the service has shown this number of pictures. The first pictures take up to half
        a minute in the guest, because shaders are compiled; meanwhile mfard does not answer."""
        self.wait_for(f'(( $(mfarctl status | sed -n "s/^frames *//p") >= {count} ))', limit)

    def write(self, path, text):
        """Writes a file in the guest."""
        Path(self.share, 'written').write_text(text, encoding='utf-8')
        self.run(f'cp /share/written {path}')


def scenario_files(only):
    files = sorted((HERE / 'scenarios').glob('[0-9]*.py'))
    if only:
        files = [f for f in files if any(f.name.startswith(o) for o in only)]
        if not files:
            sys.exit(f'unknown scenario: {" ".join(only)}')
    return files


def load(file):
    spec = importlib.util.spec_from_file_location(file.stem.replace('-', '_'), file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.name = file.stem
    return module


def run_scenario(bed, scenario):
    begin = time.monotonic()
    since = bed.now()
    try:
        scenario.run(bed)
        fault = None
    except Exception:  # the other scenarios run after any failure
        fault = traceback.format_exc()
    took = time.monotonic() - begin
    print(f'{"ok" if fault is None else "FAILED":8}{scenario.name:40}{took:7.1f} s', flush=True)
    if fault:
        print(fault)
        try:
            print(bed.run(f'systemctl --no-pager -n 0 status mfard; journalctl --no-pager -q '
                          f'-u mfard -o short-monotonic --since "{since}"', check=False))
        except GuestError as error:
            print(error)
    return fault is None


def install(bed):
    """Installs the package with a configuration of the cameras, so that the service can start."""
    begin = time.monotonic()
    bed.run('mkdir -p /etc/mfar /etc/systemd/system/mfard.service.d')
    bed.write('/etc/mfar/mfard.toml', CAMERAS)
    # The first picture takes up to half a minute in the guest, because shaders are compiled.
    bed.write('/etc/systemd/system/mfard.service.d/10-emulated.conf', '[Service]\nWatchdogSec=120\n')
    bed.run('dpkg --force-confold -i /share/mfar.deb', 180)
    print(f'ok      {"install":40}{time.monotonic() - begin:7.1f} s', flush=True)


def run_boot(options, boot, scenarios, show):
    """Starts the guest with the options `boot` and runs all scenarios that need them. Returns (passed,
    failed). Calls `show` before each step, with the number of finished scenarios and the name of the
    step."""
    show(0, 'boot')
    print(f'boot    {boot or ""}', flush=True)
    try:
        bed = Bed(options, boot)
    except (GuestError, OSError) as error:
        print(f'FAILED  boot: {error}')
        return 0, len(scenarios)
    try:
        print(f'ok      {"boot":40}{bed.guest.boot_seconds:7.1f} s', flush=True)
        show(0, 'install')
        install(bed)
        passed = 0
        for done, scenario in enumerate(scenarios):
            show(done, scenario.name)
            passed += run_scenario(bed, scenario)
        return passed, len(scenarios) - passed
    except GuestError as error:
        print(f'FAILED  {error}')
        return 0, len(scenarios)
    finally:
        bed.end()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--image', type=Path, required=True, help='folder made by image.sh')
    parser.add_argument('--package', type=Path, required=True, help='the arm64 package (.deb)')
    parser.add_argument('--programs', type=Path,
                        help='folder with arm64 programs, which the guest sees in /share')
    parser.add_argument('--film', type=Path, help='folder made by mfar-film; without it, the cameras send test patterns')
    parser.add_argument('scenario', nargs='*', help='numbers of the scenarios to run (default: all)')
    options = parser.parse_args()

    begin = time.monotonic()
    scenarios = [load(file) for file in scenario_files(options.scenario)]
    wish = lambda scenario: sorted(getattr(scenario, 'BOOT', {}).items())
    passed = failed = 0
    progress = Progress()
    for boot, group in itertools.groupby(sorted(scenarios, key=wish), key=wish):
        before = passed + failed
        show = lambda done, what: progress.show(before + done, len(scenarios), what)
        good, bad = run_boot(options, dict(boot), list(group), show)
        passed, failed = passed + good, failed + bad
    print(f'took {time.monotonic() - begin:.0f} s on {os.cpu_count()} processors')
    print(f'{passed} scenarios passed, {failed} failed')
    sys.exit(1 if failed else 0)


if __name__ == '__main__':
    main()
