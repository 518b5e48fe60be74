#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random gear scenes with `use: ehl/auto`: is what was promised kept, and at what cost?

choose.py FLANKFILM SOURCE [--first N] [--count N] [--accuracy PERCENT] [--of film|friction|pressure]
          [--swift] [--search] [--cache FOLDER] [--table FILE]

What the error is of, against a solution that is refined, in cells or in time, until its own error
(a third of what half the cells change, and a third of what four times the tolerance changes with
those) is below a tenth of the accuracy, or twice the cells would be work for minutes:
  film      the largest of three: of the lowest h_min, and of h_min and h_central on the mean over
            the history, each over itself;
  friction  friction_coefficient on the mean over the history;
  pressure  the larger of two: of the highest p_max, and of p_max on the mean.

--swift draws pitch line speeds above 6 m/s, where a tooth sees few vibrations and a scene takes a
second. --search finds the cheapest fixed setting that meets the accuracy, too: the work of a film
is counted in deflections times cells times log2(cells), which no load of the machine changes, the
films that were tried for the choice included.
Red: a promise that is broken, a film that fails, or fewer than half of the scenes met; to refuse
them all would break no promise.

--cache keeps the refined solutions and what was searched, which depend on the solver but not on
what it promises. --table writes a page with a row for each scene.
"""
import argparse
import json
import math
import os
import re
import statistics
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..'))
from scenes import Runner, chosen, draw, off_on_the_mean, stage  # noqa: E402

SERIES = {'film': ['h_min', 'h_central'], 'friction': ['friction_coefficient'],
          'pressure': ['p_max']}
SCALAR = {'film': ['h_min_lowest'], 'friction': [], 'pressure': ['p_max_highest']}
CELLS = (96, 128, 192, 256, 384, 512, 768)
STEPS = ('auto, time_tolerance: 0.32', 'auto, time_tolerance: 0.08', '200', '400', '800', '100',
         '1600')
MOST_WORK = 5.5e9


def cache_of(seed, options):
    name = f"{seed}{'-swift' if options.swift else ''}-{options.accuracy:g}-{options.of}.json"
    return options.cache and os.path.join(options.cache, name)


class Scene:
    """One scene, with what has been found out about it."""

    def __init__(self, runner, seed, options):
        self.runner, self.seed, self.options = runner, seed, options
        self.drawn = draw(seed, options.swift)
        self.accuracy = options.accuracy / 100
        self.motion = None
        self.kept = {}
        self.file = cache_of(seed, options)
        if self.file and os.path.exists(self.file):
            with open(self.file) as stream:
                self.kept = json.load(stream)

    def keep(self, name, value):
        self.kept[name] = value
        if self.file:
            with open(self.file, 'w') as stream:
                json.dump(self.kept, stream)
        return value

    def run(self, film, counted=False):
        names = SERIES[self.options.of] + SCALAR[self.options.of] + ['time']
        names += ['convolutions'] if counted else []
        stages = {'motion': f'use: dynamics/{self.motion}'} if self.motion else {}
        return self.runner.run(self.drawn, ['film.' + n for n in names], film=film, **stages)

    def solve(self, cells, steps):
        """What a fixed setting gives: its outputs and its work; None when it fails."""
        answer = self.run(f'use: ehl/finite-volume, cells: {cells}, steps: {steps}', True)
        if answer['status'] != 'ok':
            return None
        found = outputs(answer)
        found['work'] = found['convolutions'] * cells * math.log2(cells)
        return found


def outputs(answer):
    return {name.split('.')[1]: row.get('value', row.get('data'))
            for name, row in answer['outputs'].items()}


def error(found, exact, of):
    errors = [abs(found[name] / exact[name] - 1) for name in SCALAR[of]]
    errors += [off_on_the_mean(found['time'], found[name], exact['time'], exact[name])
               for name in SERIES[of]]
    return max(errors)


def refine(scene, proposed):
    """The solution to measure against, with its own error; it has more cells than were proposed."""
    if 'exact' in scene.kept:
        return scene.kept['exact']
    of, limit = scene.options.of, 0.1 * scene.accuracy
    cells, tolerance = (1024, 0.02) if scene.accuracy < 0.1 else (512, 0.08)
    known = {}
    while cells < 1.2 * proposed:
        cells *= 2

    def solve(n, t):
        if (n, t) not in known:
            known[n, t] = scene.solve(n, f'auto, time_tolerance: {t}')
        return known[n, t]

    def third(other, than):
        return error(other, than, of) / 3 if other and than else 1

    while True:
        exact, half = solve(cells, tolerance), solve(cells // 2, tolerance)
        in_space = third(half, exact)
        in_time = third(solve(cells // 2, 4 * tolerance), half)
        if in_space + in_time <= limit or (exact and 2.2 * exact['work'] > MOST_WORK) or cells > 8192:
            break
        if in_space > 0.6 * limit:
            cells *= 2
        if in_time > 0.4 * limit or not exact:
            tolerance /= 4
    if exact:
        exact.update(cells=cells, tolerance=tolerance, own=in_space + in_time)
    return scene.keep('exact', exact)


def search(scene, exact):
    """Least work of a fixed setting within the accuracy, and the setting; more cells than meet it
    with the same steps only cost more."""
    if 'best' in scene.kept:
        return scene.kept['best']
    best, of = None, scene.options.of
    for model in ('film-formula', 'inlet-analysis'):
        answer = scene.run(f'use: ehl/{model}')
        if answer['status'] == 'ok' and error(outputs(answer), exact, of) <= scene.accuracy:
            return scene.keep('best', (1, model))
    for steps in STEPS:
        for cells in CELLS:
            found = scene.solve(cells, steps)
            if found and best and found['work'] >= best[0]:
                break
            if found and error(found, exact, of) <= scene.accuracy:
                best = found['work'], f'{cells} cells, {steps} steps'
                break
    return scene.keep('best', best)


def tried(reason):
    """The work of the films by which the cells were chosen."""
    found = re.search(r'as tried \(work ([\d.e+]+)\)', reason)
    return float(found.group(1)) if found else 0


def refusal(seed, answer):
    reason = answer['errors'][0]['message'] if answer['errors'] else 'no reason'
    verdict = ('ambiguous' if 'several answers' in reason else
               'refused' if 'no model promises' in reason else 'failed')
    return {'seed': seed, 'verdict': verdict, 'text': reason[:160]}


def judge(scene):
    """A dictionary with the verdict."""
    options = scene.options
    film = f'use: ehl/auto, accuracy: {options.accuracy} %'
    answer = scene.run(film)
    if answer['status'] != 'ok':
        return refusal(scene.seed, answer)
    candidate, tuned = chosen(answer, 'film')
    model = stage(answer, 'film')['model']
    scene.motion = stage(answer, 'motion')['model'].split('/')[1]
    exact = refine(scene, int(tuned.get('cells', 0)))
    if not exact:
        return {'seed': scene.seed, 'verdict': 'failed', 'text': 'the refined film'}
    off = error(outputs(answer), exact, options.of)
    verdict = {'seed': scene.seed, 'promise': candidate['error'], 'error': off,
               'own': exact['own'], 'exact': f"{exact['cells']} cells, {exact['tolerance']:g}",
               'text': f"{model} ({candidate['proposals']}) after {scene.motion}"}
    verdict['verdict'] = ('broken' if off > 2 * candidate['error'] else
                          'met' if off <= scene.accuracy else 'missed')
    if options.search:
        best = search(scene, exact)
        work = 0
        if tuned:
            cells = int(tuned['cells'])
            counted = outputs(scene.run(film, True))
            work = counted['convolutions'] * cells * math.log2(cells) + tried(candidate['reason'])
        if best and work > 0:  # without a pressure to solve for there is no work
            verdict['ratio'] = work / best[0] if best[0] > 1 else math.inf
        verdict['best'] = best[1] if best else 'none'
    return verdict


def line_of(v):
    line = f"scene {v['seed']}: {v['verdict']}"
    if 'error' in v:
        line += (f", promised {100 * v['promise']:.2f} %, off by {100 * v['error']:.2f} %"
                 f" (+- {100 * v['own']:.2f})")
    if 'ratio' in v:
        line += f", work {v['ratio']:.2f} times that of {v['best']}"
    return line + ': ' + v['text']


def row_of(v):
    if 'error' not in v:
        return f"| {v['seed']} | {v['verdict']} | | | | | {v['text'].replace('|', ' ')} |"
    ratio = f"{v['ratio']:.2f}" if 'ratio' in v else ''
    return (f"| {v['seed']} | {v['verdict']} | {100 * v['promise']:.2f} | {100 * v['error']:.2f} |"
            f" {100 * v['own']:.2f} ({v['exact']}) | {ratio} | {v['text']}; cheapest:"
            f" {v.get('best', 'not searched')} |")


def write_table(options, verdicts):
    with open(options.table, 'w') as stream:
        stream.write('| scene | verdict | promise % | error % | reference +- % (its setting) |'
                     ' work ratio | chosen; cheapest fixed setting |\n|' + '---|' * 7 + '\n')
        for v in sorted(verdicts, key=lambda v: v['seed']):
            stream.write(row_of(v) + '\n')
        stream.write('\n' + '; '.join(summary(verdicts)[1]) + '.\n')


def summary(verdicts):
    tally = {}
    for v in verdicts:
        tally[v['verdict']] = tally.get(v['verdict'], 0) + 1
    lines = [', '.join(f'{count} {name}' for name, count in sorted(tally.items()))]
    ratios = [v['ratio'] for v in verdicts if 'ratio' in v]
    if ratios:
        lines.append(f'work over that of the cheapest fixed setting: median '
                     f'{statistics.median(ratios):.2f} of {len(ratios)}')
    return tally, lines


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('source')
    parser.add_argument('--first', type=int, default=1)
    parser.add_argument('--count', type=int, default=40)
    parser.add_argument('--accuracy', type=float, default=2)
    parser.add_argument('--of', choices=sorted(SERIES), default='film')
    parser.add_argument('--swift', action='store_true')
    parser.add_argument('--search', action='store_true')
    parser.add_argument('--cache')
    parser.add_argument('--table')
    options = parser.parse_args()
    runner, verdicts = Runner(options.program, options.source), []
    seeds = range(options.first, options.first + options.count)
    if options.cache:  # what is refined already first
        seeds = sorted(seeds, key=lambda seed: not os.path.exists(cache_of(seed, options)))
    for seed in seeds:
        verdicts.append(judge(Scene(runner, seed, options)))
        print(line_of(verdicts[-1]), flush=True)
        if options.table:
            write_table(options, verdicts)
    tally, lines = summary(verdicts)
    print('\n'.join(lines))
    few = 2 * tally.get('met', 0) < len(verdicts) or not verdicts
    return 1 if tally.get('broken') or tally.get('failed') or few else 0


if __name__ == '__main__':
    sys.exit(main())
