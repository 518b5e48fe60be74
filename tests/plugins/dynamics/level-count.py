#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The number of force levels that a motion with `force: shared` needs: five gear pairs at twelve speeds, compared with a direct solution.

The direct solution integrates the motion by Runge and Kutta's method, from the program's start, with deflections and slopes of
stiffness/load-distribution under 43 forces, each solved as the mean force. The program gets the same data at N + 1 forces 9 F (i/N)^2 in a
file for stiffness/table. Prints the largest difference of dte_rms and of the largest mesh force over the speeds, in per cent, and that of the
force over the quality line force_levels, which must be below 1. Not in the test suite: takes a minute of CPU time and needs numpy.

level-count.py FLANKFILM [CASE...]
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

PROGRAM = sys.argv[1]
RELIEF = ', tip_relief: {} um, tip_relief_shape: linear'
CASES = {
    'none': ('[50, 50]', 250, ''),
    '10': ('[50, 50]', 250, RELIEF.format(10)),
    '20': ('[50, 50]', 250, RELIEF.format(20)),
    '40': ('[50, 50]', 250, RELIEF.format(40)),
    '25/50': ('[25, 50]', 125, ', tip_relief: [0 um, 20 um], tip_relief_shape: linear'),
}
LEVELS, TRUTH = (9, 15, 21), 42
SPEEDS = range(1000, 3400, 200)  # Hz
ZETA, CYCLES, FINER = 0.05, 25, 2  # FINER: steps between two phases
GRID = np.linspace(0, 1, 401)


def run(text):
    with tempfile.NamedTemporaryFile('w', suffix='.yaml') as file:
        file.write(text)
        file.flush()
        done = subprocess.run([PROGRAM, 'run', file.name, '--json', '--arrays'], stdout=subprocess.PIPE)
    answer = json.loads(done.stdout)
    if answer['exit']:
        sys.exit(str(answer['errors']))
    found = {name: np.array(o.get('value', o.get('data'))) for name, o in answer['outputs'].items()}
    found.update({name: line['value'] for stage in answer['stages'] for name, line in stage['quality'].items() if name == 'force_levels'})
    return found


def gears(case, torque, frequency=2000):
    teeth, _, relief = CASES[case]
    return f"""format: 2
pipeline:
  gears: {{use: gear/involute-spur, teeth: {teeth}, module: 3 mm, face_width: 20 mm, pressure_angle: 20 deg, backlash: 0.14 mm{relief}}}
  duty: {{use: operating/steady, torque: {torque:.12g} N m, mesh_frequency: {frequency} Hz}}
"""


def on_grid(phase, curve, grid):
    """Of a curve with jumps where a phase stands twice; `grid` has the same ones."""
    def parts(x):
        cut = np.flatnonzero(np.diff(x) == 0) + 1
        return np.split(np.arange(len(x)), cut)
    out = np.empty(len(grid))
    for to, of in zip(parts(grid), parts(phase)):
        out[to] = np.interp(grid[to], phase[of], curve[of])
    return out


def statics(case):
    """Phases with jumps, F, and rows over the forces: s_l and dG/ds, each of a run of its own, whose breakpoints it has."""
    rows, grid = [], None
    parts = sorted({round(9 * (i / n) ** 2, 12) for n in LEVELS + (TRUTH,) for i in range(1, n + 1)})
    for part in [1] + parts:
        x = run(gears(case, CASES[case][1] * part) + '  mesh: {use: stiffness/load-distribution, compliance: analytical}\n'
                'outputs: [mesh.phase, mesh.level_error, mesh.level_stiffness, duty.line_force]\n')
        phase, levels = x['mesh.phase'], (-1, len(x['mesh.phase']))
        if grid is None:
            F = float(x['duty.line_force'])
            jumps = phase[1:][np.diff(phase) == 0]
            grid = np.sort(np.concatenate([GRID, np.repeat(jumps, 2)]))
            grid = grid[np.concatenate([[True], (np.diff(grid) > 1e-9) | (np.diff(grid) == 0)])]
            rows = [[on_grid(phase, x[name].reshape(levels)[0], grid) for name in ('mesh.level_error', 'mesh.level_stiffness')]]
            continue
        rows.append([on_grid(phase, x[name].reshape(levels)[3], grid) for name in ('mesh.level_error', 'mesh.level_stiffness')])
    return grid, F, np.array([0] + parts) * F, np.array([r[0] for r in rows]), np.array([r[1] for r in rows])


def between(force, error, slope):
    """With a point more between two forces: the knee of both tangents, where a pair touches; in the middle, halfway to the chord."""
    n, phases = error.shape
    s, G = np.empty((2 * n - 1, phases)), np.empty((2 * n - 1, phases))
    s[::2], G[::2] = error, force[:, None]
    rise, way = np.diff(force)[:, None], np.diff(error, axis=0)
    low, high = slope[:-1], slope[1:]
    part = np.clip((high - rise / way) / np.maximum(high - low, 1e-9 * high), 0, 1)
    below, chord = low * part * way, rise * part
    smooth = (abs(part - 0.5) < 0.1) * 0.5
    s[1::2] = error[:-1] + part * way
    G[1::2] = force[:-1, None] + np.minimum(below, chord) * (1 - smooth) + chord * smooth
    return s, G


def program(case, frequency, file):
    return run(gears(case, CASES[case][1], frequency) + f"""  mesh: {{use: stiffness/table, file: {file}, definition: tangent, ends: jump}}
  motion: {{use: dynamics/shooting, force: shared, max_period: 1, branch: upper, damping_ratio: {ZETA}}}
outputs: [motion.dte_rms, motion.period, motion.dte, motion.dte_velocity, motion.mesh_force, motion.contact_loss, gears.equivalent_mass,
  gears.backlash, mesh.stiffness_mean]
""")


def twin(grid, error, force, start, mass, damper, load, gap, speeds):
    """Returns the rms of s and the largest mesh force, for all speeds at once."""
    T = 1 / np.array(speeds, float)
    s, v = start.T.copy()

    def rate(x, f, lean, s, v):
        bend = s - x[0]
        g = np.abs(bend) - gap
        G = np.interp(g + x[0], x, f)
        over = g + x[0] > x[-1]
        G[over] += ((g + x[0] - x[-1]) * (f[-1] - f[-2]) / (x[-1] - x[-2]))[over]
        total = np.where(g > 0, np.copysign(G, bend), 0) + damper * (v - lean / T)
        return (load - total) / mass, total

    for _ in range(CYCLES):
        mean, square, most = 0, 0, np.zeros(len(T))
        for i in range(len(grid) - 1):
            length = grid[i + 1] - grid[i]
            if not length > 0:
                continue
            a, z, f, l = error[:, i], error[:, i + 1], force[:, i], force[:, i + 1]
            lean, h = (z[0] - a[0]) / length, length / FINER * T
            for j in range(FINER):
                x0, x1, x2 = ((a + (z - a) * p, f + (l - f) * p, lean) for p in ((j + d) / FINER for d in (0, 0.5, 1)))
                a1, total = rate(*x0, s, v)
                a2, _ = rate(*x1, s + h / 2 * v, v + h / 2 * a1)
                a3, _ = rate(*x1, s + h / 2 * v + h * h / 4 * a1, v + h / 2 * a2)
                a4, _ = rate(*x2, s + h * v + h * h / 2 * a2, v + h * a3)
                before, mid = s, s + h / 2 * v + h * h / 8 * a1
                s = s + h * v + h * h / 6 * (a1 + a2 + a3)
                v = v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
                most = np.maximum(most, total)
                w = length / FINER
                mean = mean + w * (before + 4 * mid + s) / 6
                square = square + w * (before ** 2 + 4 * mid ** 2 + s ** 2) / 6
    return np.sqrt(square - mean ** 2), most


def main():
    for case in sys.argv[2:] or CASES:
        grid, F, force, error, slope = statics(case)
        truth, lost = None, 0
        for n in sorted(LEVELS, reverse=True):
            chosen = [int(np.argmin(abs(force / F - 9 * (i / n) ** 2))) for i in range(n + 1)]
            with tempfile.NamedTemporaryFile('w', suffix='.csv') as file:
                print('force [N]; phase; loaded_transmission_error [m]; stiffness [N/m]', file=file)
                for k in chosen:
                    for x, s, slope_there in zip(grid, error[k], slope[k]):
                        print(f'{force[k]:.12g}; {x:.12g}; {s:.14g}; {slope_there:.12g}', file=file)
                file.flush()
                found = [program(case, f, file.name) for f in SPEEDS]
            at = found[0]
            mass, gap = float(at['gears.equivalent_mass']), float(at['gears.backlash']) / 2
            rms, most = (np.array([float(pick(x)) for x in found]) for pick in
                         (lambda x: x['motion.dte_rms'], lambda x: x['motion.mesh_force'].max()))
            if truth is None:
                start = np.array([[x['motion.dte'][0], x['motion.dte_velocity'][0]] for x in found])
                damper = 2 * ZETA * np.sqrt(float(at['mesh.stiffness_mean']) * mass)
                truth = twin(grid, *between(force, error, slope), start, mass, damper, F, gap, SPEEDS)
                lost = sum(float(x['motion.contact_loss']) > 0 for x in found)
            same = np.array([float(x['motion.period']) == 1 for x in found])
            off = [np.where(same, abs(a / b - 1), 0) for a, b in zip((rms, most), truth)]
            stated = np.array([x['force_levels'] for x in found])
            bar = np.where(same, abs(most - truth[1]) / F / stated, 0).max()
            print(f'| {case} | {n + 1} | {100 * off[0].max():.3f} | {100 * off[1].max():.3f} | {bar:.2f} | {same.sum()}, {lost} lose contact | '
                  f'{SPEEDS[int(off[0].argmax())]} Hz |', flush=True)


print('| pair | levels | rms, % | largest mesh force, % | its error over what force_levels states | speeds | worst |', '|---|---|---|---|---|---|---|', sep='\n')
main()
