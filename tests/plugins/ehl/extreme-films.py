#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""extreme-films.py FLANKFILM SOURCE [--gears] [--count N] [--first K]

Steady films of extreme contacts: R 0.1 to 300 mm, Hertz pressures of 1 MPa to 4 GPa,
1e-3 to 100 m/s, 1e-4 to 1e3 Pa s, slide-roll 0 to 1.99, at corners of that box and inside it, on
presets and on four times the cells. With --gears passages of a tooth of steel gears of module 0.1 to
24 mm, 8 to 60 teeth, contact ratio 1.04 to 2.33, 0.1 to 1.5 GPa and 0.1 to 50 m/s. No run may crash, hang or give NaN; if all quality
lines are good, the errors of film and pressure must be within the limits of these lines; a run that
fails must give a message.
"""
import argparse
import json
import math
import os
import resource
import subprocess
import sys
import tempfile

MODULUS = 226e9  # Pa, steel
CELLS, FINER = 512, 4
SECONDS = 120  # of CPU time: a stage that takes longer is ended, with exit code 3
# of the lines, and what 2048 cells leave
LIMITS = {'h_min': 0.03, 'h_central': 0.03, 'p_max': 0.12, 'h_min_lowest': 0.03,
          'p_max_highest': 0.12}


def halton(index, base):
    part, value = 1 / base, 0
    while index:
        value += part * (index % base)
        index //= base
        part /= base
    return value


def between(low, high, share):
    return low * (high / low) ** share


def scene(k):
    """The first 36 are corners of the box, the rest lie inside it."""
    if k < 36:
        bits = [(k * 7 + 3) >> i & 1 for i in range(4)]
        share = [float(b) for b in bits] + [(k % 3) / 2]
    else:
        share = [halton(k, base) for base in (2, 3, 5, 7, 11)]
    return {'radius': between(1e-4, 0.3, share[0]), 'hertz': between(1e6, 4e9, share[1]),
            'speed': between(1e-3, 100, share[2]), 'eta0': between(1e-4, 1e3, share[3]),
            'slide': 1.99 * share[4]}


def case(s):
    load = 2 * math.pi * s['hertz'] ** 2 * s['radius'] / MODULUS
    u1, u2 = s['speed'] * (1 + s['slide'] / 2), s['speed'] * (1 - s['slide'] / 2)
    return f"""format: 2
pipeline:
  contact: {{use: contact/constant, radius: {s['radius']:.8g} m, speed_1: {u1:.8g} m/s, speed_2: {u2:.8g} m/s, load_per_width: {load:.8g} N/m, reduced_modulus: 226 GPa}}
  viscosity: {{use: viscosity/roelands, eta0: {s['eta0']:.8g} Pa s, z: 0.6}}
  density: {{use: density/dowson-higginson, rho0: 870 kg/m3}}
  film: {{use: ehl/finite-volume}}
outputs: [film.h_min, film.h_central, film.p_max]
"""


def gears(k):
    """Returns random numbers of teeth, module, addendum, Hertz pressure and speed at the pitch point."""
    share = [halton(k + 1, base) for base in (2, 3, 5, 7, 11, 13)]
    z1 = round(between(8, 60, share[0]))
    return {'z1': z1, 'ratio': between(1, 6, share[1]), 'module': between(0.1, 30, share[2]),
            'addendum': 0.8 + 0.65 * share[3] * min(1, max(0, z1 - 8) / 22),
            'hertz': between(0.1e9, 1.5e9, share[4]), 'speed': between(0.1, 50, share[5])}


def gear_case(s, source):
    z = [s['z1'], round(s['z1'] * s['ratio'])]
    m, shift = s['module'], max(0, (18 - s['z1']) / 17)
    shifts = [shift, -shift if z[1] > 34 else 0]
    centre = m * sum(z) / 2 if z[1] > 34 else None
    tips = [m * (n + 2 * (s['addendum'] + x)) for n, x in zip(z, shifts)]
    radius = m * z[0] * z[1] / sum(z) / 2 * math.sin(math.radians(20)) * 1e-3
    torque = (2 * math.pi * s['hertz'] ** 2 * radius / MODULUS * 10 * m * 1e-3
              * z[0] * m * 1e-3 / 2 * math.cos(math.radians(20)))
    rpm = s['speed'] / (z[0] * m * 1e-3 / 2) * 30 / math.pi
    distance = f', centre_distance: {centre:.8g} mm' if centre else ''
    return f"""format: 2
include: [{source}/configs/lubricants/gear-oil-mineral.yaml]
pipeline:
  gears: {{use: gear/involute-spur, teeth: {z}, module: {m:.6g} mm, face_width: {10 * m:.6g} mm, backlash: {0.05 * m:.6g} mm,
          dedendum: {s['addendum'] + 0.25:.4g}, profile_shift: [{shifts[0]:.6g}, {shifts[1]:.6g}], tip_diameter: [{tips[0]:.8g} mm, {tips[1]:.8g} mm]{distance}}}
  duty: {{use: operating/steady, torque: {torque:.6g} N m, speed: {rpm:.6g} rpm, oil_temperature: 60 degC}}
  mesh: {{use: stiffness/load-distribution}}
  motion: {{use: dynamics/quasi-static}}
  tooth: {{use: contact/tooth-pair, load: motion}}
  viscosity: {{use: viscosity/roelands}}
  film: {{use: ehl/finite-volume, contact: tooth}}
outputs: [film.h_min_lowest, film.p_max_highest, gears.contact_ratio]
"""


def run(program, folder, text, cells):
    """The values, and the names of the lines that are not good; or what the run says, and what is
    wrong with that, if anything."""
    path = os.path.join(folder, 'case.yaml')
    with open(path, 'w') as out:
        out.write(text)
    limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 1))
    done = subprocess.run([program, 'run', path, f'--set=film.cells={cells}', '--json'], cwd=folder,
                          capture_output=True, text=True, check=False, preexec_fn=limit)
    if done.returncode not in (0, 1):
        return None, [], f'exit {done.returncode}: {(done.stderr or done.stdout)[-300:]}'
    answer = json.loads(done.stdout)
    said = [m['message'] for m in answer['errors']]
    if done.returncode == 1:
        return None, said, None if said and all(said) else 'fails without a sentence'
    values = {}
    for output in LIMITS:
        of = answer['outputs'].get(f'film.{output}', {})
        values |= {output: of.get('value', of.get('data', [None])[0])} if of else {}
    quality = next(x for x in answer['stages'] if x['stage'] == 'film')['quality']
    other = 'inlet_heating'  # no error of cells or ends
    lines = [n for n, line in quality.items() if line.get('of') == 'numbers' and n != other]
    bad = [o for o, v in values.items() if not (v and math.isfinite(v) and v > 0)]
    below = [n for n, output in answer['outputs'].items() if output.get('at_least')]
    return (values, quality, below), lines, f'{bad} is no number' if bad else None


def judge(program, folder, text):
    """(verdict, text, outputs of which a bound alone is known) of a scene."""
    here, lines, wrong = run(program, folder, text, CELLS)
    if wrong:
        return 'wrong', wrong, []
    if not here:
        return 'refused', lines[0], []
    fine, _, wrong = run(program, folder, text, FINER * CELLS)
    if wrong:
        return 'wrong', f'on {FINER} times the cells: {wrong}', here[2]
    if not fine:
        return 'open', 'no film on more cells', here[2]
    off = {o: abs(fine[0][o] / v - 1) for o, v in here[0].items()}
    beyond = {o: f'{100 * v:.2g} %' for o, v in off.items() if v > LIMITS[o]}
    if not beyond:
        return 'held', '', here[2]
    return ('said' if lines else 'silent'), f'{beyond}; {lines}', here[2]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('program')
    parser.add_argument('source')
    parser.add_argument('--gears', action='store_true')
    parser.add_argument('--count', type=int, help='108, of gears 34')
    parser.add_argument('--first', type=int, default=0)
    args = parser.parse_args()
    program, source, counts = os.path.abspath(args.program), os.path.abspath(args.source), {}
    bounds = []
    with tempfile.TemporaryDirectory() as folder:
        count = args.count or (34 if args.gears else 108)
        for k in range(args.first, args.first + count):
            drawn = gears(k) if args.gears else scene(k)
            verdict, text, below = judge(program, folder, gear_case(drawn, source) if args.gears else case(drawn))
            counts[verdict] = counts.get(verdict, 0) + 1
            bounds += [k] if below else []
            if verdict != 'held':
                words = ' '.join(f'{n} {v:.3g}' for n, v in drawn.items())
                print(f'{k}: {verdict}: {text} ({words})', flush=True)
    print(', '.join(f'{n} {verdict}' for verdict, n in sorted(counts.items())))
    print(f'known from below alone: {len(bounds)} of {count}', *bounds)
    sys.exit(1 if counts.get('wrong') or counts.get('silent') else 0)


if __name__ == '__main__':
    main()
