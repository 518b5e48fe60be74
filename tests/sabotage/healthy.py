#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs random gear scenes, in which no bug is, and counts whose film is not green, and why.

  healthy.py PROGRAM SOURCE [--count N] [--first SEED] [--film "use: ehl/finite-volume"]

A balance that is not good cries wolf. An error that the run states of its cells, its steps or its
domain may be as large as it says: with the presets most heavy contacts have one, so it is counted
apart; and so is what says that the model leaves something out, such as the heat of the inlet.
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


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('program')
    parser.add_argument('source')
    parser.add_argument('--count', type=int, default=200)
    parser.add_argument('--first', type=int, default=5001)
    parser.add_argument('--film', default='use: ehl/finite-volume')
    options = parser.parse_args()
    runner = scenes.Runner(options.program, options.source)
    lines, failed = collections.Counter(), 0
    broken = estimates = left_out = 0
    for seed in range(options.first, options.first + options.count):
        answer = runner.run(scenes.draw(seed), OUTPUTS, film=options.film)
        stage = next((s for s in answer.get('stages', []) if s['stage'] == 'film'), {})
        if not stage.get('quality'):
            failed += 1
            why = answer['errors'][0]['message'] if answer['errors'] else ''
            print(seed, 'no film:', why[:120], flush=True)
            continue
        poor = {k: q for k, q in stage['quality'].items() if q['verdict'] != 'good'}
        lines.update(poor.keys())
        broken += bool(set(poor) & BALANCES)
        estimates += bool(set(poor) - BALANCES - LEFT_OUT)
        left_out += bool(set(poor) & LEFT_OUT)
        for name in set(poor) & BALANCES:
            print(seed, name, poor[name]['value'], poor[name]['verdict'], flush=True)
    judged = options.count - failed
    print(f'of {judged} films a balance is not good in {broken}, an error that is stated is large in '
          f'{estimates}, something is left out in {left_out}; without a film {failed}; '
          f'{dict(lines)}')


if __name__ == '__main__':
    main()
