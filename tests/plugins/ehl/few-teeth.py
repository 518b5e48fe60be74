#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""few-teeth.py FLANKFILM SOURCE [--only TEXT] [--times N] [--set STAGE.NAME=VALUE]...

The film at both ends of a tooth: gears of 8 to 40 teeth (z) with 60, in both orders, at 1, 0.03 and
1e-3 times 2.5 z N m, a gear pair of a watch and one of a mill. Compares h_min_lowest, and h_central at
SAP and at the last instant, on the default cells and on N (8) times as many cells with the same inlet.
Each row has the part of the film that both state as missing because of the inlet, and the doubtful lines.
"""
import argparse
import json
import os
import resource
import subprocess
import tempfile

CELLS = 512  # the preset
LIMIT = {1: 0.01, 0.03: 0.03, 1e-3: 0.03}
SOLID = 'gears: {{use: gear/involute-spur, teeth: [{z[0]}, {z[1]}], module: {m:g} mm, ' \
        'face_width: {b:g} mm, profile_shift: [{x[0]:g}, {x[1]:g}]}}'


def pair(z, wheel_drives, load, m=3, b=20, torque=None, rpm=1500):
    """The pinion has z teeth, just shifted enough to be free of undercut."""
    shift = round(max(0, 1.06 * (17 - z) / 17), 3)
    torque = (2.5 * z if torque is None else torque) * load
    if wheel_drives:
        return {'z': (60, z), 'x': (0, shift), 'm': m, 'b': b, 'torque': torque * 60 / z,
                'rpm': rpm * z / 60}
    return {'z': (z, 60), 'x': (shift, 0), 'm': m, 'b': b, 'torque': torque, 'rpm': rpm}


def scenes():
    for load in (1, 0.03, 1e-3):
        for z in (8, 12, 17, 25, 40):
            for wheel in (False, True):
                yield f'{60 if wheel else z}/{z if wheel else 60} x {load:g}', load, pair(z, wheel, load)
    for wheel in (False, True):
        name = 'wheel drives' if wheel else 'pinion drives'
        for rpm in (60, 6000):
            yield f'watch {rpm} rpm, {name}', 1, pair(12, wheel, 1, 0.12, 0.3, 20e-6, rpm)
        yield f'mill, {name}', 1, pair(20, wheel, 1, 30, 500, 250e3, 100)


def run(program, source, s, settings):
    text = f"""format: 2
include: [{source}/configs/lubricants/gear-oil-mineral.yaml]
pipeline:
  {SOLID.format(**s)}
  duty: {{use: operating/steady, torque: {s['torque']:.8g} N m, speed: {s['rpm']:.8g} rpm, oil_temperature: 60 degC}}
  mesh: {{use: stiffness/load-distribution}}
  motion: {{use: dynamics/quasi-static}}
  tooth: {{use: contact/tooth-pair, load: motion}}
  film: {{use: ehl/finite-volume}}
outputs: [film.h_min_lowest, film.h_central, film.h_min]
"""
    with tempfile.TemporaryDirectory() as scratch:
        name = os.path.join(scratch, 'scene.yaml')
        with open(name, 'w') as file:
            file.write(text)
        command = [program, 'run', name, '-o', os.path.join(scratch, 'out'), '--json', '--arrays']
        for one in settings:
            command += ['--set', one]
        done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        return None, done.stderr.strip().splitlines()[:3]
    result = json.loads(done.stdout)
    out = result['outputs']
    h = out['film.h_central']
    h = h.get('value', h.get('data'))
    low = out['film.h_min_lowest']
    low = low.get('value', low.get('data'))
    film = [stage for stage in result['stages'] if stage['stage'] == 'film'][0]
    lines = {name: (line['value'], line['verdict']) for name, line in film['quality'].items()}
    return {'low': low, 'sap': h[0], 'tip': h[-1], 'lines': lines}, None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument('program')
    parser.add_argument('source')
    parser.add_argument('--only', default='')
    parser.add_argument('--times', type=int, default=8)
    parser.add_argument('--set', action='append', default=[])
    args = parser.parse_args()
    source = os.path.abspath(args.source)
    missed = rows = 0
    print('| teeth, load | h_min_lowest, nm | off, % | h(0) at SAP, % | at the last instant, % | starvation, % | doubted |')
    print('|---|---|---|---|---|---|---|')
    for name, load, s in scenes():
        if args.only not in name:
            continue
        plain, why = run(args.program, source, s, args.set)
        fine, said = run(args.program, source, s, [f'film.cells={args.times * CELLS}'])
        rows += 1
        if not plain or not fine:
            missed += 1
            print(f'| {name} | refused: {why or said} | | | | | MISSED |', flush=True)
            continue
        off = [100 * (plain[k] / fine[k] - 1) for k in ('low', 'sap', 'tip')]
        bad = max(abs(off[0]), abs(off[1])) > 100 * LIMIT[load]
        missed += bad
        starved = [100 * x['lines'].get('starvation', (0,))[0] for x in (plain, fine)]
        doubted = ' '.join(k for k, v in plain['lines'].items() if v[1] not in ('good', ''))
        print(f"| {name} | {1e9 * fine['low']:.4g} | {off[0]:+.2f} | {off[1]:+.2f} | {off[2]:+.2f} | "
              f"{starved[0]:.2f}, {starved[1]:.3f} | {'MISSED ' if bad else ''}{doubted} |", flush=True)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f'{rows} gears, {missed} missed or refused, {used.ru_utime + used.ru_stime:.0f} s of CPU')


main()
