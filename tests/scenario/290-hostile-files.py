#!/usr/bin/env python3
"""Tests files that claim or contain far more data than their size suggests. mfard must need at most
[limits] memory_mb, at the start and when it reads its configuration again. It must read each file,
or refuse it in a line that names it.

Usage: 290-hostile-files.py MFARD"""

import json
import os
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

MB = 1 << 20
LEAST_MB = 64  # smallest value of limits.memory_mb
RUNNING_MB = 128
LONGEST = 20 * float(os.environ.get('MFAR_PATIENCE', '1'))  # largest duration of a run [s]
# Exit codes of daemon/exit_code.h: BadData, NoInput, BadConfig.
REFUSED = (65, 66, 78)

mfard = os.path.abspath(sys.argv[1])


def chunk(name, data):
    return struct.pack('>I', len(data)) + name + data + struct.pack('>I', zlib.crc32(name + data))


def png(width, height, between=b'', depth=8):
    """A black RGB picture. `between`: further chunks in front of the pixels."""
    pack = zlib.compressobj(9)
    row = bytes(1 + 3 * width * depth // 8)
    data = b''.join(pack.compress(row) for _ in range(height)) + pack.flush()
    header = struct.pack('>IIBBBBB', width, height, depth, 2, 0, 0, 0)
    return b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + between + chunk(b'IDAT', data) + chunk(b'IEND', b'')


def text_bomb(count):
    """`count` compressed text chunks of a PNG: 4 kB each in the file, 4 MB each in memory."""
    return count * chunk(b'zTXt', b'a\0\0' + zlib.compress(b'x' * 3_900_000, 9))


def glb(document, binary=b''):
    text = document if isinstance(document, bytes) else json.dumps(document).encode()
    text += b' ' * (-len(text) % 4)
    body = struct.pack('<II', len(text), 0x4E4F534A) + text
    if binary:
        binary += bytes(-len(binary) % 4)
        body += struct.pack('<II', len(binary), 0x004E4942) + binary
    return b'glTF' + struct.pack('<II', 2, 12 + len(body)) + body


def textured(picture):
    """A glTF file with one triangle, whose texture is `picture`."""
    points = struct.pack('<9f', 0, 0, 0, 1, 0, 0, 0, 1, 0)
    corners = struct.pack('<6f', 0, 0, 1, 0, 0, 1)
    view = lambda at, size: {'buffer': 0, 'byteOffset': at, 'byteLength': size}
    return glb({
        'asset': {'version': '2.0'},
        'buffers': [{'byteLength': 60 + len(picture)}],
        'bufferViews': [view(0, 36), view(36, 24), view(60, len(picture))],
        'accessors': [
            {'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3', 'min': [0, 0, 0], 'max': [1, 1, 0]},
            {'bufferView': 1, 'componentType': 5126, 'count': 3, 'type': 'VEC2'}],
        'images': [{'bufferView': 2, 'mimeType': 'image/png'}],
        'textures': [{'source': 0}],
        'materials': [{'pbrMetallicRoughness': {'baseColorTexture': {'index': 0}}}],
        'meshes': [{'primitives': [{'attributes': {'POSITION': 0, 'TEXCOORD_0': 1}, 'material': 0}]}],
        'nodes': [{'mesh': 0}], 'scenes': [{'nodes': [0]}], 'scene': 0,
    }, points + corners + picture)


def listed(count, of, text):
    return b'{"asset":{"version":"2.0"},"' + of + b'":[' + (count - 1) * (text + b',') + text + b']}'


SENSOR = '''sensor_type: camera
T_BS:
  cols: 4
  rows: 4
  data: [1.0, 0.0, 0.0, {x}, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]
rate_hz: 10
resolution: [{width}, {height}]
camera_model: pinhole
intrinsics: [{width}, {width}, {cx}, {cy}]
distortion_model: radial-tangential
distortion_coefficients: [0.0, 0.0, 0.0, 0.0]
'''


def write_recording(folder, pictures=3):
    for camera, width, height, x in (('cam0', 32, 24, 0.0), ('cam1', 64, 48, 0.014)):
        data = folder / camera / 'data'
        data.mkdir(parents=True)
        (folder / camera / 'sensor.yaml').write_text(
            SENSOR.format(width=width, height=height, x=x, cx=width / 2, cy=height / 2))
        first = data / '1000000000.png'
        first.write_bytes(png(width, height))
        names = [f'{1_000_000_000 + 100_000_000 * i}.png' for i in range(pictures)]
        for name in names[1:]:
            os.link(first, data / name)
        (folder / camera / 'data.csv').write_text(''.join(f'{name[:-4]},{name}\n' for name in names))


def peak_of(arguments):
    """Runs mfard. Returns its peak memory [MB], exit code and messages. The kernel reports at least
    the memory of this script, because mfard starts as a copy of it."""
    with open('said', 'w') as said:
        process = subprocess.Popen([mfard, *arguments], stdout=subprocess.DEVNULL, stderr=said)
        limit = time.monotonic() + LONGEST
        while True:
            ended, status, use = os.wait4(process.pid, os.WNOHANG)
            if ended:
                break
            if time.monotonic() > limit:
                process.kill()
            time.sleep(0.01)
    process.returncode = os.waitstatus_to_exitcode(status)
    return use.ru_maxrss / 1024, process.returncode, Path('said').read_text()


def environment(data):
    Path('sky.png').write_bytes(data)
    return '[light]\nenvironment = "sky.png"\n'


def model(data, objects=1):
    Path('thing.glb').write_bytes(data)
    return objects * '[[objects]]\nmodel = "thing.glb"\n'


def tags(text):
    Path('tags.toml').write_text(text)
    return '[pose]\nsource = "tags"\ntags = "tags.toml"\n'


CONFIGURATIONS = {
    'dots': lambda: 'seed' + '.a' * 50_000 + ' = 1\n',
    'brackets': lambda: 'a = ' + '[' * 900_000,
    'tables of dots': lambda: ''.join(f'a{i}{".b" * 28} = 1\n' for i in range(14_000)),
    'lists': lambda: 'a = [' + '[],' * 300_000 + ']\n',
    'keys': lambda: ''.join(f'k{i}=1\n' for i in range(99_000)),
    'tags': lambda: tags('[[tags]]\nid = 1\n' * 33_000),
    'texts in a PNG': lambda: environment(png(64, 32, text_bomb(60))),
    'large PNG': lambda: environment(png(8192, 4096)),
    'PNG that fits': lambda: environment(png(1000, 500, depth=16)),
    'large Radiance': lambda: environment(b'#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8192 +X 16384\n'),
    'large texture, eight times': lambda: model(textured(png(8192, 8192)), 8),
    'texture that fits, eight times': lambda: model(textured(png(800, 800)), 8),
    'texts in a texture': lambda: model(textured(png(64, 64, text_bomb(60)))),
    'JSON of lists': lambda: model(glb(b'{"a":[' + b'[],' * 400_000 + b'[]]}')),
    'JSON of nodes': lambda: model(glb(listed(400_000, b'nodes', b'{}'))),
    'JSON of few nodes': lambda: model(glb(listed(5_000, b'nodes', b'{}'))),
    'long buffer': lambda: model(glb({'asset': {'version': '2.0'}, 'buffers': [{'byteLength': 1 << 40}]})),
    'many vertices': lambda: model(glb({
        'asset': {'version': '2.0'}, 'scenes': [{'nodes': [0]}], 'nodes': [{'mesh': 0}],
        'meshes': [{'primitives': [{'attributes': {'POSITION': 0}}]}],
        'accessors': [{'componentType': 5126, 'count': 4_000_000_000, 'type': 'VEC3',
                       'min': [0, 0, 0], 'max': [0, 0, 0]}]})),
}


def appended(file, lines):
    with open(Path('bad') / file, 'a') as out:
        out.writelines(lines)


def poses():
    Path('bad/state_groundtruth_estimate0').mkdir()
    appended('state_groundtruth_estimate0/data.csv', (f'{10 ** 9 + i},0,0,0,1,0,0,0\n' for i in range(300_000)))


def rows():
    Path('bad/cam0/data.csv').unlink()
    appended('cam0/data.csv', (f'{10 ** 9 + i},1000000000.png\n' for i in range(150_000)))


def claimed_pictures():
    """Replaces all stills by PNG files of header and end only, which claim 16384x16384 pixels."""
    header = struct.pack('>IIBBBBB', 16384, 16384, 8, 2, 0, 0, 0)
    data = b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IEND', b'')
    for file in Path('bad/cam1/data').iterdir():
        file.unlink()
        file.write_bytes(data)
    Path('bad/cam1/sensor.yaml').write_text(SENSOR.format(width=16384, height=16384, x=0.014, cx=8192, cy=8192))


def bombs_for_pictures():
    for file in Path('bad/cam0/data').iterdir():
        file.unlink()
        file.write_bytes(png(32, 24, text_bomb(60)))


RECORDINGS = {
    'large pictures': claimed_pictures,
    'texts in pictures': bombs_for_pictures,
    'poses': poses,
    'rows': rows,
    'YAML list': lambda: appended('cam0/sensor.yaml', 'x: [' + '1,' * 400_000 + ']\n'),
    'shorter YAML list': lambda: appended('cam0/sensor.yaml', 'x: [' + '1,' * 49_000 + ']\n'),
    'YAML keys': lambda: appended('cam0/sensor.yaml', (f'k{i}: {{}}\n' for i in range(24_000))),
    'YAML anchors': lambda: appended('cam0/sensor.yaml', (f'k{i}: &a{i} 1\n' for i in range(24_000))),
}


def require(holds, what):
    if not holds:
        sys.exit(f'FAILED: {what}')


def check_run(name, arguments):
    peak, code, said = peak_of(arguments)
    print(f'{name}: {peak:.0f} MB, exit code {code}: {said[:140].splitlines()[:1]}')
    require(code in (0, *REFUSED), f'{name}: mfard ended with exit code {code}: {said[:500]}')
    require(peak <= LEAST_MB, f'{name}: {peak:.0f} MB were in use; memory_mb is {LEAST_MB}')
    if code != 0:
        require('hostile.toml' in said or 'bad' in said or 'tags.toml' in said, f'{name}: no file is named')


def at_the_start():
    for name, text in CONFIGURATIONS.items():
        Path('hostile.toml').write_text(text())
        with open('hostile.toml', 'a') as out:
            # Pictures of the default size would need more than LEAST_MB.
            small = 'width = 320\nheight = 240\n'
            out.write(f'\n[limits]\nmemory_mb = {LEAST_MB}\n[cameras.video]\n{small}[cameras.still]\n{small}')
        check_run(name, ['--check-config', '--config', 'hostile.toml'])
    for name, change in RECORDINGS.items():
        shutil.rmtree('bad', ignore_errors=True)
        write_recording(Path('bad'))
        change()
        Path('hostile.toml').write_text(
            f'display = "none"\n[engine]\nuse = "simd"\n[limits]\nmemory_mb = {LEAST_MB}\n')
        check_run(name, ['--config', 'hostile.toml', '--recording', 'bad', '--frames', '2'])


def while_it_runs():
    write_recording(Path('film'), 3000)
    sound = f'display = "none"\npace = "realtime"\n[engine]\nuse = "simd"\n[limits]\nmemory_mb = {RUNNING_MB}\n'
    config = Path('hostile.toml')
    config.write_text(sound)
    with open('said', 'w') as out:
        process = subprocess.Popen([mfard, '--config', 'hostile.toml', '--recording', 'film'],
                                   stdout=subprocess.DEVNULL, stderr=out)
    said = lambda: Path('said').read_text()
    answers = lambda: said().count('the old configuration stays') + said().count('read again')

    def wait_for(holds, what):
        limit = time.monotonic() + LONGEST
        while not holds():
            require(process.poll() is None, f'mfard ended with {process.returncode}: {said()[-1000:]}')
            require(time.monotonic() < limit, f'{what}: {said()[-1000:]}')
            time.sleep(0.01)

    try:
        wait_for(lambda: 'display ' in said(), 'mfard does not start')
        for name, text in CONFIGURATIONS.items():
            before = answers()
            # Renames a complete file. Otherwise mfard could read a partly written one.
            Path('next.toml').write_text(text() + '\n' + sound.split('\n', 2)[2])
            os.replace('next.toml', config)
            process.send_signal(signal.SIGHUP)
            wait_for(lambda: answers() > before, f'{name}: no answer')
        status = Path(f'/proc/{process.pid}/status').read_text()
        peak = int(status.split('VmHWM:')[1].split()[0]) / 1024
        print(f'configuration read again {answers()} times: {peak:.0f} MB')
        require(peak <= RUNNING_MB, f'{peak:.0f} MB were in use; memory_mb is {RUNNING_MB}')
        process.terminate()
        require(process.wait(LONGEST) == 0, f'mfard ended with exit code {process.returncode}')
    finally:
        process.kill()


with tempfile.TemporaryDirectory() as work:
    os.chdir(work)
    at_the_start()
    while_it_runs()
    os.chdir('/')
