#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""random-friction.py FLANKFILM SOURCE [--count N] [--first K]

Friction of gears and oils at random: 18 to 60 teeth, module 1 to 10 mm, Hertz pressures of 0.3 to
2.5 GPa at the pitch point, 0.1 to 50 m/s there, four base oils of seven grades at 20 to 130 degC, Ra
0.05 to 2 um, by formulas of the film: cold or with the heat of the contact, smooth or with
statistical asperities, with the law of flow of the card, a Newtonian one among it. A friction
coefficient above 0.2 under more than 1 % of the largest load must be reported by a quality line, and a run
that fails must give a message. Prints a summary."""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

MOST = 0.2
MODULUS = 226e9
OILS = ['mineral', 'pao', 'ester', 'pag']
GRADES = [32, 46, 68, 100, 150, 220, 320]


def halton(index, base):
    part, value = 1 / base, 0
    while index:
        value += part * (index % base)
        index //= base
        part /= base
    return value


def between(low, high, share):
    return low * (high / low) ** share


def scene(k, source):
    """Returns the file of case k."""
    share = [halton(k + 1, base) for base in (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31)]
    z = [round(between(18, 60, share[0]))]
    z.append(round(z[0] * between(1, 5, share[1])))
    m, hertz, speed = between(1, 10, share[2]), between(0.3e9, 2.5e9, share[3]), between(0.1, 50, share[4])
    oil, grade = OILS[int(4 * share[5])], GRADES[int(7 * share[6])]
    degrees, rough = 20 + 110 * share[7], between(0.05, 2, share[8])
    flow = ['ree-eyring', 'ree-eyring', 'carreau', 'newtonian'][int(4 * share[9])]
    thermal, asperities = ['none', 'local'][k % 2], share[10] < 0.5
    radius = m * z[0] * z[1] / sum(z) / 2 * math.sin(math.radians(20)) * 1e-3
    torque = (2 * math.pi * hertz ** 2 * radius / MODULUS * 10 * m * 1e-3 * z[0] * m * 1e-3 / 2
              * math.cos(math.radians(20)))
    rpm = speed / (z[0] * m * 1e-3 / 2) * 30 / math.pi
    flanks = f'\n  flanks: {{use: surface/statistical, rq: {1.25 * rough:.4g} um}}' if asperities else ''
    gears = '' if asperities else f', roughness_ra: {rough:.4g} um'
    wanted = ', film.asperity_load_share' if asperities else ''
    return f"""format: 2
include: [{source}/configs/lubricants/gear-oil-{oil}.yaml]
pipeline:
  gears: {{use: gear/involute-spur, teeth: {z}, module: {m:.6g} mm, face_width: {10 * m:.6g} mm, backlash: {0.05 * m:.6g} mm, material: 16MnCr5{gears}}}
  oil: {{grade: ISO VG {grade}{', conductivity: 0.15 W/(m K)' if oil == 'pag' else ''}}}
  flow: {{use: rheology/{flow}}}
  duty: {{use: operating/steady, torque: {torque:.6g} N m, speed: {rpm:.6g} rpm, oil_temperature: {degrees:.4g} degC}}
  mesh: {{use: stiffness/iso-6336}}
  tooth: {{use: contact/tooth-pair, load: mesh}}{flanks}
  film: {{use: ehl/film-formula, thermal: {thermal}}}
  losses: {{use: losses/tooth-mesh}}
outputs: [film.friction_coefficient, tooth.load_per_width, losses.friction_coefficient_mean{wanted}]
"""


def run(program, folder, text):
    """(verdict, the largest |mu| or None, what is to be said about it)."""
    path = os.path.join(folder, 'case.yaml')
    with open(path, 'w') as out:
        out.write(text)
    done = subprocess.run([program, 'run', path, '--json', '--arrays'], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1, 2):
        return 'wrong', None, f'exit {done.returncode}: {(done.stderr or done.stdout)[-300:]}'
    answer = json.loads(done.stdout)
    if done.returncode:
        said = [e['message'] for e in answer['errors']]
        if not (said and all(said)):
            return 'wrong', None, 'fails without a sentence'
        return ('said' if 'friction_bound' in said[0] else 'refused'), None, said[0]
    friction, load = (answer['outputs'][o]['data'] for o in ('film.friction_coefficient', 'tooth.load_per_width'))
    if len(friction) != len(load) or not all(x is not None and math.isfinite(x) for x in friction):
        return 'wrong', None, 'friction is no number'
    highest = max(abs(x) for x, w in zip(friction, load) if w > 0.01 * max(load))
    quality = next(s for s in answer['stages'] if s['stage'] == 'losses')['quality']
    if highest <= MOST:
        return 'held', highest, ''
    said = quality['friction_bound']['verdict'] != 'good'
    return ('said' if said else 'silent'), highest, quality['friction_bound']['verdict']


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('source')
    parser.add_argument('--count', type=int, default=200)
    parser.add_argument('--first', type=int, default=0)
    asked = parser.parse_args()
    program, source = os.path.abspath(asked.program), os.path.abspath(asked.source)
    counts, worst = {}, 0
    with tempfile.TemporaryDirectory() as folder:
        for k in range(asked.first, asked.first + asked.count):
            verdict, highest, text = run(program, folder, scene(k, source))
            counts[verdict] = counts.get(verdict, 0) + 1
            worst = max(worst, highest or 0)
            if verdict != 'held':
                print(f'{k}: {verdict}, {highest}: {text}')
    print(', '.join(f'{n} {v}' for v, n in sorted(counts.items())), f'; largest mu {worst:.4g}')
    return 1 if counts.get('silent') or counts.get('wrong') else 0


if __name__ == '__main__':
    sys.exit(main())
