#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The effect of a tooth with a pitch error on the motion, over all mesh cycles until the same teeth meet again.

A motion of the program repeats one mesh cycle (parameter mesh_cycle). Here, the period is a revolution of gear 1: the curves of its 25
mesh cycles in succession become a table of one long cycle, at 1/25 of the frequency. Prints the rms transmission error and the largest
mesh force of the short and the long motion for some pitch errors. Not in the test suite.

hunting.py FLANKFILM
"""
import json
import subprocess
import sys
import tempfile

TEETH = 25
HEAD = """format: 2
pipeline:
  gears: {{use: gear/involute-spur, teeth: [25, 50], module: 3 mm, face_width: 20 mm, backlash: 0.14 mm, pitch_error: [{} um],
    tip_relief: [20 um, 15 um], tip_relief_shape: linear}}
  duty: {{use: operating/steady, torque: 125 N m, mesh_frequency: {} Hz}}
"""
MESH = '  mesh: {{use: stiffness/load-distribution, compliance: analytical, mesh_cycle: {}, points: 100}}\n'
MOTION = '  motion: {use: dynamics/shooting, damping_ratio: 0.03, max_period: 1}\n'
SEEN = ['motion.dte_rms', 'motion.mesh_force', 'motion.contact_loss', 'duty.line_force']


def run(text, names):
    with tempfile.NamedTemporaryFile('w', suffix='.yaml') as file:
        file.write(text + f'outputs: [{", ".join(names)}]\n')
        file.flush()
        done = subprocess.run([sys.argv[1], 'run', file.name, '--json', '--arrays'], stdout=subprocess.PIPE)
    answer = json.loads(done.stdout)
    if answer['exit']:
        sys.exit(str(answer['errors']))
    return [answer['outputs'][n].get('value', answer['outputs'][n].get('data')) for n in names]


def show(rms, force, loss, line):
    return f'{1e6 * rms:.3f} um, {max(force) / line:.3f} F, {100 * loss:.1f} % apart'


def main():
    curves = ['mesh.phase', 'mesh.stiffness', 'mesh.transmission_error', 'mesh.loaded_transmission_error']
    print('| pitch error, um | mesh frequency, Hz | mesh cycle 0 alone | all 25 |', '|---|---|---|---|', sep='\n')
    for error in 0, 3, 6, 12:
        with tempfile.NamedTemporaryFile('w', suffix='.csv') as file:
            print('phase; stiffness [N/m]; transmission_error [m]; loaded_transmission_error [m]', file=file)
            for cycle in range(TEETH):
                for x, *rest in zip(*run(HEAD.format(error, 1500) + MESH.format(cycle if error else 0), curves)):
                    print(f'{(cycle + x) / TEETH:.14g}; ' + '; '.join(f'{y:.12g}' for y in rest), file=file)
            file.flush()
            for frequency in 800, 1500, 2200:
                one = run(HEAD.format(error, frequency) + MESH.format(0) + MOTION, SEEN)
                table = f'  mesh: {{use: stiffness/table, file: {file.name}, definition: tangent, ends: jump}}\n'
                every = run(HEAD.format(error, frequency / TEETH) + table + MOTION, SEEN)
                print(f'| {error} | {frequency} | {show(*one)} | {show(*every)} |', flush=True)


main()
