#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""cycles.py FLANKFILM SOURCE [--set STAGE.NAME=VALUE]...

The dynamic film of the paper's pair at its points I, II and III on 512 cells and 1000 steps, compared
with 8 times as many of both. Prints the mean error of h_min where the load is above 2 % of its largest,
the error not exceeded at 99 % of the instants, and the largest; then the same without the instants that
a jump of the load affects: one passage, 0.017 rad of the roll angle after LPSTC and HPSTC.
"""
import argparse
import bisect
import json
import math
import os
import subprocess
import tempfile

CELLS, STEPS, FINER = 512, 1000, 8
PASSAGE = 0.017
POINTS = {'I': [], 'II': ['duty.mesh_frequency="2085 Hz"'],
          'III': ['duty.mesh_frequency="2375 Hz"', 'motion.branch=upper']}


def run(program, source, settings, times):
    wanted = 'film.time, film.roll_angle, film.h_min, film.load_per_width, gears.roll_lpstc, gears.roll_hpstc'
    settings = settings + [f'film.cells={times * CELLS}', f'film.steps={times * STEPS}',
                           f'outputs=[{wanted}]']
    command = [program, 'run', f'{source}/configs/li-kahraman-2011.yaml', '--json', '--arrays']
    with tempfile.TemporaryDirectory() as scratch:
        done = subprocess.run(command + [f'--set={s}' for s in settings], cwd=scratch,
                              capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit((done.stdout or done.stderr)[-500:])
    out = json.loads(done.stdout)['outputs']
    return {name.split('.')[1]: x.get('data', x.get('value')) for name, x in out.items()}


def at(xs, ys, x):
    k = min(max(bisect.bisect(xs, x), 1), len(xs) - 1)
    share = (x - xs[k - 1]) / (xs[k] - xs[k - 1]) if xs[k] > xs[k - 1] else 1
    return ys[k - 1] + share * (ys[k] - ys[k - 1])


def line(errors):
    errors = sorted(errors)
    return f'{sum(errors) / len(errors):.4f} | {errors[math.ceil(0.99 * len(errors)) - 1]:.3f} | {errors[-1]:.3f}'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument('program')
    parser.add_argument('source')
    parser.add_argument('--set', action='append', default=[])
    args = parser.parse_args()
    program, source = os.path.abspath(args.program), os.path.abspath(args.source)
    print('| point | mean, % | not exceeded at 99 % of the instants, % | largest, % '
          '| without the passages after load jumps: mean, % | 99 %, % | largest, % |\n|---|---|---|---|---|---|---|')
    for point, settings in POINTS.items():
        plain = run(program, source, settings + args.set, 1)
        fine = run(program, source, settings + args.set, FINER)
        ends = [plain['roll_lpstc'], plain['roll_hpstc']]
        most, every, apart = max(plain['load_per_width']), [], []
        for t, roll, h, load in zip(*(plain[k] for k in ('time', 'roll_angle', 'h_min', 'load_per_width'))):
            if load > 0.02 * most:
                every.append(100 * abs(h / at(fine['time'], fine['h_min'], t) - 1))
                if not any(end < roll < end + PASSAGE for end in ends):
                    apart.append(every[-1])
        print(f'| {point} | {line(every)} | {line(apart)} |', flush=True)


main()
