#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random rough teeth that are taken as smooth: is the error as large as promised?

smooth.py FLANKFILM SOURCE [--first N] [--count N]

`roughness: ignored` against `resolved` with the same cells and steps, film parameters from 3 up.
The errors are measured as by choose.py; that of the friction is of the mean of |traction|.
"""
import argparse
import json
import math
import os
import random
import subprocess
import sys
import tempfile

import laws

LIMIT = {'film': laws.OUTPUTS['film'], 'friction': ['traction', 'time'],
         'pressure': ['p_max_highest']}


def draw(seed):
    r = random.Random(seed)
    teeth, module = r.randint(18, 50), r.choice([2, 3, 4, 6])
    pressure = 10 ** r.uniform(math.log10(0.25), math.log10(1.2))
    radius = module * teeth / 4 * math.sin(math.radians(20))
    torque = (2 * math.pi * radius * pressure ** 2 / 226.4 * 1e3 * 20 * teeth * module / 2 *
              math.cos(math.radians(20)) / 1e3)
    rpm = r.uniform(3, 25) * 1e3 / (teeth * module / 2) * 60 / (2 * math.pi)
    return {'oil': r.choice(laws.OILS), 'lambda': 10 ** r.uniform(math.log10(3.2), math.log10(30)),
            'stages': f"""
  gears: {{use: gear/involute-spur, teeth: [{teeth}, {teeth}], module: {module} mm, face_width: 20 mm}}
  duty: {{use: operating/steady, torque: {torque:.5g} N m, speed: {rpm:.5g} rpm}}
  mesh: {{use: stiffness/iso-6336}}
  tooth: {{use: contact/tooth-pair, load: mesh}}""",
            'waves': f'shortest: {r.choice([20, 40])} um, longest: {r.choice([200, 400, 800])} um, '
                     f'seed: {seed}'}


class Runner:
    def __init__(self, program, source):
        self.program, self.source = program, os.path.abspath(source)
        self.file = os.path.join(tempfile.mkdtemp(), 'scene.yaml')

    def call(self, command, scene, rq, film, outputs):
        with open(self.file, 'w') as stream:
            stream.write(f"""format: 2
include: [{self.source}/configs/lubricants/{scene['oil']}.yaml]
pipeline:{scene['stages']}
  oil: {{temperature: {laws.TEMPERATURES[scene['oil']]}}}
  rough: {{use: surface/synthetic, rq: [{rq:.5g} um, {rq:.5g} um], {scene['waves']}}}
  film: {{use: ehl/finite-volume, {film}}}
outputs: [{', '.join('film.' + name for name in outputs)}]
""")
        done = subprocess.run([self.program, command, self.file, '--json'], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        return json.loads(done.stdout)


def judge(runner, seed):
    """Pairs of promised and measured, by what is wanted."""
    scene = draw(seed)
    fixed = 'cells: 512, steps: 400'
    smooth = runner.call('run', scene, 0.1, fixed + ', roughness: ignored', laws.ALL)
    if smooth['status'] != 'ok':
        raise RuntimeError(smooth['errors'][0]['message'])
    least = smooth['outputs']['film.h_min_lowest']['value'] * 1e6
    rq = least / scene['lambda'] / math.sqrt(2)
    rough = runner.call('run', scene, rq, fixed, laws.ALL)
    if rough['status'] != 'ok':
        raise RuntimeError(rough['errors'][0]['message'])
    off = laws.errors(smooth, rough)
    rows = {}
    for what, names in LIMIT.items():
        answer = runner.call('explain', scene, rq, fixed + ', accuracy: 100 %', names)
        if answer['status'] != 'ok':
            raise RuntimeError(answer['errors'][0]['message'])
        film = next(s for s in answer['stages'] if s['stage'] == 'film')
        rows[what] = film['choice']['candidates'][0]['error'], off[what]
    return scene['lambda'], rows


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('source')
    parser.add_argument('--first', type=int, default=1)
    parser.add_argument('--count', type=int, default=12)
    options = parser.parse_args()
    kept, broken, whole = 0, 0, 0
    runner = Runner(options.program, options.source)
    for seed in range(options.first, options.first + options.count):
        film, rows = judge(runner, seed)
        for what, (promise, off) in rows.items():
            whole += 1
            kept += off <= promise
            broken += off > 2 * promise
        print(f'scene {seed}: lambda {film:.2g}: ' +
              ', '.join(f'{what} promised {100 * p:.2g} %, off by {100 * m:.2g} %'
                        for what, (p, m) in rows.items()), flush=True)
    print(f'{whole} promises: {kept} kept, {broken} broken')
    return 1 if broken or kept < 0.75 * whole or not whole else 0


if __name__ == '__main__':
    sys.exit(main())
