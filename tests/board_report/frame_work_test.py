#!/usr/bin/env python3
"""Checks the GPU work of a frame that mfar-frame-work prints. Usage: frame_work_test.py PROGRAM"""
import os
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, '..', '..', 'toolchains', 'boards'))

# pylint: disable=wrong-import-position
import collect
import predict
import report

PROGRAM = sys.argv.pop(1)
MODEL = report.read_model()
WIDTH, HEIGHT = 1280, 960


class FrameWork(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.moving = collect.gpu_work(PROGRAM, 'moving', WIDTH)

    def works(self, shader):
        return [work for work in self.moving if work['shader'] == shader]

    def test_the_whole_output_is_drawn_once(self):
        drawn = [work for work in self.moving if work['shader'].startswith('composite_')]
        self.assertEqual(sum(work['invocations'] for work in drawn), WIDTH * HEIGHT)
        self.assertEqual(sum(work['written'] for work in drawn), 4 * WIDTH * HEIGHT)

    def test_the_search_runs_once_per_cell_of_4x4_pixels(self):
        finest = max(self.works('flow_search.comp'), key=lambda work: work['invocations'])
        width, height = MODEL['frame']['video']
        self.assertEqual(finest['invocations'], width * height // 16)
        self.assertEqual(finest['params']['columns'], width // 4)
        self.assertGreaterEqual(finest['params']['candidates'], 4)

    def test_every_pass_has_a_step(self):
        self.assertGreater(len(self.moving), 30)
        for work in self.moving:
            self.assertIn(predict.step_of_shader(work['shader'], MODEL['shader_steps']), predict.STEPS)

    def test_passes_that_use_learned_values_are_part_of_a_frame(self):
        for shader in ('superres_fine.comp', 'superres_confirm.comp', 'superres_guide.frag'):
            self.assertEqual(len(self.works(shader)), 1, shader)

    def test_nothing_is_drawn_at_rest(self):
        self.assertEqual(collect.gpu_work(PROGRAM, 'rest', WIDTH), [])


if __name__ == '__main__':
    unittest.main()
