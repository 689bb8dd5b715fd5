#!/usr/bin/env python3
"""Predicts the frame rate of mfar on boards from the code that compilers generate; see README.md. Called by
./run board-report."""
import argparse
import json
import os
import sys
import tomllib

import budget
import collect
import cpu_model
import drivers
import gpu_model
import plot
import predict
import tables

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.dirname(HERE))
from progress import Progress  # noqa: E402 (needs the line above)

PROGRESS = Progress()
BUDGET = os.path.join(HERE, 'budget.csv')


def read_model():
    with open(os.path.join(HERE, 'model.toml'), 'rb') as file:
        return tomllib.load(file)


def compile_all(model, folders, program, files=()):
    """Compiles the shaders in `files` (if it is empty, all shaders) for each kind of GPU whose drivers are built.
    Returns {kind: {key: Shader}}. `folders`: {Debian release: folder with the drivers}."""
    out = {}
    for done, (kind, gpu) in enumerate(model['gpus'].items()):
        PROGRESS.show(done, len(model['gpus']), f'compiling for {gpu["name"]}')
        if gpu['mesa'] not in folders:
            PROGRESS.clear()
            print(f'skipped: {gpu["name"]}: the Mesa drivers of Debian {gpu["mesa"]} are missing; ./run board-report '
                  'builds them')
            continue
        out[kind] = drivers.compile_shaders(folders[gpu['mesa']], gpu, program, files)
    PROGRESS.clear()
    return out


def budget_rows(compiled):
    return [budget.row_of(kind, shader) for kind, shaders in compiled.items() for shader in shaders.values()]


def check(compiled, allowed, unknown):
    """Prints the messages of budget.faults(), and the messages `unknown`. Returns the number of these messages."""
    faults = budget.faults(budget_rows(compiled), allowed)
    for fault in faults + unknown:
        print(fault)
    print(f'{sum(map(len, compiled.values()))} shaders on {len(compiled)} GPUs; {len(faults)} faults against the budget')
    return len(faults) + len(unknown)


def unknown_loops(model, works, compiled):
    """Returns a message for each shader in `works` ({(case, width): draws and dispatches of a frame}) whose loops have
    no trip counts in model.toml."""
    return gpu_model.unknown_loops([one for frame in works.values() for one in frame], compiled, model['loops'])


def gpu_works(program, widths):
    return {(case, width): collect.gpu_work(program, case, width) for case in collect.CASES for width in widths}


def outputs(model):
    width, height = model['frame']['video']
    return [(w, w * height // width) for w in model['frame']['outputs']]


def predict_board(board, model, works, compiled, cycles):
    """Returns the predictions for a board: {case: {output width: prediction}}."""
    gpu = board.get('gpu')
    known = gpu is not None and gpu['kind'] in compiled
    out = {}
    for case in collect.CASES:
        out[case] = {}
        for size in outputs(model):
            width = size[0]
            of_cpu = cycles[case, width]['cycles'][board['cpu']['kind']]
            cpu = {n: predict.cpu_steps(board, of_cpu, size, model, n, case == 'moving') for n in predict.CORES}
            shaders = compiled[gpu['kind']] if known else None
            on_gpu = predict.gpu_steps(board, works[case, width], shaders, model) if known else None
            most = cpu[max(cpu)]
            sums = predict.placements(most, on_gpu)
            best = min(sums, key=sums.get)
            out[case][width] = {
                'cpu': cpu, 'gpu': on_gpu, 'frames': sums, 'best': best, 'fps': 1000 / sums[best],
                'engines': predict.winners(most, on_gpu),
                'passes': predict.passes(board, works[case, width], shaders, model) if known else []}
    return out


def check_host(args, model, plugin):
    """Compares the predictions of the processor model with measurements on this machine."""
    name, mca = collect.host_processor()
    if mca is None:
        return None
    PROGRESS.show(9, 10, f'checking the model on this machine ({name})')
    width = max(model['frame']['outputs'])
    counts = collect.frame_counts(['qemu-x86_64', '-cpu', 'max'], plugin, args.frame_work, 'moving', width)
    entry = {'name': name, 'mca': mca, 'in_order': False}
    cycles = cpu_model.frame_cycles(args.frame_work, counts, {'host': entry}, model['steps'], arm=False)
    measured = collect.host_times(args.frame_work, 1, width, '--avx2')
    clock = measured['clockGhz'] * 1e3
    predicted = {step: million * 1e3 / clock for step, million in cycles['cycles']['host'].items()}
    # The measured time of the step weigh includes the comparison of the finest detail. The
    # prediction counts this comparison's row kernels in the step detail. So the sum of weigh and
    # detail is compared.
    times = {step: one['least'] for step, one in measured.items() if isinstance(one, dict)}
    for table in (predicted, times):
        table['weigh and detail'] = table.pop('weigh', 0) + table.pop('detail', 0)
    times.pop('frame')
    threads = min(os.cpu_count() or 1, 4)
    own = {case: {w: collect.host_times(args.frame_work, threads, w, '--case', case)['frame']['median']
                  for w in model['frame']['outputs']} for case in collect.CASES}
    return {'name': name, 'mca': mca, 'clock': clock, 'errors': predict.error_table(predicted, times),
            'frame': measured['frame'], 'frames': collect.TIMED, 'threads': threads, 'own': own}


def report(args, model, compiled):
    works, cycles = gpu_works(args.frame_work, model['frame']['outputs']), {}
    if unknown := unknown_loops(model, works, compiled):
        sys.exit('\n'.join(unknown))
    os.makedirs(args.out, exist_ok=True)
    plugin = collect.build_plugin(os.path.join(HERE, 'block_counts.c'), os.path.join(args.out, 'block_counts.so'))
    for case, width in works:
        PROGRESS.show(len(cycles), len(works) + 1, f'{case}, {width} columns: counting instructions')
        counts = collect.frame_counts(['qemu-aarch64', '-cpu', 'max', '-L', args.sysroot], plugin,
                                      args.arm_frame_work, case, width)
        cycles[case, width] = cpu_model.frame_cycles(args.arm_frame_work, counts, model['cpus'], model['steps'],
                                                     arm=True)
    results = {'boards': {key: predict_board(board, model, works, compiled, cycles)
                          for key, board in model['boards'].items()},
               'instructions': {f'{case} {width}': one['instructions'] for (case, width), one in cycles.items()},
               'host': None if args.no_host else check_host(args, model, plugin)}
    PROGRESS.clear()
    text = tables.markdown(model, compiled, results)
    write(args.out, 'boards.md', text)
    write(args.out, 'passes.csv', tables.passes_csv(model, compiled, results))
    write(args.out, 'boards.json', json.dumps(results, indent=1) + '\n')
    write(args.out, 'predicted_frames.inc', tables.predicted_frames(model, results))
    write(args.out, 'boards.svg', plot.frames(model, results))
    print(text)
    print(f'Written to {args.out}: boards.md, boards.svg, passes.csv, boards.json, predicted_frames.inc')


def write(folder, name, text):
    with open(os.path.join(folder, name), 'w', encoding='utf-8') as file:
        file.write(text)


def parse():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--drivers', action='append', default=[], metavar='SUITE=LIBRARIES')
    parser.add_argument('--compile-shaders', required=True)
    parser.add_argument('--frame-work')
    parser.add_argument('--arm-frame-work')
    parser.add_argument('--sysroot')
    parser.add_argument('--no-host', action='store_true', help='skip the check of the model on this machine')
    parser.add_argument('--out', default='out/boards')
    parser.add_argument('--check', action='store_true', help='only compare all shaders with their budgets (budget.csv); with '
                        '--frame-work, also find loops without trip counts in model.toml')
    parser.add_argument('--update-budget', action='store_true')
    parser.add_argument('--budget', default=BUDGET)
    parser.add_argument('--file', action='append', default=[], help='with --check: compare only this shader')
    return parser.parse_args()


def main():
    args, model = parse(), read_model()
    compiled = compile_all(model, dict(entry.split('=', 1) for entry in args.drivers), args.compile_shaders,
                           args.file)
    if args.update_budget:
        kept = [row for (kind, _), row in budget.read(args.budget).items() if kind not in compiled]
        budget.write(args.budget, kept + budget_rows(compiled))
        return 0
    if args.check:
        if not compiled:
            return 77
        works = gpu_works(args.frame_work, [model['frame']['readme_output']]) if args.frame_work else {}
        unknown = unknown_loops(model, works, compiled)
        return 1 if check(compiled, budget.read(args.budget), unknown) else 0
    report(args, model, compiled)
    return 0


if __name__ == '__main__':
    sys.exit(main())
