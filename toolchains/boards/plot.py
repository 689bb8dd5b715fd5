"""Draws the predicted times of a frame's steps as bars for each board and engine, as SVG."""
from xml.sax.saxutils import escape

import predict

# Okabe and Ito's colours, which remain distinct with colour vision deficiencies.
COLOURS = {'plan': '#999999', 'pyramid': '#F0E442', 'flow': '#0072B2', 'weigh': '#56B4E9', 'detail': '#E69F00'}
LEFT, WIDTH, ROW, TOP = 260, 620, 22, 72


def bars(model, results, width):
    """Returns (label, {step: time [ms]}) for each board and engine."""
    for key, board in model['boards'].items():
        short = board['name'].split(' (')[0]
        one = results['boards'][key]['moving'][width]
        cores = board['cpu']['cores']
        cpu = dict(one['cpu'][cores])
        cpu['plan'] = cpu.get('plan', 0) + cpu.pop('rest', 0)
        yield f'{short}: SIMD, {cores} cores', cpu
        if one['gpu']:
            name = model['gpus'][board['gpu']['kind']]['name'].split(',')[0]
            yield f'{short}: GLES, {name}', {'plan': cpu['plan'], **one['gpu']}


def nice(most):
    """Returns a round distance between marks, so that a scale up to `most` has at most seven marks above 0."""
    step = 1
    while most / step > 7:
        for factor in (2, 5, 10):
            if most / (step * factor) <= 7:
                return step * factor
        step *= 10
    return step


def text(x, y, content, anchor='start', size=12):
    return (f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}" stroke="white" stroke-width="3" '
            f'paint-order="stroke">{escape(content)}</text>')


def scale(most, height):
    step = nice(most)
    lines = []
    value = 0
    while value <= most:
        x = LEFT + WIDTH * value / most
        lines.append(f'<line x1="{x:.1f}" y1="{TOP - 6}" x2="{x:.1f}" y2="{height - 40}" stroke="#ddd"/>')
        lines.append(text(x, height - 24, f'{value}', 'middle'))
        value += step
    lines.append(text(LEFT + WIDTH / 2, height - 6, 'time of a frame [ms]', 'middle'))
    if most > 1000 / 30:  # the time of a frame at 30 Hz
        x = LEFT + WIDTH * 1000 / 30 / most
        lines.append(f'<line x1="{x:.1f}" y1="{TOP - 6}" x2="{x:.1f}" y2="{height - 40}" stroke="#c00" '
                     'stroke-dasharray="4 3"/>')
        lines.append(text(x, TOP - 10, '30 frames per second', 'middle', 11))
    return lines


def frames(model, results):
    width = model['frame']['readme_output']
    rows = list(bars(model, results, width))
    most = max(sum(steps.values()) for _, steps in rows) * 1.08
    height = TOP + ROW * len(rows) + 50
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {LEFT + WIDTH + 40} {height}" '
             'font-family="sans-serif">', '<rect width="100%" height="100%" fill="white"/>',
             text(12, 22, f'Predicted time of a frame while the camera moves, 640x480 to {width}x{width * 3 // 4}', size=15)]
    x = 12
    for step in predict.STEPS:
        lines.append(f'<rect x="{x}" y="34" width="12" height="12" fill="{COLOURS[step]}"/>')
        lines.append(text(x + 17, 45, step))
        x += 85
    lines += scale(most, height)
    for at, (label, steps) in enumerate(rows):
        y, x = TOP + ROW * at, float(LEFT)
        lines.append(text(LEFT - 8, y + 14, label, 'end'))
        for step in predict.STEPS:
            long = WIDTH * steps.get(step, 0) / most
            lines.append(f'<rect x="{x:.1f}" y="{y + 3}" width="{long:.1f}" height="{ROW - 6}" '
                         f'fill="{COLOURS[step]}"/>')
            x += long
        lines.append(text(x + 5, y + 14, f'{sum(steps.values()):.0f}'))
    return '\n'.join(lines + ['</svg>']) + '\n'
