"""Predicts the time of a frame on each board: the time of each step on both engines, the faster engine of each step,
and the time of the whole frame for each assignment of steps to engines."""
import gpu_model

STEPS = ('plan', 'pyramid', 'flow', 'weigh', 'detail')
MATCHING = ('pyramid', 'flow', 'weigh')
CORES = (1, 2, 4)


def step_of_shader(name, steps):
    for step, begins in steps.items():
        if name.startswith(tuple(begins)):
            return step
    raise ValueError(f'{name} does not belong to any step of model.toml')


def passes(board, works, shaders, model):
    """Returns the predictions for every draw and dispatch in `works`."""
    gpu = model['gpus'][board['gpu']['kind']]
    out = []
    for work in works:
        shader = shaders[(work['shader'] + ' ' + work['defines']).strip()]
        ms, limit, units = gpu_model.pass_time(work, shader, gpu, board, model)
        out.append({'shader': shader.key, 'step': step_of_shader(work['shader'], model['shader_steps']), 'ms': ms,
                    'limit': limit, 'units': units, 'invocations': work['invocations']})
    return out


def gpu_steps(board, works, shaders, model):
    """Returns the time of each step on the GPU [ms]. The first step includes the upload of the picture."""
    out = {step: 0.0 for step in STEPS[1:]}
    for one in passes(board, works, shaders, model):
        out[one['step']] = out.get(one['step'], 0.0) + one['ms']
    if works:
        width, height = model['frame']['video']
        out['pyramid'] += 2 * 4 * width * height / gpu_model.bandwidth(board, model)
    return out


def cpu_steps(board, cycles, output, model, cores, moving=True):
    """Returns the time of each step on `cores` cores [ms]. `cycles`: million cycles of each step for a frame on one
    core. At rest, only the step plan reads pixels."""
    share = model['cpu_model']['parallel_share']
    video, still = (w * h for w, h in (model['frame']['video'], model['frame']['still']))
    pixels = {'video': video, 'output': output[0] * output[1], 'still': still}
    out = {}
    for step, million in cycles.items():
        one = million * 1e3 / board['cpu']['clock']
        bytes_ = sum(pixels[of] * n for of, n in model['cpu_bytes'].get(step, {}).items())
        if not moving and step != 'plan':
            bytes_ = 0
        out[step] = max(one * (1 - share + share / cores), bytes_ / gpu_model.bandwidth(board, model))
    return out


def placements(cpu, gpu):
    """Returns the time of a frame [ms] for each assignment of its steps to engines. `cpu` and `gpu` are times of the
    steps; `gpu` is None without a GPU."""
    host = cpu.get('plan', 0) + cpu.get('rest', 0)  # steps without shaders
    sums = {'simd': sum(cpu.values())}
    if gpu is None:
        return sums
    drawing = {'detail'}
    sums['gles'] = host + sum(gpu.values())
    sums['match simd, draw gles'] = host + sum(cpu.get(s, 0) for s in MATCHING) + sum(gpu[s] for s in drawing)
    sums['match gles, draw simd'] = host + sum(gpu[s] for s in MATCHING) + sum(cpu.get(s, 0) for s in drawing)
    return sums


def winners(cpu, gpu):
    """Returns the faster engine of each step."""
    return {step: 'simd' if gpu is None or cpu.get(step, 0) <= gpu[step] else 'gles' for step in STEPS[1:]}


def error_table(predicted, measured):
    """Returns (step, predicted [ms], measured [ms], measured / predicted) for each step in both tables, and for their sum."""
    rows = [(step, predicted[step], measured[step]) for step in predicted if step in measured]
    rows.append(('sum of these steps', sum(r[1] for r in rows), sum(r[2] for r in rows)))
    return [(step, p, m, m / p if p else float('nan')) for step, p, m in rows]
