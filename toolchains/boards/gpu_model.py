"""Predicts the time of a pass on a GPU from the statistics of its compiled shader and its number of invocations."""
import ast
import math


MOST_BYTES = 16  # largest number of bytes per access


class UnknownLoops(Exception):
    """model.toml has no trip counts for the loops of this shader."""


def evaluate(expression, names):
    """Evaluates sums, differences and products of integers and of the values in `names`."""
    def value(node):
        if isinstance(node, ast.Constant):
            return node.value
        if isinstance(node, ast.Name):
            return names[node.id]
        if isinstance(node, ast.BinOp):
            left, right = value(node.left), value(node.right)
            return {ast.Add: left + right, ast.Sub: left - right, ast.Mult: left * right}[type(node.op)]
        raise ValueError(f'cannot evaluate {expression}')
    return value(ast.parse(expression, mode='eval').body)


def trips_of(shader, params, loops):
    """Returns the trip count of each loop of a shader. `loops` is the table [[loops]] of model.toml."""
    lying = ' '.join(str(loop.depth) for loop in shader.loops[1:])
    if not lying:
        return []
    for entry in loops:
        if entry['shader'] == shader.name and lying in entry['trips']:
            return [evaluate(expression, params) for expression in entry['trips'][lying]]
    raise UnknownLoops(f'{shader.key}: model.toml has no trip counts for loops of these depths: "{lying}"')


def unknown_loops(works, compiled, loops):
    """Returns a message for each shader in `works` (draws and dispatches) whose loops have no trip counts.
    `compiled`: {kind of GPU: {key: Shader}}."""
    out = set()
    for work in works:
        key = (work['shader'] + ' ' + work['defines']).strip()
        for shaders in compiled.values():
            try:
                if key in shaders:
                    trips_of(shaders[key], work['params'], loops)
            except UnknownLoops as error:
                out.add(str(error))
    return sorted(out)


def unit_cycles(shader, trips, gpu):
    """Returns for each kind of unit: (cycles that one wave keeps it busy, number of cores that share one unit)."""
    arithmetic, memory, texture = shader.weights(trips)
    if gpu['driver'] == 'panfrost':
        weights = {'texture': texture, 't': texture, 'ldst': memory, 'ls': memory, 'vary': 1, 'v': 1}
        return {unit: (shader.cycles.get(unit, 0) * weights.get(unit, arithmetic) * gpu['lanes'] / rate, 1)
                for unit, rate in gpu['units'].items()}
    slice_ = gpu['cores_per_slice']
    fetches = shader.executed('texture', trips) * gpu['lanes'] / gpu['texture']
    accesses = shader.executed('memory', trips) * gpu['lanes'] / gpu['memory']
    units = {'arithmetic': (executed_instructions(shader, trips) * gpu['issue'], 1)}
    if gpu['driver'] == 'v3d':  # one unit does texture look-ups and memory accesses
        units['texture, memory'] = fetches + accesses, slice_
    else:
        units['texture'], units['memory'] = (fetches, slice_), (accesses, slice_)
    return units


def executed_instructions(shader, trips):
    """Returns the number of instructions that one invocation executes: those of the compiled shader, times the ratio
    of executed to existing operations in NIR."""
    kinds = ('arithmetic', 'memory', 'texture')
    stands = sum(getattr(loop, kind) for loop in shader.loops for kind in kinds)
    runs = sum(shader.executed(kind, trips) for kind in kinds)
    return shader.instructions * (runs / stands if stands else 1)


def waves_of_core(shader, gpu):
    if gpu['driver'] == 'v3d':
        return shader.threads
    if gpu['driver'] == 'panfrost':
        return gpu['waves'] * (1 if shader.threads == 2 else 0.5)
    return max(1, gpu['waves'] * min(1, 24 / max(shader.registers, 1)))


def pass_time(work, shader, gpu, board, model):
    """Returns for one draw or dispatch: (time [ms], resource that limits it, time of each resource [ms])."""
    trips = trips_of(shader, work['params'], model['loops'])
    cores, clock = board['gpu']['cores'], board['gpu']['clock'] * 1e3  # cycles per millisecond
    waves = math.ceil(work['invocations'] / gpu['lanes'])
    ms = {}
    for unit, (cycles, shared) in unit_cycles(shader, trips, gpu).items():
        ms[unit] = waves * cycles / max(cores / shared, 1) / clock
    waits = shader.executed('memory', trips) + shader.executed('texture', trips)
    lone = executed_instructions(shader, trips) * gpu['lone_issue'] + waits * model['gpu_model']['memory_latency']
    ms['waiting'] = max(waves / (cores * waves_of_core(shader, gpu)), 1) * lone / clock
    # A pass that reads only a few cells of its inputs does not read all bytes.
    read = min(work['read'], work['invocations'] * waits * MOST_BYTES)
    ms['bandwidth'] = (read + work['written']) / bandwidth(board, model)
    limit = max(ms, key=ms.get)
    return ms[limit] + board['gpu']['job_us'] * 1e-3, limit, ms


def bandwidth(board, model):
    """Returns the memory bandwidth that a board reaches [bytes/ms]."""
    return board['memory'] * 1e6 * model['gpu_model']['bandwidth_share']
