#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""dynamics/shooting near the folds of the 50/50 pair: near-folds.py FLANKFILM SOURCE

Within 0.5 % of a fold in which a stable motion ends the motion may jump, and the line beside the number of
stable motions names the fold and the rms of two of them; away from all folds there is no such line.
"""
import json
import re
import subprocess
import sys

PROGRAM, SOURCE = sys.argv[1:]
PAIR = [PROGRAM, 'run', SOURCE + '/configs/studies/speed-sweep.yaml', '--set', 'study=', '--json',
        '--set', 'motion.use=dynamics/shooting']


def run(frequency, outputs='motion.dte_rms, motion.stable_motions'):
    done = subprocess.run([*PAIR, '--set', f'outputs=[{outputs}]',
                           '--set', f'duty.mesh_frequency={frequency} Hz'],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    return json.loads(done.stdout)


def folds():
    """Of the atlas, from 1.2 to 4 kHz, in motions of one mesh cycle that are stable on one side."""
    names = ('fold_frequency', 'fold_branch', 'atlas_frequency', 'atlas_branch', 'atlas_stable')
    answer = run(3300, ', '.join('motion.' + n for n in names))
    fold, branch, at, of, stable = (answer['outputs']['motion.' + n]['data'] for n in names)
    found = []
    for f, b in zip(fold, branch):
        near = [s for x, y, s in zip(at, of, stable)
                if abs(x / f - 1) < 0.02 and y // 1000 == b // 1000]
        if b < 2000 and 1200 < f < 4000 and any(near):
            found.append(f)
    return found


def jump_of(answer):
    assert answer['status'] == 'ok', answer['errors']
    motion = next(s for s in answer['stages'] if s['stage'] == 'motion')
    return motion['quality'].get('distance_of_jump')


def main():
    known = folds()
    assert len(known) >= 3, known
    for f in known:
        for share in (0.997, 1.003):
            line = jump_of(run(f * share))
            said = line['text'] if line else 'no jump'
            print(f'{100 * (share - 1):+.1f} % of the fold at {f:.2f} Hz: {said}')
            assert line and line['verdict'] == 'doubtful' and 0 < line['value'] <= 0.005, said
            assert len(re.findall(r'[\d.]+ um', said)) == 2, said
    for f in (1700, 2000, 2500, 3300):
        assert min(abs(f / k - 1) for k in known) > 0.006, f
        assert jump_of(run(f)) is None, f
        print(f'{f} Hz: no jump')


if __name__ == '__main__':
    main()
