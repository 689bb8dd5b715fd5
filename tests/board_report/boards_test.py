#!/usr/bin/env python3
"""Tests the parts of ./run board-report with recorded output of drivers and with simple numbers."""
import os
import sys
import unittest
import xml.dom.minidom

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, '..', '..', 'toolchains', 'boards'))

# pylint: disable=wrong-import-position
import budget
import cpu_model
import gpu_model
import plot
import predict
import report
import shader_stats
import tables

MODEL = report.read_model()


def recorded(kind):
    with open(os.path.join(HERE, 'samples', kind + '.txt'), encoding='utf-8') as file:
        return shader_stats.parse(file)['loop.comp']


def shader(**values):
    return shader_stats.Shader('flow_filter.comp', '', **values)


class PredictedFrames(unittest.TestCase):
    def test_the_file_has_a_row_for_every_board_with_a_gpu(self):
        path = os.path.join(HERE, '..', '..', 'pipeline', 'predicted_frames.inc')
        with open(path, encoding='utf-8') as file:
            rows = [line.strip('{},\n').split(', ') for line in file if line.startswith('{')]
        gpus = [MODEL['gpus'][board['gpu']['kind']]['renderer'] for board in MODEL['boards'].values() if 'gpu' in board]
        self.assertEqual([row[0].strip('"') for row in rows], gpus)
        self.assertTrue(all(float(value) > 0 for row in rows for value in row[1:]))
        self.assertEqual({len(row) for row in rows}, {5})


class RecordedStatistics(unittest.TestCase):
    def test_statistics_of_the_v3d_driver_are_read(self):
        one = recorded('v3d-4')
        self.assertEqual((one.instructions, one.threads, one.registers, one.spills, one.fills), (35, 4, 5, 0, 0))

    def test_statistics_of_the_bifrost_driver_are_read(self):
        one = recorded('mali-bifrost')
        self.assertEqual((one.instructions, one.threads), (24, 2))
        self.assertAlmostEqual(one.cycles['arith'], 0.708333)
        self.assertEqual(one.cycles['ldst'], 3)

    def test_statistics_of_the_valhall_driver_are_read(self):
        one = recorded('mali-valhall')
        self.assertEqual(one.instructions, 31)
        self.assertEqual((one.cycles['t'], one.cycles['ls']), (0.25, 3))

    def test_statistics_of_the_adreno_driver_are_read(self):
        one = recorded('adreno-6')
        self.assertEqual((one.instructions, one.registers, one.fills), (57, 4, 0))

    def test_every_driver_shows_the_loop_with_its_texture_read(self):
        for kind in ('v3d-4', 'mali-bifrost', 'mali-valhall', 'adreno-6'):
            with self.subTest(kind):
                loops = recorded(kind).loops
                self.assertEqual([loop.depth for loop in loops], [0, 1])
                self.assertEqual((loops[0].texture, loops[1].texture), (0, 1))
                self.assertGreaterEqual(loops[1].memory, 2)

    def test_spills_are_read(self):
        line = 'SHADER-DB-GLSL1 - MESA_SHADER_COMPUTE shader: 9 inst, 2 threads, 0 loops, 7 max-temps, 73:123 spills:fills'
        one = shader_stats.parse(['shader: a.comp #define B', line])['a.comp #define B']
        self.assertEqual((one.spills, one.fills), (73, 123))

    def test_a_shader_name_in_the_middle_of_a_line_is_found(self):
        all_shaders = shader_stats.parse(['shader: a.comp', '; type: shader: b.comp #define C'])
        self.assertEqual(set(all_shaders), {'a.comp', 'b.comp #define C'})


class Weights(unittest.TestCase):
    def test_instructions_count_once_per_iteration_of_their_loops(self):
        loop = shader_stats.Loop
        one = shader(loops=[loop(0, -1, 10, 1, 0), loop(1, 0, 5, 0, 1), loop(2, 1, 2, 3, 0)])
        self.assertEqual(one.executed('arithmetic', [4, 3]), 10 + 4 * 5 + 12 * 2)
        self.assertEqual(one.executed('memory', [4, 3]), 1 + 12 * 3)
        self.assertEqual(one.weights([4, 3])[2], 4)

    def test_an_else_branch_does_not_end_a_loop(self):
        reader = shader_stats.NirReader()
        for line in ('loop {', 'if ssa_1 {', 'vec1 32 ssa_2 = fadd ssa_0, ssa_1', '} else {',
                     'vec1 32 ssa_3 = fmul ssa_0, ssa_1', '}', '}', 'vec1 32 ssa_4 = fadd ssa_0, ssa_1'):
            reader.line(line)
        self.assertEqual([loop.arithmetic for loop in reader.loops], [1, 2])


class GpuModel(unittest.TestCase):
    BOARD = {'gpu': {'kind': 'v3d-4', 'cores': 8, 'clock': 500, 'job_us': 100}, 'memory': 10}
    WORK = {'invocations': 8 * 16 * 1000, 'read': 0, 'written': 0, 'params': {}}

    def time(self, work, **values):
        values.setdefault('loops', [shader_stats.Loop(0, -1, 100)])
        return gpu_model.pass_time(work, shader(**values), MODEL['gpus']['v3d-4'], self.BOARD, MODEL)

    def test_a_wave_takes_four_cycles_per_instruction(self):
        # 1000 waves on each of 8 cores execute 100 instructions of 4 cycles at 500 MHz
        ms, limit, _ = self.time(self.WORK, instructions=100, threads=4)
        self.assertAlmostEqual(ms, 0.8 + 0.1)
        self.assertEqual(limit, 'arithmetic')

    def test_memory_bandwidth_limits_the_time(self):
        work = dict(self.WORK, written=50_000_000)
        ms, limit, _ = self.time(work, instructions=100, threads=4)
        self.assertEqual(limit, 'bandwidth')
        self.assertAlmostEqual(ms, 50e6 / (10e6 * MODEL['gpu_model']['bandwidth_share']) + 0.1)

    def test_a_single_wave_waits_for_memory(self):
        work = dict(self.WORK, invocations=16)
        ms, limit, _ = self.time(work, instructions=100, threads=4, loops=[shader_stats.Loop(0, -1, 90, 10)])
        self.assertEqual(limit, 'waiting')
        self.assertAlmostEqual(ms, (100 * 4 + 10 * MODEL['gpu_model']['memory_latency']) / 500e3 + 0.1)

    def test_numbers_of_loop_iterations_come_from_parameters(self):
        loop = shader_stats.Loop
        one = shader(loops=[loop(0), loop(1, 0), loop(1, 0), loop(2, 2)])
        self.assertEqual(gpu_model.trips_of(one, {'planeFits': 2}, MODEL['loops']), [3, 2, 5])
        with self.assertRaises(gpu_model.UnknownLoops):
            gpu_model.trips_of(shader(loops=[loop(0), loop(1, 0), loop(1, 0)]), {}, MODEL['loops'])

    def test_shaders_of_a_frame_whose_loops_are_not_in_the_model_are_listed_once(self):
        loop = shader_stats.Loop
        compiled = {kind: {'flow_filter.comp': shader(loops=[loop(0), loop(1, 0)]),
                           'not_in_the_frame.comp': shader(loops=[loop(0), loop(1, 0)])}
                    for kind in ('v3d-4', 'v3d-7')}
        work = {'shader': 'flow_filter.comp', 'defines': '', 'params': {'planeFits': 2}}
        found = gpu_model.unknown_loops([work, work], compiled, MODEL['loops'])
        self.assertEqual(len(found), 1)
        self.assertIn('flow_filter.comp', found[0])
        known = {'v3d-4': {'flow_filter.comp': shader(loops=[loop(0)])}}
        self.assertEqual(gpu_model.unknown_loops([work], known, MODEL['loops']), [])


class CpuModel(unittest.TestCase):
    def test_counts_before_the_frames_are_subtracted(self):
        before = cpu_model.Counts('10 8 2 100\nother 5\n')
        after = cpu_model.Counts('10 8 2 300\n20 4 1 50\n10 8 2 100\nother 25\n')
        frame = after.less(before, 0.5)
        self.assertEqual(frame.blocks, {(0x10, 8): (2, 150.0), (0x20, 4): (1, 25.0)})
        self.assertEqual((frame.instructions(), frame.other), (325, 10))

    def test_blocks_do_not_depend_on_where_the_emulator_cuts_them(self):
        texts = {0x10: ('mov x0, x1', 0), 0x14: ('add x0, x0, #1', 0), 0x18: ('add x1, x1, #1', 0),
                 0x1c: ('b.ne target', 0x14), 0x20: ('ret', 0)}
        # Here the emulator has counted the loop's first iteration together with the code before it.
        # It has counted later iterations as two blocks, as if a page of memory ended between them.
        counts = cpu_model.Counts('0 16 4 1\n4 8 2 9\nc 4 1 9\n10 4 1 1\n')
        blocks = cpu_model.basic_blocks(counts, 0x10, texts)
        self.assertEqual(blocks, [([0x10], 1), ([0x14, 0x18, 0x1c], 10), ([0x20], 1)])
        self.assertTrue(cpu_model.is_loop(blocks[1][0], texts))
        self.assertFalse(cpu_model.is_loop(blocks[2][0], texts))
        self.assertEqual(cpu_model.hottest(blocks, 0.9), [blocks[1]])

    def test_branch_targets_are_removed_from_instruction_texts(self):
        line = '   23f10: \tb.ne\t0x23f00 <name+0x10>'
        self.assertEqual(cpu_model.instruction_text(line), (0x23f10, 'b.ne target', 0x23f00))
        self.assertEqual(cpu_model.instruction_text('  10: \tldr\tq0, [x1, #0x20]'), (0x10, 'ldr q0, [x1, #0x20]', 0))
        self.assertIsNone(cpu_model.instruction_text('0000000000001000 <name>:'))

    def test_cycles_are_read_from_the_answer_of_llvm_mca(self):
        answer = '{"CodeRegions": [{"Name": "b0", "SummaryView": {"TotalCycles": 150, "Iterations": 50, ' \
                 '"BlockRThroughput": 2}}, {"Name": "b1"}]}'
        self.assertEqual(cpu_model.mca_cycles(answer), {'b0': (3, 2)})

    def test_address_of_the_code_is_read_from_program_headers(self):
        text = '  LOAD  0x000000 0x0000000000000000 0x0 0x1c368 0x1c368 R   0x1000\n' \
               '  LOAD  0x01d000 0x000000000001d000 0x1 0x35e3b 0x35e3b R E 0x1000\n'
        self.assertEqual(cpu_model.code_address(text), 0x1d000)


class Predictions(unittest.TestCase):
    BOARD = {'name': 'Board', 'cpu': {'kind': 'a72', 'cores': 4, 'clock': 1000}, 'memory': 10}

    def test_threads_share_the_parallel_part_of_the_work(self):
        one, four = (predict.cpu_steps(self.BOARD, {'flow': 10}, (1280, 960), MODEL, n)['flow'] for n in (1, 4))
        self.assertAlmostEqual(one, 10)
        share = MODEL['cpu_model']['parallel_share']
        self.assertAlmostEqual(four, 10 * (1 - share + share / 4))

    def test_memory_bandwidth_limits_any_number_of_threads(self):
        for cores in (1, 4):
            ms = predict.cpu_steps(self.BOARD, {'detail': 0.001}, (2304, 1728), MODEL, cores)['detail']
            self.assertGreater(ms, 2304 * 1728 * 4 / 10e6)

    def test_the_fastest_assignment_of_steps_to_engines_wins(self):
        cpu = {'plan': 1, 'pyramid': 1, 'flow': 5, 'weigh': 1, 'detail': 50}
        gpu = {'pyramid': 2, 'flow': 20, 'weigh': 2, 'detail': 10}
        sums = predict.placements(cpu, gpu)
        self.assertEqual(min(sums, key=sums.get), 'match simd, draw gles')
        self.assertEqual(sums['match simd, draw gles'], 1 + 1 + 5 + 1 + 10)
        self.assertEqual(predict.winners(cpu, gpu),
                         {'pyramid': 'simd', 'flow': 'simd', 'weigh': 'simd', 'detail': 'gles'})
        self.assertEqual(predict.placements(cpu, None), {'simd': 58})

    def test_error_table_compares_predicted_and_measured_times(self):
        self.assertEqual(predict.error_table({'flow': 2.0, 'x': 1.0}, {'flow': 3.0}),
                         [('flow', 2.0, 3.0, 1.5), ('sum of these steps', 2.0, 3.0, 1.5)])

    def test_shaders_are_assigned_to_steps_and_unknown_shaders_are_refused(self):
        for name, step in (('luma_down.comp', 'pyramid'), ('superres_gain.comp', 'weigh'),
                           ('superres_seen.frag', 'detail')):
            self.assertEqual(predict.step_of_shader(name, MODEL['shader_steps']), step)
        with self.assertRaises(ValueError):
            predict.step_of_shader('new.comp', MODEL['shader_steps'])


class Budget(unittest.TestCase):
    ROW = {'gpu': 'v3d-4', 'shader': 'a.comp', 'instructions': 100, 'spills': 0, 'fills': 0, 'scratch': 2}
    ALLOWED = {('v3d-4', 'a.comp'): ROW}

    def faults(self, **changed):
        return budget.faults([dict(self.ROW, **changed)], self.ALLOWED)

    def test_five_percent_more_instructions_are_allowed(self):
        self.assertEqual(self.faults(instructions=105), [])
        self.assertEqual(self.faults(instructions=106), ['a.comp on v3d-4: 106 instructions, the budget is 100'])

    def test_more_spills_or_local_arrays_are_refused(self):
        self.assertEqual(self.faults(spills=1), ['a.comp on v3d-4: 1 spills, the budget is 0'])
        self.assertEqual(self.faults(scratch=3), ['a.comp on v3d-4: 3 scratch, the budget is 2'])

    def test_a_shader_without_statistics_is_refused(self):
        self.assertEqual(self.faults(instructions=0), ['a.comp on v3d-4: its driver printed no statistics'])

    def test_a_new_shader_is_reported_by_its_name(self):
        self.assertEqual(self.faults(shader='b.comp'), ['b.comp on v3d-4: has no budget in budget.csv'])

    def test_the_checked_in_budget_has_every_gpu_of_the_model(self):
        kinds = {kind for kind, _ in budget.read(report.BUDGET)}
        self.assertEqual(kinds, set(MODEL['gpus']))


class Outputs(unittest.TestCase):
    """Tests tables and plots with invented, plausible results."""

    @staticmethod
    def results():
        boards = {}
        for key, board in MODEL['boards'].items():
            gpu = {'pyramid': 1, 'flow': 20, 'weigh': 2, 'detail': 100} if 'gpu' in board else None
            cpu = {n: {'plan': 1, 'pyramid': 1, 'flow': 5, 'weigh': 1, 'detail': 40} for n in predict.CORES}
            sums = predict.placements(cpu[4], gpu)
            one = {'cpu': cpu, 'gpu': gpu, 'frames': sums, 'best': 'simd', 'fps': 1000 / sums['simd'],
                   'engines': predict.winners(cpu[4], gpu), 'passes': []}
            boards[key] = {case: {w: one for w in MODEL['frame']['outputs']} for case in ('moving', 'rest')}
        return {'boards': boards, 'host': None, 'instructions': {'moving 1920': {'flow': 3.0}}}

    def test_measured_rows_of_the_table_are_marked(self):
        results = self.results()
        widths = MODEL['frame']['outputs']
        results['host'] = {'name': 'CPU', 'mca': 'cpu', 'clock': 4000, 'errors': [('flow', 2.0, 3.0, 1.5)],
                           'frame': {'least': 9.0, 'median': 10.0, 'most': 12.0}, 'frames': 20, 'threads': 2,
                           'own': {'moving': {w: 10.0 for w in widths}, 'rest': {w: 0.2 for w in widths}}}
        text = tables.markdown(MODEL, {}, results)
        self.assertIn('| this machine, measured | - | 2 x CPU | SIMD | 100 | 100 | 100 | > 500 |', text)
        self.assertIn('| flow | 2.0 | 3.0 | 1.50 |', text)

    def test_tables_have_every_board(self):
        text = tables.markdown(MODEL, {}, self.results())
        for board in MODEL['boards'].values():
            self.assertIn(board['name'], text)

    def test_the_plot_is_xml_with_a_bar_for_every_engine(self):
        document = xml.dom.minidom.parseString(plot.frames(MODEL, self.results()))
        labels = [node.firstChild.data for node in document.getElementsByTagName('text')]
        self.assertEqual(sum(': SIMD' in label for label in labels), len(MODEL['boards']))
        self.assertEqual(sum(': GLES' in label for label in labels),
                         sum('gpu' in board for board in MODEL['boards'].values()))


if __name__ == '__main__':
    unittest.main()
