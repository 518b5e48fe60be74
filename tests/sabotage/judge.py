#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Says whether a bug of the film solvers is seen by the quality of its own run.

  judge.py --keep REFERENCE PROGRAM SOURCE     the scenes by a healthy build
  judge.py REFERENCE                           the same by $MUTANT_BUILD (tests/mutants --run)
  judge.py --sum RESULTS                       counts what tests/mutants wrote down

A scene is `caught` when the run fails or a line of its quality is worse than on the healthy build;
it has `moved` when h_min, p_max, traction or loss is off by more than the errors that the healthy
run states of itself. Last line: unchanged, caught, harmless (caught and not moved) or SILENT (moved
and not caught), with the largest move over the stated error. Exit code 1: caught.
"""
import bisect
import json
import os
import subprocess
import sys
import tempfile

SCENES = ['steady', 'cycle', 'auto', 'light', 'impact', 'conserving', 'rough', 'volume', 'dense']
SERIES = ['time', 'h_min', 'p_max', 'traction', 'power_loss']
VERDICTS = ['good', 'doubtful', 'bad']
LEAST = 1e-3  # stated error where a run states less
ROUGH = 0.05  # of rough films, which state none
LOADED = 0.1  # of the highest p_max: instants below are not compared


def run(program, source, scene):
    film = 'film_' + scene
    file = os.path.join(source, 'tests', 'sabotage', 'scenes.yaml')
    wanted = '--set=outputs=[' + ', '.join(f'{film}.{name}' for name in SERIES) + ']'
    with tempfile.TemporaryDirectory() as place:
        done = subprocess.run([program, 'run', file, '--json', '-o', place, wanted],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    try:
        answer = json.loads(done.stdout)
        stage = next(s for s in answer['stages'] if s['stage'] == film)
        quality = {k: [q['verdict'], q['value'] or 0] for k, q in stage['quality'].items()}
        series = {n: answer['outputs'][f'{film}.{n}']['data'] for n in SERIES}
    except (ValueError, KeyError, StopIteration, TypeError):
        return {'exit': done.returncode or 1}
    return {'exit': done.returncode, 'quality': quality, 'series': series}


def caught(healthy, found):
    """What tells of the bug."""
    if found['exit'] != healthy['exit'] or 'quality' not in found:
        return f'exit {found["exit"]}'
    for name, (verdict, _) in found['quality'].items():
        before = healthy['quality'].get(name, ['good'])[0]
        if VERDICTS.index(verdict) > VERDICTS.index(before):
            return f'{name} {verdict}'
    return ''


def errors(scene, healthy):
    """Stated errors of h_min, p_max, traction, loss."""
    if scene == 'rough':
        return dict.fromkeys(SERIES[1:], ROUGH)
    value = lambda *names: sum(healthy['quality'].get(n, ['', 0])[1] for n in names)  # noqa: E731
    film = value('h_central_space_error', 'h_central_time_error')
    return {'h_min': max(LEAST, value('h_min_space_error', 'h_min_time_error')),
            'p_max': max(LEAST, value('p_max_space_error', 'p_max_time_error')),
            'traction': max(LEAST, film),
            'power_loss': max(LEAST, film, value('power_loss_space_error', 'power_loss_time_error',
                                                   'power_loss_inlet_error'))}


def at(times, values, time):
    k = min(max(bisect.bisect_right(times, time), 1), len(times) - 1) if len(times) > 1 else 0
    if k == 0 or not times[k] > times[k - 1]:
        return values[k]
    share = min(max((time - times[k - 1]) / (times[k] - times[k - 1]), 0), 1)
    return values[k - 1] + share * (values[k] - values[k - 1])


def moved(scene, healthy, found):
    """Largest distance over the stated error, and of what."""
    if 'series' not in found:
        return 0, 'nothing'
    ours, theirs = healthy['series'], found['series']
    top = max(ours['p_max'])
    kept = [k for k, p in enumerate(ours['p_max']) if p > LOADED * top]
    most = (0, 'nothing')
    for name, error in errors(scene, healthy).items():
        scale = max(abs(v) for v in ours[name])
        offs = []
        for k in kept:
            there = at(theirs['time'], theirs[name], ours['time'][k])
            offs.append((there - ours[name][k]) / (ours[name][k] if name == 'h_min' else scale))
        off = abs(sum(offs)) / len(offs) if scene == 'rough' else max(map(abs, offs))
        most = max(most, (off / error, f'{name} of {scene}'))
    return most


def judge(reference):
    program = os.path.join(os.environ['MUTANT_BUILD'], 'flankfilm')
    source = os.environ['MUTANT_SOURCE']
    healthy = json.load(open(reference, encoding='utf-8'))
    seen, most, silent = [], (0, 'nothing'), (0, 'nothing')
    for scene in SCENES:
        found = run(program, source, scene)
        why = caught(healthy[scene], found)
        move = moved(scene, healthy[scene], found)
        most = max(most, move)
        if why:
            seen.append(f'{scene}: {why}')
        else:
            silent = max(silent, move)
    word = 'caught' if seen and most[0] > 1 else 'harmless' if seen else \
        'SILENT' if most[0] > 1 else 'unchanged'
    if seen and any(': exit' in s for s in seen):
        word = 'caught'
    print(f'{word}: moved {most[0]:.3g} times the stated error ({most[1]}); '
          f'unseen {silent[0]:.3g} ({silent[1]}); {"; ".join(seen)[:300]}')
    return 1 if seen else 0


def total(results):
    """Counts of the words, and of the mutants that crash or take too long, which are caught."""
    counts = {}
    for line in open(results, encoding='utf-8'):
        row = json.loads(line)
        word = row.get('said', '').split(':')[0]
        if row.get('outcome') == 'timeout':
            word = 'caught'
        if row.get('outcome') in ('killed', 'lived', 'timeout'):
            counts[word] = counts.get(word, 0) + 1
            if word == 'SILENT':
                print(row.get('name') or f'{row["file"]}:{row.get("line")}', row['said'])
    seen, silent = counts.get('caught', 0), counts.get('SILENT', 0)
    print(counts, f'seen of those that move a result: {seen} of {seen + silent}')


def main():
    if sys.argv[1] == '--sum':
        return total(sys.argv[2])
    if sys.argv[1] == '--keep':
        answers = {scene: run(sys.argv[3], sys.argv[4], scene) for scene in SCENES}
        json.dump(answers, open(sys.argv[2], 'w', encoding='utf-8'))
        for scene, answer in answers.items():
            doubt = [k for k, q in answer['quality'].items() if q[0] != 'good']
            print(scene, answer['exit'], 'not good:', doubt, errors(scene, answer))
        return 0
    return judge(sys.argv[1])


if __name__ == '__main__':
    sys.exit(main())
