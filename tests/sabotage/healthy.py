#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs random gear scenes, in which no bug is, and counts whose film is not green, and why.

  healthy.py PROGRAM SOURCE [--count N] [--first SEED] [--film "use: ehl/finite-volume"]
             [--finer CELLS]

A balance that is not good cries wolf. An error that the run states of its cells, its steps or its
domain may be as large as it says: with the presets most heavy contacts have one, so it is counted
apart; and so is what says that the model leaves something out, such as the heat of the inlet.

With --finer each scene is run on those cells, too, and what is stated of the cells is held against
the difference, at the worst of the loaded instants but for 2 % of them: those that are off by more
than the limit, of them those that say nothing, and those that say so at less than half of it. Then
the films that are right: within the limits at every loaded instant, also if the finer cells cut as
much off the peak as they state; and of these those that are said to be off.
"""
import argparse
import collections
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'plugins'))
import scenes  # noqa: E402

BALANCES = {'contact_conditions', 'load_balance', 'load_rescaling', 'film_shape', 'mass_balance',
            'complementarity', 'outputs', 'energy_balance', 'rolling_moment', 'mass_history',
            'film_end', 'contact_supply'}
LEFT_OUT = {'inlet_heating', 'lambda', 'lambda_ratio', 'law_range', 'continuum',
            'one_way_gap_error'}
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
    """Of the cells, over the value, sorted; with p_max over that of the run itself."""
    load = answer['outputs']['tooth.load_per_width']['data']
    at, most, off = answer['outputs']['tooth.time']['data'], max(load), []
    for (times, values), (fine_times, fine) in zip(engagements(answer, name),
                                                   engagements(finer, name)):
        for time, value in zip(times, values):
            exact = scenes.sample(fine_times, fine, time) if len(fine) > 1 else fine[0]
            if scenes.sample(at, load, time) > 0.02 * most:
                off.append(abs(exact / value - 1) if name == 'p_max' else abs(value / exact - 1))
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


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('program')
    parser.add_argument('source')
    parser.add_argument('--count', type=int, default=200)
    parser.add_argument('--first', type=int, default=5001)
    parser.add_argument('--film', default='use: ehl/finite-volume')
    parser.add_argument('--finer', type=int)
    options = parser.parse_args()
    runner = scenes.Runner(options.program, options.source)
    lines, tally, failed = collections.Counter(), collections.Counter(), 0
    outputs = OUTPUTS + COMPARED * bool(options.finer)
    broken = estimates = left_out = 0
    for seed in range(options.first, options.first + options.count):
        scene = scenes.draw(seed)
        if scene['motion'] == 'auto':  # which needs an accuracy
            scene['motion'] = 'shooting'
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
