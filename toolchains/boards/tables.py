"""Writes the report as Markdown and CSV."""
import csv
import io

import predict

UNITS = {'waiting': 'latency'}


def table(head, rows):
    lines = ['| ' + ' | '.join(head) + ' |', '|' + '---|' * len(head)]
    lines += ['| ' + ' | '.join(str(cell) for cell in row) + ' |' for row in rows]
    return '\n'.join(lines) + '\n'


def ms(value):
    return '-' if value is None else f'{value:.1f}' if value < 100 else f'{value:.0f}'


def frames_a_second(value):
    if value > 500:  # faster than any camera or screen
        return '> 500'
    return f'{value:.1f}' if value < 10 else f'{value:.0f}'


def gpu_name(board, model):
    return model['gpus'][board['gpu']['kind']]['name'] if 'gpu' in board else board.get('no_gles31', '-')


def placement(result):
    """Returns the name of the fastest assignment of steps to engines, for a table cell."""
    names = {'simd': 'SIMD', 'gles': 'GLES', 'match simd, draw gles': 'SIMD, detail GLES',
             'match gles, draw simd': 'GLES, detail SIMD'}
    return names[result['best']]


def board_rows(model, results):
    for key, board in model['boards'].items():
        cpu = model['cpus'][board['cpu']['kind']]['name']
        yield key, board, [board['name'], gpu_name(board, model), f'{board["cpu"]["cores"]} x {cpu}']


def frames_table(model, results):
    widths = model['frame']['outputs']
    head = ['board', 'GPU', 'CPU', 'engines'] + [f'moving, {w}' for w in widths] + [f'at rest, {max(widths)}']
    rows = []
    for key, _, begin in board_rows(model, results):
        moving, rest = results['boards'][key]['moving'], results['boards'][key]['rest']
        rows.append(begin + [placement(moving[model['frame']['readme_output']])]
                    + [frames_a_second(moving[w]['fps']) for w in widths]
                    + [frames_a_second(rest[max(widths)]['fps'])])
    host = results['host']
    if host:
        rows.append(['this machine, measured', '-', f'{host["threads"]} x {host["name"]}', 'SIMD']
                    + [frames_a_second(1000 / host['own']['moving'][w]) for w in widths]
                    + [frames_a_second(1000 / host['own']['rest'][max(widths)])])
    return table(head, rows)


def predicted_frames(model, results):
    """Returns the table that pipeline/engine_guess.cpp includes: for each GPU, the time of a moving frame [ms] for each
    assignment of steps to engines."""
    order = ('simd', 'match simd, draw gles', 'match gles, draw simd', 'gles')
    lines = ['// Written by ./run board-report.']
    for key, board in model['boards'].items():
        frames = results['boards'][key]['moving'][model['frame']['readme_output']]['frames']
        if len(frames) == len(order):
            gpu = model['gpus'][board['gpu']['kind']]['renderer']
            lines.append(f'{{"{gpu}", ' + ', '.join(f'{frames[name]:.1f}' for name in order) + '},')
    return '\n'.join(lines) + '\n'


def steps_table(model, results, width):
    steps = predict.STEPS
    head = ['board', 'engine', *steps, 'frame']
    rows = []
    for key, board, begin in board_rows(model, results):
        one = results['boards'][key]['moving'][width]
        for cores in predict.CORES:
            cpu = one['cpu'][cores]
            rows.append([begin[0], f'SIMD, {cores} core{"s" if cores > 1 else ""}']
                        + [ms(cpu.get(step, 0)) for step in steps] + [ms(sum(cpu.values()))])
        if one['gpu']:
            gpu = one['gpu']
            rows.append([begin[0], gpu_name(board, model), '(CPU)'] + [ms(gpu[step]) for step in steps[1:]]
                        + [ms(one['frames']['gles'])])
        rows.append([begin[0], 'faster', '']
                    + [one['engines'][step].upper() for step in steps[1:]] + [f'{ms(min(one["frames"].values()))}'])
    return table(head, rows)


def dearest_passes(model, results, width, count=6):
    rows = []
    for key, board, begin in board_rows(model, results):
        passes = {}
        for one in results['boards'][key]['moving'][width]['passes']:
            entry = passes.setdefault(one['shader'], [0, 0.0, one['limit']])
            entry[0] += 1
            entry[1] += one['ms']
        dearest = sorted(passes.items(), key=lambda item: -item[1][1])[:count]
        rows += [[begin[0], shader, calls, ms(time), UNITS.get(limit, limit)]
                 for shader, (calls, time, limit) in dearest]
    return table(['board', 'shader', 'runs', 'ms', 'limit'], rows)


def instructions_table(results):
    """Million instructions of a frame, counted in the emulator. The cycles are computed from them."""
    steps = predict.STEPS
    rows = [[case, *(f'{one.get(step, 0):.1f}' for step in steps), f'{sum(one.values()):.0f}']
            for case, one in results['instructions'].items()]
    return table(['million instructions of aarch64', *steps, 'frame'], rows)


def spills_table(model, compiled):
    rows = [[model['gpus'][kind]['name'], shader.key, shader.spills, shader.fills]
            for kind, shaders in compiled.items() for shader in shaders.values() if shader.spills or shader.fills]
    return table(['GPU', 'shader', 'spills', 'fills'], rows) if rows else 'No shader spills.\n'


def host_table(host):
    rows = [[step, ms(predicted), ms(measured), f'{ratio:.2f}'] for step, predicted, measured, ratio in host['errors']]
    text = table(['step', 'predicted [ms]', 'measured [ms]', 'measured / predicted'], rows)
    spread = host['frame']
    text += (f'\nOne thread, AVX2, moving, 640x480 to 2304x1728, {host["name"]} at {host["clock"] / 1e3:.2f} GHz, '
             f'llvm-mca for {host["mca"]}. Measured: the shortest time of each step in {host["frames"]} frames; '
             f'whole frames took {ms(spread["least"])} to {ms(spread["most"])} ms, median {ms(spread["median"])} ms.\n')
    return text


def markdown(model, compiled, results):
    width = model['frame']['readme_output']
    parts = ['# Predicted: mfar on boards\n',
             'Frames per second from 640x480 to outputs with these numbers of columns, 4:3. Predicted from the code that '
             'compilers generate for shaders and loops (toolchains/boards/README.md), not measured on a board.\n',
             frames_table(model, results), f'## Steps of a moving frame to {width} columns [ms]\n',
             steps_table(model, results, width), '## Most expensive shaders\n', dearest_passes(model, results, width),
             '## Instructions\n', instructions_table(results), '## Spills\n', spills_table(model, compiled)]
    if results['host']:
        parts += ['## Check of the processor model on this machine\n', host_table(results['host'])]
    return '\n'.join(parts)


def passes_csv(model, compiled, results):
    """Statistics of every shader on every GPU, and time and limit of every pass on every board."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator='\n')
    writer.writerow(['gpu', 'shader', 'instructions', 'threads', 'registers', 'spills', 'fills', 'scratch', 'cycles'])
    for kind, shaders in compiled.items():
        for one in shaders.values():
            cycles = ' '.join(f'{unit}={value:g}' for unit, value in one.cycles.items())
            writer.writerow([model['gpus'][kind]['name'], one.key, one.instructions, one.threads, one.registers,
                             one.spills, one.fills, one.scratch, cycles])
    writer.writerow([])
    writer.writerow(['board', 'case', 'width', 'step', 'shader', 'invocations', 'ms', 'limit'])
    for key, cases in results['boards'].items():
        for case, widths in cases.items():
            for width, one in widths.items():
                for run in one['passes']:
                    writer.writerow([key, case, width, run['step'], run['shader'], run['invocations'],
                                     f'{run["ms"]:.3f}', run['limit']])
    return out.getvalue()
