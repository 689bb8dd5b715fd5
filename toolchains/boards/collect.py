"""Runs mfar-frame-work, which measures the work of frames on a GPU and on processors, and their time on this
machine."""
import json
import os
import re
import subprocess
import tempfile

import cpu_model

CASES = ('moving', 'rest')
TIMED = 20  # number of timed frames
# For each case, the numbers of frames of two runs, which differ by one. frame_counts() counts the executed blocks of
# instructions in both runs and subtracts the counts. The result is the work of one frame, without the work at the
# program's start. At rest, frames are typical only after the first few.
FRAMES = {'moving': (2, 3), 'rest': (5, 6)}


def run(command, **environment):
    result = subprocess.run(command, env=dict(os.environ, **environment), capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise RuntimeError(f'{" ".join(command)} ended with exit code {result.returncode}: {result.stderr[-500:]}')
    return result.stdout


def gpu_work(program, case, width):
    """Returns the draws and dispatches of a frame on GLES, in their order."""
    return json.loads(run([program, '--engine', 'gles', '--case', case, '--width', str(width), '--frames',
                           str(FRAMES[case][1])], MFAR_GL_DEVICE='software'))['frame']


def build_plugin(source, out):
    """Builds the plugin that counts executed blocks, for the installed QEMU. Returns its path."""
    qemu = int(re.search(r'version (\d+)', run(['qemu-aarch64', '--version'])).group(1))
    run(['cc', f'-DAPI_VERSION={1 if qemu < 9 else 2}', '-O2', '-shared', '-fPIC', '-fvisibility=hidden', '-o', out, source])
    return out


def frame_counts(emulator, plugin, program, case, width):
    """Returns the number of executions of each block of instructions, for one frame on one thread."""
    counts = []
    with tempfile.TemporaryDirectory() as folder:
        for frames in FRAMES[case]:
            out = os.path.join(folder, 'blocks')
            run([*emulator, '-plugin', f'{plugin},out={out}', program, '--engine', 'simd', '--case', case,
                 '--width', str(width), '--frames', str(frames)])
            with open(out, encoding='ascii') as file:
                counts.append(cpu_model.Counts(file.read()))
    return counts[1].less(counts[0], 1)


def host_times(program, threads, width, *more):
    """Returns the times of each stage of a frame on this machine [ms], and the processor's clock."""
    return json.loads(run([program, '--time', '--frames', str(TIMED + 3), '--threads', str(threads), '--width',
                           str(width), *more]))


def host_processor():
    """Returns the names of this machine's processor: its own and llvm-mca's (None if it is not x86-64)."""
    name = ''
    with open('/proc/cpuinfo', encoding='ascii', errors='replace') as file:
        for line in file:
            if line.startswith('model name'):
                name = line.split(':', 1)[1].strip()
                break
    if os.uname().machine != 'x86_64':
        return name, None
    triple = run(['llc-' + cpu_model.LLVM, '--version'])
    host = [line.split(':', 1)[1].strip() for line in triple.splitlines() if 'Host CPU' in line]
    return name, host[0] if host else 'x86-64-v3'
