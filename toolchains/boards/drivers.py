"""Runs mfar-compile-shaders with the OpenGL ES driver of a board's GPU, without the board."""
import os
import subprocess

import shader_stats

STATISTICS = {'v3d': {'V3D_DEBUG': 'nir,shaderdb'}, 'panfrost': {'BIFROST_MESA_DEBUG': 'shaders,shaderdb'},
              'freedreno': {'IR3_SHADER_DEBUG': 'vs,fs,cs'}}

# Without a GPU, Panfrost crashes at a dispatch and at a shader that spills registers, so the shaders are only linked.
# V3D prints no statistics of a shader that the same context has already compiled.
OPTIONS = {'panfrost': ['--link-only'], 'v3d': ['--new-contexts']}


def command(libraries, driver, program, arguments):
    """Returns a command that runs the program with all libraries (even libc) of the drivers' Debian release."""
    return [os.path.join(libraries, 'ld-linux-x86-64.so.2'), '--library-path', libraries, '--preload',
            os.path.join(libraries, f'lib{driver}_noop_drm_shim.so'), program, *arguments]


def compile_shaders(libraries, gpu, program, files=()):
    """Compiles the shaders in `files`; if it is empty, all shaders of mfar. Returns {key: Shader}. Raises RuntimeError
    if a shader does not compile."""
    arguments = [*OPTIONS.get(gpu['driver'], []), *files]
    environment = dict(os.environ, LIBGL_DRIVERS_PATH=libraries, GBM_BACKENDS_PATH=libraries,
                       MESA_SHADER_CACHE_DISABLE='1', **STATISTICS[gpu['driver']], **gpu['environment'])
    environment.pop('MFAR_GL_DEVICE', None)
    run = subprocess.run(command(libraries, gpu['driver'], program, arguments), env=environment, text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, errors='replace', check=False)
    lines = run.stdout.splitlines()
    if run.returncode != 0:
        named = [line for line in lines if line.startswith('shader: ') and 'MESA_' not in line]
        raise RuntimeError(f'{gpu["name"]}: mfar-compile-shaders ended with exit code {run.returncode} after '
                           f'{named[-1] if named else "no shader"}: {" | ".join(lines[-3:])[:500]}')
    if gpu['renderer'] not in run.stdout:
        raise RuntimeError(f'{gpu["name"]}: its driver does not report the renderer name "{gpu["renderer"]}"')
    return shader_stats.parse(lines)
