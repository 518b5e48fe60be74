#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Would Richardson's extrapolation give a better answer than the finest film, and a correct error bar?

extrapolation.py FLANKFILM SOURCE [--seed HEX] [--count N] [--cache FOLDER]

The scenes are those of error-bars.py. Each is solved at four levels of the film, those of the program's error bars, with all other settings as
fine as there, and compared with a fifth level. A level has half the cells and four times the time tolerance of the next. Levels f, 2f and 4f
give the order of convergence; if it is from 1.5 to 2.5, the extrapolated answer is that at f plus a third of its difference from 2f, and its
error bar is 1.25 times the difference from the answer extrapolated from 2f and 4f. Prints a row for each output and finest level.
"""
import argparse
import importlib.util
import json
import math
import os
import statistics

HERE = os.path.dirname(os.path.abspath(__file__))
LEVELS = [(128, 1.12e-1), (256, 2.8e-2), (512, 7e-3), (1024, 1.75e-3), (2048, 4.4e-4)]
OUTPUTS = ['film.h_min_lowest', 'film.p_max_highest', 'film.h_min', 'film.h_central', 'film.p_max']
BAND = (1.5, 2.5)
LONGEST = 60  # s of CPU time, of a run


def load_campaign():
    spec = importlib.util.spec_from_file_location('error_bars', os.path.join(HERE, 'error-bars.py'))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def solve(campaign, runner, seed, number, cache):
    """Returns the answers of all levels, or None if one of them fails or takes too long."""
    kept = cache and os.path.join(cache, f'{seed}-{number}-levels.json')
    if kept and os.path.exists(kept):
        with open(kept) as stream:
            return json.load(stream)
    scene = dict(campaign.draw(seed, number), seed=seed, outputs=OUTPUTS)
    found = []
    for cells, tolerance in LEVELS:
        found.append(runner.run(scene, '', f'cells: {cells}, time_tolerance: {tolerance}', True))
        if found[-1]['status'] != 'ok':
            return None
    if kept:
        with open(kept, 'w') as stream:
            json.dump(found, stream)
    return found


def numbers(campaign, answer, name, times):
    value, own = answer['outputs'][name]['value'], answer['outputs']['film.time']['value']
    if not isinstance(value, list):
        return [value]
    return [campaign.sample(own, value, t) for t in times] if len(own) > 1 else value


def compare(campaign, found, name, top):
    """(order, error of the finest level, of the extrapolation, its bar, share of points where the bar holds)"""
    times = found[top]['outputs']['film.time']['value']
    exact, f, f2, f4 = (numbers(campaign, found[k], name, times) for k in (len(LEVELS) - 1, top, top - 1, top - 2))
    most = max(abs(x) for x in exact)
    scale = [max(abs(x), 0.1 * most) for x in exact]
    near, far = (math.sqrt(sum(((x - y) / s) ** 2 for x, y, s in zip(a, b, scale))) for a, b in ((f, f2), (f2, f4)))
    better, worse = ([x + (x - y) / 3 for x, y in zip(a, b)] for a, b in ((f, f2), (f2, f4)))
    bars = [1.25 * abs(x - y) for x, y in zip(better, worse)]

    def typical(values):
        return sorted(v / s for v, s in zip(values, scale))[int(0.95 * (len(scale) - 1))]
    return (math.log2(far / near) if near > 0 and far > 0 else math.nan, typical(abs(x - y) for x, y in zip(f, exact)),
            typical(abs(x - y) for x, y in zip(better, exact)), typical(bars),
            sum(bar >= abs(x - y) for bar, x, y in zip(bars, better, exact)) / len(bars))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('source')
    parser.add_argument('--seed', default='a673940f')
    parser.add_argument('--count', type=int, default=20)
    parser.add_argument('--cache')
    options = parser.parse_args()
    campaign = load_campaign()
    runner = campaign.Runner(options.program, options.source, LONGEST)
    scenes = [solve(campaign, runner, options.seed, number + 1, options.cache) for number in range(options.count)]
    solved = [found for found in scenes if found]
    print(f'{len(solved)} of {options.count} scenes are solved on all levels.\n')
    print('| output | finest cells | order from 1.5 to 2.5 | error of the answer over that of the extrapolation (median) '
          '| extrapolation is worse | its bar holds at 95 % of points | bar over error (median) |\n|' + '---|' * 7)
    for name in OUTPUTS:
        for top in (2, 3):
            rows = [compare(campaign, found, name, top) for found in solved]
            mine = [r for r in rows if BAND[0] <= r[0] <= BAND[1]]
            ratios = f'{statistics.median(r[1] / r[2] for r in mine):.2f}' if mine else ''
            bars = f'{statistics.median(r[3] / r[2] for r in mine):.1f}' if mine else ''
            print(f'| {name} | {LEVELS[top][0]} | {len(mine)} of {len(rows)} | {ratios} | {sum(r[2] > r[1] for r in mine)} '
                  f'| {sum(r[4] >= 0.95 for r in mine)} of {len(mine)} | {bars} |')


if __name__ == '__main__':
    main()
