#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""effectivity.py FLANKFILM SOURCE [--seed HEX] [--count N] [--only SORT] [--least SHARE]

Compares the errors that films state with true errors, for random scenes of several sorts: each is solved
with random numbers of cells and steps, and with four times as many of both, on the same domain. Prints
for each sort and output the ratio of the estimate (error bar over 1.5) to the error of h_min and
h_central at all instants above 2 % of the largest load; the fraction of instants with the error within
the bar; and the fraction of scenes in which this holds at 95 % of the instants. The seed is the first 8
hex digits of the tested commit. Errors below 2e-5 of the film, the tolerance of the solution, count as
within the bar and are in no ratio.
"""
import argparse
import json
import math
import os
import random
import resource
import subprocess
import sys
import tempfile

FINER = 4
LEFT = 2e-5  # of the film: what a solution leaves of the equations, and the reference of its error
CAUTION = 1.5
LONGEST = 120  # s of CPU for one film
OILS = ('gear-oil-mineral', 'gear-oil-pao', 'mil-l-23699')
SHARE = {'steady': 20, 'transient': 12, 'loss': 8, 'light': 8, 'few teeth': 8, 'statistical': 8, 'stress': 6, 'heat': 4,
         'volumes': 4, 'first order': 4, 'conserving': 4}
# these have errors from a film on half the cells, the last one by the transport of errors
FILM = {'heat': 'finite-volume, thermal: full', 'volumes': 'control-volume', 'first order': 'control-volume, wedge: first',
        'conserving': 'finite-volume, cavitation: mass-conserving'}

LINE = '''  discs: {{use: contact/constant, radius: {R:.5g} mm, entrainment_speed: {u:.5g} m/s, slide_roll_ratio: {srr:.3g}, load_per_width: {w:.5g} N/mm}}
'''
GEARS = '''  gears: {{use: gear/involute-spur, teeth: [{z[0]}, {z[1]}], module: 3 mm, face_width: 20 mm, profile_shift: [{x:.3g}, 0]}}
  duty: {{use: operating/steady, torque: {T:.5g} N m, speed: {n:.5g} rpm, oil_temperature: {temp:.4g} degC}}
  mesh: {{use: stiffness/iso-6336}}
  motion: {{use: dynamics/{motion}}}
  tooth: {{use: contact/tooth-pair, load: motion}}
'''


def log(draw, low, high):
    return math.exp(draw.uniform(math.log(low), math.log(high)))


def scene(draw, sort):
    """Returns oil, pipeline, cells and steps of a scene."""
    oil, temp = draw.choice(OILS), draw.uniform(40, 100)
    cells = draw.choice((192, 256, 384, 512))
    steps = draw.choice((0, 0, 400, 1000))  # 0: auto
    more, heat = '', f'  oil: {{temperature: {temp:.4g} degC}}\n'
    if sort == 'steady':
        body = heat + LINE.format(R=log(draw, 3, 40), u=log(draw, 0.3, 20), srr=draw.uniform(0, 0.6),
                                  w=log(draw, 20, 800))
        return oil, body, cells, steps
    few = sort == 'few teeth'
    z = draw.randint(9, 16) if few else draw.randint(20, 50)
    other = draw.randint(z, 70)
    load = draw.uniform(0.5, 3) * z
    motion = draw.choice(('quasi-static', 'shooting, damping_ratio: 0.05'))
    speed = log(draw, 300, 4000)
    if sort in ('loss', 'conserving'):
        load, motion = draw.uniform(0.15, 0.5) * z, 'shooting, damping_ratio: 0.01, branch: upper'
        motion += f', natural_frequency: {draw.uniform(2500, 4000):.4g} Hz'
        speed = draw.uniform(0.7, 1.0) * 3200 * 60 / z
    if sort == 'light':
        load *= log(draw, 1e-3, 3e-2)
    if sort == 'stress':
        more = '  flow: {use: rheology/ree-eyring, tau0: auto}\n'
    if sort == 'statistical':
        rq, speed = draw.uniform(0.05, 0.3), log(draw, 300, 1500)
        more = f'  flanks: {{use: surface/statistical, rq: [{rq:.3g} um, {rq:.3g} um], cutoff: 300 um}}\n'
    shift = max(0, 1.06 * (17 - z) / 17)
    return oil, GEARS.format(z=(z, other), x=shift, T=load, n=speed, temp=temp, motion=motion) + more, cells, steps


def run(args, sort, s, finer, domain):
    oil, body, cells, steps = s
    contact = 'discs' if 'discs' in body else 'tooth'
    time = f'steps: {finer * steps}' if steps else f'time_tolerance: {7e-3 / finer**2:.3g}'
    text = f'''format: 2
include: [{args.source}/configs/lubricants/{oil}.yaml]
pipeline:
{body}  film: {{use: ehl/{FILM.get(sort, 'finite-volume')}, cells: {finer * cells}, {time}{domain}, tolerance: 1e-6}}
outputs: [{contact}.hertz_half_width, film.time, film.load_per_width, film.x, film.h_min, film.h_central, film.h_min_error,
          film.h_central_error]
'''
    with tempfile.TemporaryDirectory() as scratch:
        name = os.path.join(scratch, 'scene.yaml')
        with open(name, 'w') as file:
            file.write(text)
        done = subprocess.run([args.program, 'run', name, '--json', '-o', os.path.join(scratch, 'r')],
                              capture_output=True, text=True,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST)))
    if done.returncode < 0:
        raise RuntimeError(f'ended after {LONGEST} s of CPU')
    answer = json.loads(done.stdout)
    if done.returncode == 2 or not answer.get('outputs'):
        raise RuntimeError((answer.get('errors') or [{}])[0].get('message', f'exit code {done.returncode}'))
    value = {k.split('.', 1)[1]: v.get('data', v.get('value')) for k, v in answer['outputs'].items()}
    value = {k: v if isinstance(v, list) else [v] for k, v in value.items()}
    if None in value.get('h_min', [None]):
        raise RuntimeError('no film')
    return value


def known(value):
    return isinstance(value, (int, float))


def at(times, values, time):
    if len(times) == 1:
        return values[0]
    k = 1
    while k + 1 < len(times) and times[k] < time:
        k += 1
    share = (time - times[k - 1]) / (times[k] - times[k - 1])
    return values[k - 1] + share * (values[k] - values[k - 1])


def judge(args, sort, s):
    """For h_min and h_central the pairs of estimate and error, relative."""
    free = run(args, sort, s, 1, '')
    a = max(free['hertz_half_width'])  # a domain that is given begins with p = 0 on all cells
    domain = f", inlet: {-free['x'][0] / a:.6g}, outlet: {free['x'][-1] / a:.6g}"
    coarse, fine = (run(args, sort, s, finer, domain) for finer in (1, FINER))
    most, pairs = max(coarse['load_per_width']), {}
    for name in ('h_min', 'h_central'):
        pairs[name] = []
        for t, load, h, bar in zip(*(coarse[k] for k in ('time', 'load_per_width', name, name + '_error'))):
            if load > 0.02 * most and known(h):  # an unknown error is one that no bar holds
                pairs[name].append((bar / CAUTION / h if known(bar) else 0, abs(h - at(fine['time'], fine[name], t)) / h))
    return pairs


def quantile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))] if values else math.nan


def row(sort, name, scenes):
    ratios, held, whole, errors = [], [], 0, []
    for pairs in scenes:
        good = [CAUTION * e >= t or t < LEFT for e, t in pairs[name]]
        share = sum(good) / max(1, len(good))
        held.append(share)
        whole += share >= 0.95
        ratios += [e / t for e, t in pairs[name] if t >= LEFT]
        errors += [t for _, t in pairs[name]]
    few, middle, many = (quantile(ratios, q) for q in (0.1, 0.5, 0.9))
    return (f'| {sort} | {name} | {len(scenes)} | {100 * quantile(errors, 0.5):.3f}, {100 * quantile(errors, 0.95):.3f} % '
            f'| {few:.2f}, {middle:.2f}, {many:.2f} | {100 * sum(held) / max(1, len(held)):.1f} % | {whole} of {len(scenes)} |')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('program')
    parser.add_argument('source', type=os.path.abspath)
    parser.add_argument('--seed', default='0')
    parser.add_argument('--count', type=int, help='scenes of each sort')
    parser.add_argument('--only', choices=SHARE)
    parser.add_argument('--least', type=float, help='exit code 1 where bars hold at a lower share of all instants')
    args = parser.parse_args()
    args.program = os.path.abspath(args.program)
    print('| sort | output | films | error: median, 95 % | estimate over error: 10 %, median, 90 % | bars hold | films with 95 % |')
    print('|---|---|---|---|---|---|---|')
    left_out, low = [], 0
    for sort, count in SHARE.items():
        if args.only and sort != args.only:
            continue
        draw, scenes = random.Random(f'{args.seed} {sort}'), []
        for k in range(args.count or count):
            try:
                scenes.append(judge(args, sort, scene(draw, sort)))
            except (RuntimeError, ValueError) as e:
                left_out.append(f'{sort} {k + 1}: {e}')
        for name in ('h_min', 'h_central'):
            if scenes:
                print(row(sort, name, scenes), flush=True)
                good = [CAUTION * e >= t or t < LEFT for pairs in scenes for e, t in pairs[name]]
                low += args.least is not None and sum(good) < args.least * len(good)
    for line in left_out:
        print(f'left out: {line}')
    print(f'{sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2]):.0f} s of CPU', file=sys.stderr)
    return 1 if low else 0


if __name__ == '__main__':
    sys.exit(main())
