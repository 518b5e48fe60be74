# SPDX-License-Identifier: GPL-3.0-or-later
"""Random gear scenes, drawn by seed, and runs of them."""
import bisect
import json
import math
import os
import random
import subprocess
import tempfile

OILS = ['gear-oil-mineral', 'mil-l-23699', 'sae-30', 'vg-100-pao', 'pao-b',
        'santotrac-50', 'vg-100-naphthenic', 'cardiff-reference']
# at which the laws of their cards were fitted
TEMPERATURES = {oil: '100 degC' if oil in ('mil-l-23699', 'cardiff-reference') else '80 degC' for oil in OILS}
LAWS = ['roelands', 'barus', 'doolittle-tait']


def draw(seed, swift=False):
    """Returns random gears, a load from the Hertz pressure at the pitch point, a pitch line speed and an oil."""
    r = random.Random(seed)
    z1 = r.randint(18, 45)
    z2 = round(z1 * r.choice([1, 1, 1.5, 2, 3]))
    module = r.choice([1.5, 2, 3, 4, 5, 6])
    width = module * r.uniform(5, 12)
    radius = module * z1 * z2 / (z1 + z2) / 2 * math.sin(math.radians(20))
    pressure = 10 ** r.uniform(math.log10(0.25), math.log10(1.6))
    load = 2 * math.pi * radius * pressure ** 2 / 226.4 * 1e3
    torque = load * width * z1 * module / 2 * math.cos(math.radians(20)) / 1e3
    speed = 10 ** r.uniform(math.log10(6 if swift else 1), math.log10(30))
    rpm = speed * 1e3 / (z1 * module / 2) * 60 / (2 * math.pi)
    return {'teeth': [z1, z2], 'module': module, 'width': width, 'torque': torque, 'rpm': rpm,
            'oil': r.choice(OILS), 'law': r.choice(LAWS),
            'motion': r.choice(['quasi-static', 'auto', 'auto']),
            'rheology': r.random() < 0.7}


def text_of(scene, source, stages, outputs):
    """The file; `stages`: what to `use` for mesh, motion and film, where it is not what was drawn.
    """
    motion = stages.get('motion') or 'use: dynamics/' + scene['motion']
    damping = ', damping_ratio: 0.04' if 'quasi-static' not in motion else ''
    wire = '' if scene['rheology'] else ', rheology: none'
    return f"""format: 2
include: [{source}/configs/lubricants/{scene['oil']}.yaml]
pipeline:
  gears: {{use: gear/involute-spur, teeth: {scene['teeth']}, module: {scene['module']} mm,
           face_width: {scene['width']:.3f} mm, backlash: {0.04 * scene['module']:.4f} mm}}
  duty: {{use: operating/steady, torque: {scene['torque']:.5g} N m, speed: {scene['rpm']:.5g} rpm,
          oil_temperature: {TEMPERATURES[scene['oil']]}}}
  mesh: {{{stages.get('mesh', 'use: stiffness/potential-energy')}}}
  motion: {{{motion}{damping}}}
  tooth: {{use: contact/tooth-pair, load: motion}}
  viscosity: {{use: viscosity/{scene['law']}}}
  film: {{{stages.get('film', 'use: ehl/film-formula')}{wire}}}
outputs: [{', '.join(outputs)}]
"""


class Runner:
    def __init__(self, program, source):
        self.program, self.source = program, os.path.abspath(source)
        self.file = os.path.join(tempfile.mkdtemp(), 'scene.yaml')

    def run(self, scene, outputs, arrays=False, sets=(), **stages):
        with open(self.file, 'w') as stream:
            stream.write(text_of(scene, self.source, stages, outputs))
        command = [self.program, 'run', self.file, '--json'] + ['--arrays'] * arrays
        command += [f'--set={s}' for s in sets]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              check=False)
        return json.loads(done.stdout)


def stage(answer, name):
    return next(s for s in answer['stages'] if s['stage'] == name)


def chosen(answer, name):
    """Returns the chosen candidate, and its settings as a map."""
    found = next(c for c in stage(answer, name)['choice']['candidates'] if c['chosen'])
    pairs = [p.split(': ') for p in found['proposals'].split(', ') if p]
    return found, dict(pairs)


def sample(times, values, at):
    """Interpolates linearly between the times."""
    i = min(max(bisect.bisect_right(times, at), 1), len(times) - 1)
    span = times[i] - times[i - 1]
    share = min(max((at - times[i - 1]) / span, 0), 1) if span > 0 else 1
    return values[i - 1] + share * (values[i] - values[i - 1])


def off_on_the_mean(times, values, exact_times, exact):
    """Returns the mean difference over the mean of the exact values."""
    begin, span = exact_times[0], exact_times[-1] - exact_times[0]
    points = [begin + span * k / 2000 for k in range(2001)]
    a = [sample(exact_times, exact, t) for t in points]
    b = [sample(times, values, t) for t in points]
    return sum(abs(p - q) for p, q in zip(a, b)) / sum(abs(p) for p in a)
