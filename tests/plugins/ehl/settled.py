# SPDX-License-Identifier: GPL-3.0-or-later
"""The mass of a film must be in balance at each instant, within its tolerance.

  settled.py FLANKFILM SOURCE

A pair at 100 rpm under 1500 N m takes thousands of short steps, of which almost each is accepted
after its first Newton step. A residual of the mass balance in a step would add to that of the next.
"""
import json
import os
import subprocess
import sys
import tempfile

flankfilm, source = (os.path.abspath(a) for a in sys.argv[1:3])
PAIR = f"""format: 2
include: [{source}/configs/lubricants/gear-oil-mineral.yaml]
pipeline:
  gears: {{use: gear/involute-spur, teeth: [23, 67], module: 4 mm, pressure_angle: 20 deg, face_width: 40 mm,
          profile_shift: [0.35, -0.1], centre_distance: 181.1 mm, tip_relief: 25 um}}
  oil: {{use: lubricant/grade, grade: ISO VG 320, base: mineral}}
  viscosity: {{use: viscosity/roelands}}
  duty: {{use: operating/steady, torque: 1500 N m, speed: 100 rpm, oil_temperature: 70 degC}}
  mesh: {{use: stiffness/potential-energy}}
  motion: {{use: dynamics/shooting, damping_ratio: 0.05}}
  tooth: {{use: contact/tooth-pair, load: motion}}
  film: {{use: ehl/finite-volume, cells: 256}}
outputs: [film.mass_error]
"""
LEAST_INSTANTS = 2000

with tempfile.TemporaryDirectory() as lab:
    with open(os.path.join(lab, 'pair.yaml'), 'w', encoding='utf-8') as stream:
        stream.write(PAIR)
    words = [flankfilm, 'run', 'pair.yaml', '--json', '--arrays', '-o', 'results']
    done = subprocess.run(words, cwd=lab, capture_output=True, text=True, check=False)
answer = json.loads(done.stdout)
errors = answer['outputs']['film.mass_error']['data']
film = next(s for s in answer['stages'] if s['stage'] == 'film')
line = film['quality']['mass_balance']
print(f"{len(errors)} instants, mass open by {max(errors):.3g} at most, of {line['limit']:.3g}")
sys.exit(not (len(errors) > LEAST_INSTANTS and max(errors) < line['limit'] and line['verdict'] == 'good'))
