#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs random gear scenes with the presets of the film, and counts which of them are not green.

  healthy.py PROGRAM SOURCE [--count N] [--first SEED]

A line of the film's quality that is not good in a healthy scene cries wolf, unless it tells of the
scene: printed are the lines that were not, how often, and the scenes in which one was. What says
that a model does not hold there, such as the heat of the inlet, is counted apart.
"""
import argparse
import collections
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'plugins'))
import scenes  # noqa: E402

OF_THE_SCENE = {'inlet_heating', 'lambda', 'lambda_ratio', 'law_range', 'continuum'}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('program')
    parser.add_argument('source')
    parser.add_argument('--count', type=int, default=200)
    parser.add_argument('--first', type=int, default=5001)
    options = parser.parse_args()
    runner = scenes.Runner(options.program, options.source)
    lines, red, apart, failed = collections.Counter(), 0, 0, 0
    for seed in range(options.first, options.first + options.count):
        scene = scenes.draw(seed)
        answer = runner.run(scene, ['film.h_min', 'film.p_max', 'film.traction', 'film.power_loss'],
                            film='use: ehl/finite-volume')
        stage = next((s for s in answer.get('stages', []) if s['stage'] == 'film'), {})
        quality = stage.get('quality', {})
        if not quality:
            failed += 1
            print(seed, 'no film:', answer['errors'][0]['message'][:120] if answer['errors'] else '')
            continue
        poor = {k: q for k, q in quality.items() if q['verdict'] != 'good'}
        lines.update(poor.keys())
        numeric = [k for k in poor if k not in OF_THE_SCENE]
        red += bool(numeric)
        apart += bool(poor) and not numeric
        if numeric:
            print(seed, ' '.join(f'{k} {poor[k]["value"]:.3g} {poor[k]["verdict"]}' for k in numeric),
                  flush=True)
    judged = options.count - failed
    print(f'{red} of {judged} not green ({100 * red / max(judged, 1):.1f} %), {apart} more for what '
          f'the model does not hold; without a film {failed}; lines: {dict(lines)}')


if __name__ == '__main__':
    main()
