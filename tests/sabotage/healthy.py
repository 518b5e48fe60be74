#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs random gear scenes, in which no bug is, and counts whose film is not green, and why.

  healthy.py PROGRAM SOURCE [--count N] [--first SEED] [--film "use: ehl/finite-volume"]
             [--finer CELLS] [--reference FILE] [--sampling]

A balance that is not good cries wolf. An error that the run states of its cells, its steps or its
domain may be as large as it says: with the presets most heavy contacts have one, so it is counted
apart; and so is what says that the model leaves something out, such as the heat of the inlet.

With --finer each scene is run on those cells, too, and what is stated of the cells is held against
the difference, at the worst of the loaded instants but for 2 % of them: those that are off by more
than the limit, of them those that say nothing, and those that say so at less than half of it. Then
the films that are right: within the limits at every loaded instant, also if the finer cells cut as
much off the peak as they state; and of these those that are said to be off.

With --reference each scene is run again with four times the stations and three times the points,
a third of the time_tolerance, and twice the cells, which are doubled until it is known whether
h_min_lowest and p_max_highest are within the limits of their lines (2 and 10 %) and dte_rms within
2 %: until that holds, or not, also if the reference moved once more by as much as it did last.
Where p_max_space_error or h_min_space_error is not good they are doubled to the end unless it is
found off, since 1024 cells may leave a spike out altogether, and the dip of a film half in. The
references are added to FILE, from which a campaign goes on; the scene itself is run anew. A scene
is healthy when it is known to be within these limits and its model leaves nothing out; of the
healthy those are counted of which a line of any stage is not good, and of those that are off those
of which none is.

With --sampling each scene whose motion vibrates is run on fewer stations of the gear, too, and
h_min_lowest is held against 3200 stations and 12000 points, all on 256 cells: how far it is off
where the lines of the sampling are good, and where they are not.
"""
import argparse
import collections
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'plugins'))
import scenes  # noqa: E402

BALANCES = {'contact_conditions', 'load_balance', 'load_rescaling', 'film_shape', 'mass_balance',
            'complementarity', 'outputs', 'energy_balance', 'rolling_moment', 'mass_history',
            'film_end', 'contact_supply'}
LEFT_OUT = {'inlet_heating', 'lambda', 'lambda_ratio', 'law_range', 'continuum',
            'one_way_gap_error'}
SPACE = {'film.h_min_space_error', 'film.p_max_space_error'}
OUTPUTS = ['film.h_min', 'film.p_max', 'film.traction', 'film.power_loss']
COMPARED = ['film.h_central', 'film.engagement', 'film.time', 'tooth.time', 'tooth.load_per_width']


STATED = {'h_min': 0.02, 'h_central': 0.02, 'p_max': 0.1}  # by its line, and its limit


def engagements(answer, name):
    """Times and values of each film; their times may overlap."""
    series = {k: answer['outputs']['film.' + k]['data'] for k in ('time', name, 'engagement')}
    films, last = [], None
    for time, value, number in zip(*series.values()):
        if number != last:
            films.append(([], []))
        films[-1][0].append(time)
        films[-1][1].append(value)
        last = number
    return films


def differences(answer, finer, name):
    """Of the cells, over the value of the run itself, sorted."""
    load = answer['outputs']['tooth.load_per_width']['data']
    at, most, off = answer['outputs']['tooth.time']['data'], max(load), []
    for (times, values), (fine_times, fine) in zip(engagements(answer, name),
                                                   engagements(finer, name)):
        for time, value in zip(times, values):
            exact = scenes.sample(fine_times, fine, time) if len(fine) > 1 else fine[0]
            if scenes.sample(at, load, time) > 0.02 * most:
                off.append(abs(exact / value - 1))
    return sorted(off) or [0]


def film_quality(answer):
    return next((s for s in answer.get('stages', []) if s['stage'] == 'film'), {}).get('quality')


def hold(tally, answer, finer, quality):
    right, said = True, False
    for name, limit in STATED.items():
        off, stated = differences(answer, finer, name), quality[name + '_space_error']['value']
        true, cut = off[int(0.98 * (len(off) - 1))], 0
        if name == 'p_max':
            cut = film_quality(finer)['p_max_space_error']['value']
        right &= (1 + off[-1]) * (1 + cut) - 1 <= limit
        said |= stated > limit
        tally[name, 'off'] += true > limit
        tally[name, 'not said'] += true > limit >= stated
        tally[name, 'said at less than half'] += stated > limit > 2 * true
    tally['films', 'right'] += right
    tally['films', 'right and said to be off'] += right and said


HEADLINES = {'motion.dte_rms': 0.02, 'film.h_min_lowest': 0.02, 'film.p_max_highest': 0.1}
REFINED = ['gears.stations=3200', 'tooth.points=12000', 'film.time_tolerance=3e-3']
CELLS = [1024, 2048, 4096, 8192]


def headlines(answer):
    scalars = {f"{s['stage']}.{n}": v['value'] for s in answer.get('stages', [])
               for n, v in s['scalars'].items()}
    return [scalars.get(name) for name in HEADLINES]


def poor_lines(answer):
    return {f"{s['stage']}.{n}": [q['value'], q['limit'], q['verdict']]
            for s in answer.get('stages', []) for n, q in s['quality'].items()
            if q['verdict'] != 'good'}


def drawn(seed):
    scene = scenes.draw(seed)
    if scene['motion'] == 'auto':  # which needs an accuracy
        scene['motion'] = 'shooting'
    return scene


def verdict(own, references):
    """'healthy', 'off', or '' where the references do not tell. What is off is over the value of
    the run, as the errors are that a run states of itself."""
    last, before = references[-1], references[-2] if len(references) > 1 else own
    within = True
    for value, finest, coarser, limit in zip(own, last, before, HEADLINES.values()):
        off, moved = abs(finest / value - 1), abs((finest - coarser) / value)
        if off - moved > limit:
            return 'off'
        within &= off + moved <= limit
    return 'healthy' if within else ''


def refer(runner, seed, own, references, film, doubted):
    """Adds references of more and more cells until they tell; None: there is none."""
    for cells in CELLS[len(references):]:
        word = verdict(own, references) if references else ''
        if word == 'off' or word and not doubted:
            break
        finer = headlines(runner.run(drawn(seed), list(HEADLINES), film=film,
                                     sets=REFINED + [f'film.cells={cells}']))
        if None in finer:
            return None
        references.append(finer)
    return references


def against_reference(runner, options):
    known, counts, names = {}, collections.Counter(), collections.Counter()
    if os.path.exists(options.reference):
        with open(options.reference, encoding='utf-8') as stream:
            known = {r['seed']: r['references'] for r in map(json.loads, stream)}
    for seed in range(options.first, options.first + options.count):
        answer = runner.run(drawn(seed), list(HEADLINES), film=options.film)
        own, lines = headlines(answer), poor_lines(answer)
        before = known.get(seed, [])
        doubted, references = SPACE & lines.keys(), None
        if None not in own:
            references = refer(runner, seed, own, list(before), options.film, doubted)
        if references and len(references) > len(before):
            with open(options.reference, 'a', encoding='utf-8') as stream:
                print(json.dumps({'seed': seed, 'references': references}), file=stream)
        word = (verdict(own, references) or 'not known') if references else 'without a film'
        left_out = {n for n in lines if n.split('.')[1] in LEFT_OUT}
        if word == 'healthy' and left_out:
            word = 'left out'
        counts[word] += 1
        counts[word, 'green'] += not lines
        if word == 'healthy':
            names.update(lines)
        if word == 'healthy' and lines or word not in ('healthy', 'left out') and not lines:
            print(seed, word, own, references and references[-1], lines, flush=True)
    for word in ('healthy', 'off', 'left out', 'not known', 'without a film'):
        print(f"{word}: {counts[word]}, of which {counts[word, 'green']} are green")
    print('healthy, but not green by', dict(names))


SAMPLING = {'station_sampling', 'load_interpolation'}
STATIONS = {'gears.stations=100': [], 'gears.stations=200': [], 'gears.stations=400': [],
            'the presets': []}


def against_stations(runner, options):
    """Of each run what h_min_lowest is off, and whether a line of the sampling is not good."""
    fine = ['gears.stations=3200', 'tooth.points=12000']
    for seed in range(options.first, options.first + options.count):
        scene = drawn(seed)
        if scene['motion'] == 'quasi-static':
            continue
        film = options.film + ', cells: 256'
        lowest = headlines(runner.run(scene, list(HEADLINES), sets=fine, film=film))[1]
        for sets, runs in STATIONS.items():
            answer = runner.run(scene, list(HEADLINES), sets=[sets] * ('=' in sets), film=film)
            own = headlines(answer)[1]
            if own and lowest:
                poor = {n.split('.')[1] for n in poor_lines(answer)} & SAMPLING
                runs.append((abs(own / lowest - 1), bool(poor), seed))
    for sets, runs in STATIONS.items():
        for said in (False, True):
            off = sorted((r[0], r[2]) for r in runs if r[1] == said)
            print(f"{sets}, {'not good' if said else 'good'}: {len(off)} scenes, "
                  f'{sum(1 for o in off if o[0] > 0.02)} off by more than 2 %, the worst '
                  + ', '.join(f'{100 * o:.2g} % ({seed})' for o, seed in off[:-4:-1]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('program')
    parser.add_argument('source')
    parser.add_argument('--count', type=int, default=200)
    parser.add_argument('--first', type=int, default=5001)
    parser.add_argument('--film', default='use: ehl/finite-volume')
    parser.add_argument('--finer', type=int)
    parser.add_argument('--reference')
    parser.add_argument('--sampling', action='store_true')
    options = parser.parse_args()
    runner = scenes.Runner(options.program, options.source)
    if options.reference:
        against_reference(runner, options)
        return
    if options.sampling:
        against_stations(runner, options)
        return
    lines, tally, failed = collections.Counter(), collections.Counter(), 0
    outputs = OUTPUTS + COMPARED * bool(options.finer)
    broken = estimates = left_out = 0
    for seed in range(options.first, options.first + options.count):
        scene = drawn(seed)
        answer = runner.run(scene, outputs, bool(options.finer), film=options.film)
        quality = film_quality(answer)
        if not quality:
            failed += 1
            why = answer['errors'][0]['message'] if answer['errors'] else ''
            print(seed, 'no film:', why[:120], flush=True)
            continue
        poor = {k: q for k, q in quality.items() if q['verdict'] != 'good'}
        lines.update(poor.keys())
        broken += bool(set(poor) & BALANCES)
        estimates += bool(set(poor) - BALANCES - LEFT_OUT)
        left_out += bool(set(poor) & LEFT_OUT)
        if options.finer:
            finer = runner.run(scene, outputs, True, film=f'{options.film}, cells: {options.finer}')
            hold(tally, answer, finer, quality)
        for name in set(poor) & BALANCES:
            print(seed, name, poor[name]['value'], poor[name]['verdict'], flush=True)
    judged = options.count - failed
    print(f'of {judged} films a balance is not good in {broken}, an error that is stated is large in '
          f'{estimates}, something is left out in {left_out}; without a film {failed}; '
          f'{dict(lines)}')
    for (name, what), number in sorted(tally.items()):
        print(f'{name}: {what} {number}')


if __name__ == '__main__':
    main()
