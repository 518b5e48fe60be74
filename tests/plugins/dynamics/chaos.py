#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions of several mesh cycles and of none, under light load: chaos.py FLANKFILM

A chaotic motion is doubtful whatever its accuracy; of one that repeats itself after
several cycles the engagements bear the torque together, and one of them alone does not.
"""
import json
import subprocess
import sys
import tempfile

PROGRAM = sys.argv[1]
PAIR = """format: 2
pipeline:
  gears:
    {use: gear/involute-spur, teeth: [23, 67], module: 4 mm, face_width: 40 mm,
     profile_shift: [0.35, -0.1], centre_distance: 181.1 mm, tip_relief: 25 um}
  duty: {use: operating/steady, torque: 20 N m, speed: 6500 rpm}
  mesh: {use: stiffness/load-distribution, compliance: analytical, points: 100}
  motion: {use: dynamics/shooting, damping_ratio: 0.05}
  tooth: {use: contact/tooth-pair, load: motion}
"""


def call(*settings, command='run'):
    with tempfile.TemporaryDirectory() as place:
        file = place + '/pair.yaml'
        with open(file, 'w', encoding='utf-8') as to:
            to.write(PAIR)
        more = [x for s in settings for x in ('--set', s)]
        where = ['-o', place + '/out'] if command == 'run' else []
        done = subprocess.run([PROGRAM, command, file, '--json', *where, *more],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    return json.loads(done.stdout)


def line(answer, stage, name):
    return next(s for s in answer['stages'] if s['stage'] == stage)['quality'][name]


def quality(answer, stage, name):
    return line(answer, stage, name)['value']


def check_accuracy():
    """The run must report a chaotic motion, and none of its error bars may be small."""
    wild = ['duty.speed=4500 rpm', 'outputs=[motion.dte_rms]']
    answer = call(*wild)
    assert answer['status'] == 'ok' and quality(answer, 'motion', 'stability') > 1, answer['errors']
    answer = call(*wild, 'accuracy=2 %', 'motion.use=dynamics/auto')
    error = answer['outputs']['motion.dte_rms']['error']['relative']
    print('chaos:', answer['verdict'], error, answer['accuracy']['models'])
    assert answer['verdict'] == 'doubtful' and quality(answer, 'motion', 'stability') > 1, answer
    assert all(not tried['taken'] for tried in answer['accuracy']['models']), answer['accuracy']
    tame = call('duty.torque=400 N m', 'accuracy=2 %', 'motion.use=dynamics/auto', *wild[1:])
    assert tame['status'] == 'ok', tame['errors']


def check_engagements():
    """Period 2: both engagements bear the torque on the mean, neither does alone.

    What is left is of the load's ramps, 8e-4, and of the force between stations."""
    outputs = 'outputs=[motion.period, tooth.mesh_load_mean, tooth.engagements_judged]'
    answer = call(outputs)
    assert answer['outputs']['motion.period']['value'] == 2, answer['outputs']
    assert answer['outputs']['tooth.engagements_judged']['value'] == 2, answer['outputs']
    both = quality(answer, 'tooth', 'mesh_load')
    one = [quality(call(outputs, f'tooth.engagement={k}'), 'tooth', 'mesh_load') for k in (0, 1)]
    print('mean load off by', both, 'of each alone', one)
    assert both < 2e-3 and min(one) > 5e-3, (both, one)
    said = [line(call(outputs, *more), 'tooth', 'mesh_load')['text']
            for more in ([], ['tooth.engagement=1'], ['tooth.max_engagements=1'])]
    print(*said, sep='\n')
    assert 'includes more' not in said[0], said
    assert 'only 1 of 2 engagements are included; engagement: all includes more' in said[1], said
    assert 'only 1 of 2 engagements are included; max_engagements includes more' in said[2], said


if __name__ == '__main__':
    check_accuracy()
    check_engagements()
