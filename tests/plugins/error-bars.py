#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random scenes with `accuracy: 10 %`, 2 % and 0.5 %: are true errors within the error bars, and the bars within the accuracy?

error-bars.py FLANKFILM SOURCE [--seed HEX] [--first N] [--count N] [--longest S] [--loose] [--cache FOLDER] [--table FILE.csv]

A scene is drawn by the seed and its number. Scenes with odd numbers are typical gears of 18 to 45 teeth at 0.4 to 1.2 GPa and 1 to 20 m/s;
one in four is lightly loaded, one in four has a pinion of 9 to 16 teeth. Even ones are extreme: gear pairs of 17 to 80 teeth, modules of 1 to
8 mm, with relief and index errors, pitch line speeds from 0.3 to 40 m/s, Hertz pressures from 0.2 to 2 GPa, quasi-static and dynamic motions;
steady contacts; histories from 1e-5 to 1e3 s, smooth and with jumps. One in eight of all has a heated film, one in eight rough flanks.
Each is solved to three accuracies with the settings that the program chooses, and once refined: eight times the cells and counts of the
presets (four times the steps of a motion), a tenth of the time tolerance; half of these cells if that takes too long. The reference
has a measured error, too; if it is above a quarter of the accuracy, or the film of the answer has as many cells, the output is listed
as open and not judged. An error bar above the accuracy counts as a refusal; it is judged like the others.

A scalar is within its bar if |answer - reference| <= bar + error of the reference. For a series, the fraction of points within their bars
is found; from 0.2 passages of the oil before a jump of a history to 1.2 after it, a shift along the series of up to 0.2 passages is allowed.
--cache stores results, so that an interrupted campaign can be continued.

Cost is the CPU time of all runs of an answer over that of the first, which has the presets. The allowed cost is 1.4 if the presets
are the answer and reach every goal, else 1.4 times (1 + cost of the chosen settings).
--lattice also compares the cost with the cheapest of six fixed settings of the film for which it and all finer settings reach the accuracy,
in each output whose error bar is within the accuracy: a user who had tried all would choose it.
"""
import argparse
import bisect
import collections
import csv
import json
import math
import os
import random
import re
import resource
import signal
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from scenes import LAWS, OILS, TEMPERATURES  # noqa: E402

SCALARS = ['film.h_min_lowest', 'film.p_max_highest', 'motion.dte_rms', 'motion.dynamic_factor_tooth',
           'mesh.stiffness_mean']
SERIES = ['film.h_min', 'film.h_central', 'film.p_max', 'film.friction_coefficient', 'film.power_loss']
GOALS = {'10 %': 0.1, '2 %': 0.02, '0.5 %': 0.005}
REFERENCES = {cells: f'cells: {cells}, time_tolerance: 7e-4, tolerance: 1e-7' for cells in (4096, 2048)}
LATTICE = [(128, 2.8e-2), (256, 2.8e-2), (256, 7e-3), (512, 7e-3), (512, 1.75e-3), (1024, 3.5e-3)]
COST = 1.4  # over the first run, and over (1 + cost of the settings chosen)
FINE = {'gears': 'stations: 6400', 'mesh': 'points: 1600', 'tooth': 'points: 32000'}
SHIFT = 0.2  # of a passage, along a series, at jumps
STEEL = 226.4e9  # Pa, reduced modulus


def cpu_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def limit_cpu(longest):
    resource.setrlimit(resource.RLIMIT_CPU, (longest, longest + 1))


def log_uniform(r, low, high):
    return math.exp(r.uniform(math.log(low), math.log(high)))


def oil_of(r):
    oil = r.choice(OILS)
    return oil, r.choice(LAWS), r.random() < 0.7


def typical_gears(r):
    """Steel gears as they are drawn, for the most part at presets."""
    few, light = r.random() < 0.25, r.random() < 0.25
    z1 = r.randint(9, 16) if few else r.randint(18, 45)
    z2 = round(z1 * r.uniform(1.05, 4)) if not few else r.randint(30, 70)
    module = r.choice([1.5, 2, 2.5, 3, 4, 5])
    width = module * r.uniform(6, 14)
    radius = module * z1 * z2 / (z1 + z2) / 2 * math.sin(math.radians(20))
    pressure = log_uniform(r, 0.05, 0.2) if light else r.uniform(0.4, 1.2)
    torque = 2 * math.pi * radius * pressure ** 2 / 226.4 * width * z1 * module / 2 * math.cos(math.radians(20))
    rpm = log_uniform(r, 1, 20) * 1e3 / (z1 * module / 2) * 60 / (2 * math.pi)
    shift = min(0.1 + (17 - z1) / 17, 0.6) if few else 0
    motion = r.choice(['quasi-static', 'shooting, damping_ratio: 0.06'])
    oil, law, shear = oil_of(r)
    return {'kind': f"typical gears{', few teeth' if few else ''}{', light load' if light else ''}", 'oil': oil, 'law': law, 'shear': shear,
            'stages': {
                'gears': f'use: gear/involute-spur, teeth: [{z1}, {z2}], module: {module} mm, face_width: {width:.3f} mm, '
                         f'profile_shift: [{shift:.3f}, 0]',
                'duty': f'use: operating/steady, torque: {torque:.5g} N m, speed: {rpm:.5g} rpm, oil_temperature: {TEMPERATURES[oil]}',
                'mesh': f"use: stiffness/{r.choice(['load-distribution', 'iso-6336', 'potential-energy'])}",
                'motion': f'use: dynamics/{motion}',
                'tooth': 'use: contact/tooth-pair, load: motion'}, 'outputs': SCALARS + SERIES}


def gear_scene(r):
    z1 = r.randint(17, 80)
    z2 = min(max(17, round(z1 * r.choice([1, 1, 1.5, 2, 3]))), 160)
    module = r.choice([1, 1.5, 2, 3, 4, 5, 6, 8])
    width = module * r.uniform(5, 12)
    radius = module * z1 * z2 / (z1 + z2) / 2 * math.sin(math.radians(20))
    pressure = log_uniform(r, 0.2, 2)
    torque = 2 * math.pi * radius * pressure ** 2 / 226.4 * width * z1 * module / 2 * math.cos(math.radians(20))
    rpm = log_uniform(r, 0.3, 40) * 1e3 / (z1 * module / 2) * 60 / (2 * math.pi)
    relief = r.choice([0, 0, r.uniform(5, 40)])
    index = [r.gauss(0, 4) for _ in range(z1)] if r.random() < 0.2 else []
    motion = r.choice(['quasi-static', 'shooting', 'time-integration'])
    gears = f'use: gear/involute-spur, teeth: [{z1}, {z2}], module: {module} mm, face_width: {width:.3f} mm, ' \
            f'backlash: {0.04 * module:.4f} mm, tip_relief: {relief:.1f} um'
    if index:
        gears += f", pitch_error: [{', '.join(f'{x:.2f} um' for x in index)}]"
    oil, law, shear = oil_of(r)
    return {'kind': f'gears, {motion}', 'oil': oil, 'law': law, 'shear': shear, 'stages': {
        'gears': gears,
        'duty': f'use: operating/steady, torque: {torque:.5g} N m, speed: {rpm:.5g} rpm, '
                f'oil_temperature: {TEMPERATURES[oil]}',
        'mesh': 'use: stiffness/potential-energy',
        'motion': f'use: dynamics/{motion}' + ('' if motion == 'quasi-static' else ', damping_ratio: 0.04'),
        'tooth': 'use: contact/tooth-pair, load: motion'}, 'outputs': SCALARS + SERIES}


def history(r):
    """Returns rows of a history: time, radius, both speeds, load."""
    span, radius = log_uniform(r, 1e-5, 1e3), log_uniform(r, 2, 50)
    load = 2 * math.pi * radius * log_uniform(r, 0.2, 2) ** 2 / 226.4 * 1e3
    speed, slip = log_uniform(r, 0.3, 40), r.uniform(-0.5, 0.5)
    rows, jumps = [], r.random() < 0.3
    waves = [(r.uniform(0.05, 0.4), r.randint(1, 3), r.uniform(0, 2 * math.pi)) for _ in range(2)]
    at, after = r.uniform(0.3, 0.7), r.uniform(0.5, 1.6)
    for k in range(61):
        t = k / 60
        factor = 1 + sum(a * math.sin(2 * math.pi * n * t + p) for a, n, p in waves)
        row = [t * span, radius, speed * (1 + slip / 2), speed * (1 - slip / 2), load * max(factor, 0.05)]
        if jumps and t > at:
            if rows[-1][0] < at * span:
                rows.append([at * span] + rows[-1][1:])
                rows.append([at * span] + rows[-1][1:4] + [rows[-1][4] * after])
            row[4] *= after
        rows.append(row)
    return rows, jumps


def other_scene(r):
    oil, law, shear = oil_of(r)
    scene = {'oil': oil, 'law': law, 'shear': shear, 'outputs': SCALARS[:2] + SERIES,
             'stages': {'oil': f'temperature: {TEMPERATURES[oil]}'}}
    if r.random() < 0.4:
        radius = log_uniform(r, 2, 50)
        load = 2 * math.pi * radius * log_uniform(r, 0.2, 2) ** 2 / 226.4 * 1e3
        scene['kind'] = 'steady'
        scene['stages']['tooth'] = f'use: contact/constant, radius: {radius:.4g} mm, entrainment_speed: ' \
            f'{log_uniform(r, 0.3, 40):.4g} m/s, slide_roll_ratio: {r.uniform(0, 0.5):.3f}, load_per_width: {load:.5g} N/mm'
    else:
        scene['rows'], jumps = history(r)
        scene['kind'] = f"history of {scene['rows'][-1][0]:.1e} s{', a jump' if jumps else ''}"
        scene['stages']['tooth'] = 'use: contact/table, file: history.csv'
    return scene


def draw(seed, number):
    r = random.Random(f'{seed} {number}')
    scene = typical_gears(r) if number % 2 else gear_scene(r) if r.random() < 0.6 else other_scene(r)
    also = r.choice(['', '', '', '', '', '', 'hot', 'rough'])
    scene['film'] = ''
    if also == 'hot':  # oils that are known at more than one temperature
        scene['film'] = ', thermal: full'
        scene['oil'] = r.choice(['gear-oil-mineral', 'vg-100-pao'])
        for stage in ('duty', 'oil'):
            if stage in scene['stages']:
                scene['stages'][stage] = re.sub('temperature: .*', 'temperature: 80 degC', scene['stages'][stage])
    if also == 'rough':
        scene['stages']['flanks'] = f'use: surface/statistical, rq: [{r.uniform(0.1, 0.5):.2f} um, {r.uniform(0.1, 0.5):.2f} um], cutoff: 300 um'
    scene['kind'] += f', {also}' if also else ''
    scene['number'] = number
    return scene


class Runner:
    def __init__(self, program, source, longest):
        self.program, self.source, self.folder = program, os.path.abspath(source), tempfile.mkdtemp()
        self.longest = longest

    def write(self, scene, accuracy, film, finest):
        film += scene['film'] if film else scene['film'][2:]
        stages = {name: text + (', ' + FINE[name] if finest and name in FINE and not (
            name == 'tooth' and 'tooth-pair' not in text) else '') for name, text in scene['stages'].items()}
        if finest and 'damping_ratio' in stages.get('motion', ''):
            stages['motion'] += ', steps_per_cycle: 2048'
        if 'rows' in scene:
            with open(os.path.join(self.folder, 'history.csv'), 'w') as out:
                out.write('time [s],radius [mm],speed_1 [m/s],speed_2 [m/s],load_per_width [N/mm]\n')
                out.writelines(','.join(f'{x:.10g}' for x in row) + '\n' for row in scene['rows'])
        stages['viscosity'] = f"use: viscosity/{scene['law']}"
        stages['film'] = f"use: ehl/finite-volume{', ' if film else ''}{film}" + ('' if scene['shear'] else ', rheology: none')
        names = scene['outputs'] + ['film.time', 'tooth.hertz_half_width', 'tooth.entrainment_speed']
        with open(os.path.join(self.folder, 'scene.yaml'), 'w') as out:
            goals = ', '.join(f'{name}: {accuracy}' for name in scene['outputs'])
            out.write('format: 2\n' + (f'accuracy: {{{goals}}}\n' if accuracy[:1].isdigit() else 'accuracy: measured\n' if accuracy else ''))
            out.write(f"include: [{self.source}/configs/lubricants/{scene['oil']}.yaml]\npipeline:\n")
            out.writelines(f'  {name}: {{{text}}}\n' for name, text in stages.items())
            out.write(f"outputs: [{', '.join(names)}]\n")

    def run(self, scene, accuracy, film='', finest=False):
        self.write(scene, accuracy, film, finest)
        before = cpu_of_children()
        done = subprocess.run([self.program, 'run', os.path.join(self.folder, 'scene.yaml'), '--json', '--arrays'],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False,
                              preexec_fn=lambda: limit_cpu(self.longest))
        if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            return {'status': 'too long', 'why': f'more than {self.longest} s'}
        used = cpu_of_children() - before
        try:
            answer = json.loads(done.stdout)
        except ValueError:
            return {'status': 'crashed', 'why': done.stderr[-500:]}
        if answer['status'] != 'ok':
            return {'status': answer['status'], 'why': str((answer.get('errors') or [''])[0])}
        found = {'status': 'ok', 'outputs': {}, 'twins': answer['accuracy'] or {}, 'cpu': used}
        for name, row in answer['outputs'].items():
            error = row.get('error') or {}
            found['outputs'][name] = {'value': row.get('value', row.get('data')), 'shape': row.get('shape'),
                                      'bar': error.get('value', error.get('data')), 'order': error.get('order'),
                                      'relative': error.get('relative'), 'parts': error.get('parts')}
        return found


def sample(times, values, at):
    i = min(max(bisect.bisect_right(times, at), 1), len(times) - 1)
    span = times[i] - times[i - 1]
    share = min(max((at - times[i - 1]) / span, 0), 1) if span > 0 else 1
    return values[i - 1] + share * (values[i] - values[i - 1])


def passage_of(answer):
    """Returns about how many seconds the oil takes to pass the contact."""
    a, u = answer['outputs']['tooth.hertz_half_width']['value'], answer['outputs']['tooth.entrainment_speed']['value']
    if a is None or u is None:
        return 0
    a, u = (max(x) if isinstance(x, list) else x for x in (a, u))
    return 2 * a / u if u else 0


def jumps_of(scene):
    """Returns the times at which a history jumps, which two rows have."""
    rows = scene.get('rows', [])
    return [row[0] for row, before in zip(rows[1:], rows) if row[0] == before[0]]


def is_after_jump(jumps, when, passage):
    return any(-SHIFT * passage <= when - jump <= (1 + SHIFT) * passage for jump in jumps)


def known_or_all(row):
    return math.inf if row['relative'] is None else row['relative']


def judge_series(answer, exact, name, goal):
    """Share of the points with a bar whose bar holds, median of bar over error, largest error; None: not to be compared."""
    own, ref = answer['outputs'][name], exact['outputs'][name]
    t, T = answer['outputs']['film.time']['value'], exact['outputs']['film.time']['value']
    if not own['bar'] or not ref['bar'] or len(own['shape']) != 1:
        return None
    if len(t) == 1:
        t, T = [0], [0]
    most = max(abs(v) for v in ref['value'])
    passage = passage_of(answer)
    held, ratios, errors, opened, judged = 0, [], [], 0, 0

    def at(row, key, when):
        return row[key][0] if len(T) == 1 else sample(T, row[key], when)

    ref = dict(ref, bar=[math.inf if bar is None else bar for bar in ref['bar']])
    for x, value, bar in zip(t, own['value'], own['bar']):
        if bar is None:  # the answer states that its error is not known
            continue
        judged += 1
        scale = max(abs(at(ref, 'value', x)), 0.1 * most)
        known = at(ref, 'bar', x)
        known = math.inf if math.isnan(known) else known
        off = abs(value - at(ref, 'value', x))
        if off > bar + known and len(T) > 1 and is_after_jump(exact['jumps'], x, passage):
            near = [at(ref, 'value', x + SHIFT * passage * k / 4) for k in range(-4, 5)]
            off = 0 if min(near) <= value <= max(near) else min(abs(value - v) for v in near)
        opened += known > goal * scale / 4
        held += off <= bar + known
        errors.append(off / scale)
        ratios.append((bar / off if off else math.inf, off / scale / goal))
    if not judged:
        return None
    return {'share': held / judged, 'error': max(errors), 'claimed': known_or_all(own), 'open': opened / judged,
            'known': known_or_all(ref), 'ratios': [q for q in ratios if q[1] > 0.05][::max(1, len(ratios) // 50)]}


def judge_scalar(answer, exact, name, goal):
    own, ref = answer['outputs'][name], exact['outputs'][name]
    if own['bar'] is None or ref['bar'] is None:
        return None
    off = abs(own['value'] - ref['value'])
    scale = abs(ref['value']) or 1
    return {'held': off <= own['bar'] + ref['bar'], 'twice': off > 2 * own['bar'] + ref['bar'], 'error': off / scale,
            'claimed': own['bar'] / scale, 'known': ref['bar'] / scale,
            'open': ref['bar'] > goal * scale / 4}


def reference_of(runner, scene):
    """Returns the answer on the most cells that does not take too long."""
    for cells, film in REFERENCES.items():
        answer = runner.run(scene, 'measured', film, True)
        if answer['status'] != 'too long':
            break
    return dict(answer, cells=cells)


def judge(scene, answers):
    exact, rows = answers['reference'], []
    for level, goal in GOALS.items():
        answer = answers[level]
        if answer['status'] != 'ok' or exact['status'] != 'ok':
            continue
        as_fine = int(answer['twins']['settings'].get('film.cells', 0)) >= exact['cells']
        for name in scene['outputs']:
            verdict = (judge_series if name in SERIES else judge_scalar)(answer, exact, name, goal)
            if verdict:
                verdict['open'] = max(verdict['open'], as_fine and name.startswith('film.'))
                rows.append(dict(verdict, scene=scene['number'], level=level, output=name, goal=goal))
    return rows


def solve(runner, scene, cache):
    kept = cache and os.path.join(cache, f"{scene['seed']}-{scene['number']}.json")
    answers = {}
    if kept and os.path.exists(kept):
        with open(kept) as stream:
            answers = json.load(stream)
    for level in [*GOALS, 'reference']:
        if level in answers:
            continue
        before = [answers[goal] for goal in GOALS if goal in answers]
        if before and all(answer['status'] == 'too long' for answer in before):
            answers[level] = before[0]
        else:
            answers[level] = reference_of(runner, scene) if level == 'reference' else runner.run(scene, level)
        if kept:
            with open(kept + '.new', 'w') as stream:
                json.dump(answers, stream)
            os.rename(kept + '.new', kept)
    answers['reference']['jumps'] = jumps_of(scene)
    return answers


HEAD = ['scene', 'what', 'accuracy', 'output', 'bar %', 'error %', 'reference +- %', 'verdict']


def write_rows(scene, answers, rows, table):
    for name in [*GOALS, 'reference']:
        if answers[name]['status'] != 'ok':
            table.writerow([scene['number'], scene['kind'], name, '', '', '', '',
                            f"{answers[name]['status']}: {answers[name]['why'][:90]}"])
    for row in rows:
        held = f"{100 * row['share']:.1f} % of the points" if 'share' in row else 'held' if row['held'] else \
            'TWICE' if row['twice'] else 'missed'
        table.writerow([row['scene'], scene['kind'], row['level'], row['output'], f"{100 * row['claimed']:.3g}",
                        f"{100 * row['error']:.3g}", f"{100 * row['known']:.2g}", held + (', open' if is_open(row) else '')])


def is_open(row):
    return row['open'] > 0.5


def wilson(good, count):
    """Returns the 95 % confidence interval of a fraction."""
    z, share = 1.96, good / count
    middle, half = share + z * z / (2 * count), z * math.sqrt(share * (1 - share) / count + (z / (2 * count)) ** 2)
    return (middle - half) / (1 + z * z / count), (middle + half) / (1 + z * z / count)


def print_whole(rows, out):
    judged = [r for r in rows if not is_open(r)]
    scalars, series = ([r for r in judged if ('share' in r) == along] for along in (False, True))
    for what, mine, good in (('scalars', scalars, sum(r['held'] for r in scalars)),
                             ('series', series, sum(r['share'] >= 0.95 for r in series))):
        if mine:
            low, high = wilson(good, len(mine))
            print(f'\n{what}: held {good} of {len(mine)}, {100 * good / len(mine):.1f} % ({100 * low:.1f} to {100 * high:.1f} %)', file=out)
    print(f"missed by more than twice: {sum(r['twice'] for r in scalars)} scalars", file=out)


def print_refused(scenes, out):
    """Of all answers, also where no reference is known, and what the largest part of their errors comes from."""
    for names, what in ((['film.h_min', 'film.h_central'], 'h_min and h_central'),
                        (['film.friction_coefficient'], 'friction'), (['film.p_max'], 'p_max')):
        for level, goal in GOALS.items():
            mine = [answers[level]['outputs'][name] for _, answers in scenes if answers[level]['status'] == 'ok' for name in names]
            refused = [o for o in mine if not (o['relative'] or math.inf) <= goal]
            parts = collections.Counter(max(o['parts'], key=o['parts'].get) if o['parts'] else 'not told' for o in refused)
            by = ', '.join(f'{part} {count}' for part, count in parts.most_common())
            print(f"refused of {what} to {level}: {len(refused)} of {len(mine)}{': ' if by else ''}{by}", file=out)


def print_sums(rows, out):
    print('| output | accuracy | bars that hold | error above twice the bar | points where the bar holds | median of bar over error | refused | open |\n|'
          + '---|' * 8, file=out)
    for name in SCALARS + SERIES:
        for level, goal in GOALS.items():
            every = [r for r in rows if r['output'] == name and r['level'] == level]
            mine = [r for r in every if not is_open(r)]
            refused = sum(not r['claimed'] <= goal for r in every)
            if name in SCALARS:
                good, twice = sum(r['held'] for r in mine), sum(r['twice'] for r in mine)
                ratios = [r['claimed'] / r['error'] for r in mine if r['error'] > 0.05 * goal]
                points = ''
            else:
                good, twice = sum(r['share'] >= 0.95 for r in mine), ''
                ratios = [q[0] for r in mine for q in r['ratios']]
                points = f"{100 * statistics.mean(r['share'] for r in mine):.2f} %" if mine else ''
            ratio = f'{statistics.median(ratios):.1f}' if ratios else ''
            print(f'| {name} | {level} | {good} of {len(mine)} | {twice} | {points} | {ratio} | {refused} of {len(every)} '
                  f'| {len(every) - len(mine)} |', file=out)


def with_goal(answer, exact, name, goal):
    """Returns the answer with error bars as large as the goal."""
    own, ref = dict(answer['outputs'][name]), exact['outputs'][name]
    if name in SCALARS:
        own['bar'] = goal * abs(ref['value'] or 1)
    else:
        most = max(abs(v) for v in ref['value'])
        own['bar'] = [goal * max(abs(v), 0.1 * most) for v in own['value']]
    return dict(answer, outputs=dict(answer['outputs'], **{name: own}))


def keeps(answer, exact, name, goal):
    if answer['status'] != 'ok' or answer['outputs'][name]['value'] is None:
        return False
    verdict = (judge_series if name in SERIES else judge_scalar)(with_goal(answer, exact, name, goal), exact, name, goal)
    return bool(verdict) and (verdict['share'] >= 0.95 if 'share' in verdict else verdict['held'])


def kept_in(cache, name, compute):
    path = os.path.join(cache, name)
    if not os.path.exists(path):
        with open(path, 'w') as stream:
            json.dump(compute(), stream)
    with open(path) as stream:
        return json.load(stream)


def lattice_of(runner, scene, cache):
    return kept_in(cache, f"{scene['seed']}-{scene['number']}-lattice.json",
                   lambda: [runner.run(scene, '', f'cells: {cells}, time_tolerance: {tolerance}') for cells, tolerance in LATTICE])


def cheapest(points, exact, names, goal):
    """CPU time of the first of the settings from which on all finer ones keep the accuracy; None: the finest does not."""
    good = [all(keeps(answer, exact, name, goal) for name in names) for answer in points]
    first = next((i for i in range(len(points)) if all(good[i:])), None)
    return None if first is None else points[first]['cpu']


def is_kept(answer, names, goal):
    return all(known_or_all(answer['outputs'][name]) <= goal for name in names)


def cost_row(scene, answer, goal):
    """Cost of an answer and of the settings that it chose, both over its first run, and whether it is as allowed."""
    runs, of = answer['twins']['runs'], answer['twins']['settings'].items()
    presets = runs[0]['seconds']
    chosen = max(run['seconds'] for run in runs if of <= run['settings'].items()) / presets
    first = answer['twins']['attempts'] == 1 and is_kept(answer, scene['outputs'], goal)
    cost = sum(run['seconds'] for run in runs) / presets
    return {'cost': cost, 'chosen': chosen, 'first': first, 'as allowed': cost <= COST * (1 if first else 1 + chosen)}


def print_costs(runner, scenes, cache, lattice, out):
    print('\n| scene | what | accuracy | attempts, twins | cost over the presets | of the settings chosen | as allowed '
          '| of the cheapest of six | cost over it |\n|' + '---|' * 9, file=out)
    rows = {level: [] for level in GOALS}
    for scene, answers in scenes:
        for level, goal in GOALS.items():
            answer, exact = answers[level], answers['reference']
            if answer['status'] != 'ok':
                continue
            row = cost_row(scene, answer, goal)
            names = [n for n in scene['outputs'] if known_or_all(answer['outputs'][n]) <= goal]
            least = cheapest(lattice_of(runner, scene, cache), exact, names, goal) if lattice and exact['status'] == 'ok' else None
            row['ratio'] = least and answer['cpu'] / least
            rows[level].append(row)
            print(f"| {scene['number']} | {scene['kind']} | {level} | {answer['twins']['attempts']}, {answer['twins']['twins']} "
                  f"| {row['cost']:.3g} | {row['chosen']:.3g} | {'yes' if row['as allowed'] else 'NO'} | "
                  + (f"{least / answer['cpu'] * row['cost']:.2g} | {row['ratio']:.2g} |" if least else ' | |'), file=out)
    for level, found in rows.items():
        for first in (True, False):
            costs = sorted(f['cost'] for f in found if f['first'] == first)
            if costs:
                print(f"\n{level}, {'kept by the presets' if first else 'others'}: cost {statistics.median(costs):.3g} times the presets "
                      f"(median), {costs[-1]:.3g} at most, as allowed {sum(f['as allowed'] for f in found if f['first'] == first)} "
                      f"of {len(costs)}", file=out)
        ratios = sorted(f['ratio'] for f in found if f['ratio'])
        if ratios:
            print(f'\n{level}: {statistics.median(ratios):.2g} times the cheapest of six (median), {ratios[-1]:.2g} at most, '
                  f'in {len(ratios)} scenes', file=out)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('source')
    parser.add_argument('--seed', default='development')
    parser.add_argument('--first', type=int, default=1)
    parser.add_argument('--count', type=int, default=30)
    parser.add_argument('--longest', type=int, default=100, help='s of CPU time, of a run; what takes longer is listed')
    parser.add_argument('--cache')
    parser.add_argument('--table', help='every number, as CSV')
    parser.add_argument('--lattice', action='store_true', help='costs over the cheapest of six settings, too')
    parser.add_argument('--loose', action='store_true', help='10 and 2 %% alone')
    options = parser.parse_args()
    if options.loose:
        del GOALS['0.5 %']
    runner, rows, scenes = Runner(options.program, options.source, options.longest), [], []
    out, file = sys.stdout, open(options.table or os.devnull, 'w', newline='')
    table = csv.writer(file, lineterminator='\n')
    table.writerow(HEAD)
    for number in range(options.first, options.first + options.count):
        scene = dict(draw(options.seed, number), seed=options.seed)
        answers = solve(runner, scene, options.cache)
        mine = judge(scene, answers)
        write_rows(scene, answers, mine, table)
        file.flush()
        rows += mine
        scenes.append((scene, answers))
        print(f"scene {number}: {scene['kind']}, {len(mine)} numbers", file=sys.stderr)
    print_sums(rows, out)
    print_whole(rows, out)
    print_refused(scenes, out)
    print_costs(runner, scenes, options.cache or tempfile.mkdtemp(), options.lattice, out)


if __name__ == '__main__':
    main()
