# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of users run, a law is swapped by one word, and a file of format 1 is one error that says what is read.

    users.py FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT
"""
import contextlib
import glob
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile

program, plugins, source = (os.path.abspath(a) for a in sys.argv[1:4])
folder = os.path.join(source, 'tests', 'users')
failed = 0

# what makes the cases few and cheap; all that concerns the oil stays as the file has it
FEW = {
    'map': ['study.sweep.duty.torque.points=2', 'study.sweep.duty.speed.points=2'],
    'oils': ['study.sweep.duty.speed=[1450 rpm]', 'film.use=ehl/film-formula'],
    'pair': ['film.use=ehl/film-formula'],
    'rough': ['film.cells=64', 'film.steps=20'],
    'speed': ['study.sweep.duty.speed.points=2', 'film.use=ehl/film-formula'],
    'stab': ['study.stability.axes.duty.speed.points=2', 'study.stability.axes.duty.torque.points=2',
             'study.stability.bisect=0', 'film.cells=96', 'film.steps=60'],
    'tol': ['study.sample.sobol=2', 'film.use=ehl/film-formula'],
    'trade': ['study.tradeoff.candidates=[{film.use: [ehl/film-formula, ehl/inlet-analysis]}]',
              'study.tradeoff.reference={film.use: ehl/inlet-analysis, film.steps: 200}',
              'study.tradeoff.repeats=1', 'film.steps=50'],
}
QUICK = ['mesh.use=stiffness/iso-6336']


@contextlib.contextmanager
def laboratory():
    """A folder with the examples in it, which a build outside of the sources does not find by itself."""
    with tempfile.TemporaryDirectory() as lab:
        for name in 'gears', 'lubricants':
            os.symlink(os.path.join(source, 'configs', name), os.path.join(lab, name))
        yield lab


def check(what, good, said=''):
    global failed
    if not good:
        failed += 1
        print(f'not ok: {what}\n{said}')


def flankfilm(lab, *words, sets=()):
    words = [program, *words] + (['--plugin-path', plugins] if words[0] != 'verify' else [])
    for assignment in sets:
        words += ['--set', assignment]
    r = subprocess.run(words, cwd=lab, capture_output=True, text=True, timeout=240)
    return r.returncode, r.stdout, r.stderr


def trace(path, seed):
    with open(path, 'w', encoding='utf-8') as out:
        out.write('position [um]; height [um]\n')
        for i in range(20000):
            x = 0.4 * i
            out.write(f'{x:g}; {0.4 * math.sin(x / 13 + seed) + 0.3 * math.sin(x / 31):.5f}\n')


def fresh(lab):
    for path in glob.glob(os.path.join(folder, '*')):
        shutil.copy(path, lab)
    trace(os.path.join(lab, 'pinion.csv'), 0)
    trace(os.path.join(lab, 'wheel.csv'), 1)


def runs(name):
    with laboratory() as lab:
        fresh(lab)
        code, out, said = flankfilm(lab, 'check', name + '.yaml')
        check(f'{name}: the file is right', code == 0, out + said)
        few = FEW[name] + (QUICK if name != 'trade' else [])
        code, out, said = flankfilm(lab, 'run', name + '.yaml', '-o', 'results', sets=few)
        check(f'{name}: the file runs', code == 0, out + said)


HAND = """format: 2
pipeline:
  gears: {{use: gear/involute-spur, teeth: [23, 67], module: 4 mm, pressure_angle: 20 deg, face_width: 40 mm,
          profile_shift: [0.35, -0.1], centre_distance: 181.1 mm, tip_relief: 25 um, roughness_rq: [0.4 um, 0.6 um]}}
  oil: {{use: lubricant/grade, grade: ISO VG 320, base: mineral}}
  viscosity: {{use: viscosity/{law}}}
  density: {{use: density/dowson-higginson, a: 0.6 1/GPa, b: 1.7 1/GPa, K0_decay: 0.0063 1/K, at: 80 degC}}
  flow: {{use: rheology/ree-eyring, tau0: auto}}
  duty: {{use: operating/steady, torque: 1100 N m, speed: 1450 rpm, oil_temperature: 70 degC}}
  mesh: {{use: stiffness/iso-6336}}
  tooth: {{use: contact/tooth-pair, load: mesh}}
  film: {{use: ehl/finite-volume, cells: 96, steps: 60}}
outputs: [oil.temperature, oil.eta0, oil.rho0, film.h_min]
"""
LAWS = {
    'roelands': 'roelands, z: 0.5826',
    'barus': 'barus, alpha: 16.47 1/GPa',
    'two-slope': 'two-slope, alpha_1: 16.63 1/GPa, alpha_2: 10.22 1/GPa, p_transition: 0.25 GPa',
    'doolittle-tait': 'doolittle-tait, B: 5.6757, V_occ: 0.6132, K0: 1.15 GPa, K0_prime: 10.076',
}
COARSE = ['mesh.use=stiffness/iso-6336', 'tooth.load=mesh', 'film.cells=96', 'film.steps=60',
          'outputs=[oil.temperature, oil.eta0, oil.rho0, film.h_min]']


def values(lab, path, sets=()):
    code, out, said = flankfilm(lab, 'run', path, '--json', sets=sets)
    check(f'{path} {sets}', code == 0, out[-3000:] + said)
    outputs = json.loads(out)['outputs']
    return {k: v['data'] if 'data' in v else v['value'] for k, v in outputs.items()}


def a_swap_is_of_the_law_alone():
    with laboratory() as lab:
        fresh(lab)
        own = values(lab, 'pair.yaml', COARSE)
        for law, text in LAWS.items():
            with open(os.path.join(lab, 'hand.yaml'), 'w', encoding='utf-8') as out:
                out.write(HAND.format(law=text))
            swapped = values(lab, 'pair.yaml', COARSE + [f'viscosity.use=viscosity/{law}'])
            hand = values(lab, 'hand.yaml')
            for key in ('oil.temperature', 'oil.eta0', 'oil.rho0'):
                check(f'{law}: {key} to the bit', swapped[key] == own[key] == hand[key])
            off = max(abs(a / b - 1) for a, b in zip(swapped['film.h_min'], hand['film.h_min']))
            moved = max(abs(a / b - 1) for a, b in zip(swapped['film.h_min'], own['film.h_min']))
            print(f'{law}: h_min off a file written by hand by {off:.1e}, moved by {moved:.1e}')
            check(f'{law}: h_min as by hand', off < 1e-9)
            check(f'{law}: it is another law', (moved > 1e-3) == (law != 'roelands'))


def write(lab, text, name='old.yaml'):
    with open(os.path.join(lab, name), 'w', encoding='utf-8') as out:
        out.write(text)


OLD = ('format: 1\npipeline:\n  oil: {use: viscosity/barus, eta0: 5 mPa s, alpha: 11 1/GPa, temperature: 80 degC}\n'
       '  rho: {use: density/dowson-higginson, rho0: 870 kg/m3}\n')
SAID = ('old.yaml:1:9: error: format: expected 2, the only format that this version reads, found "1"\n'
        '    1 | format: 1\n      |         ^\nhint: the new names are listed in docs/lubricants.md, "From format 1"\n1 error;')
BROKEN = ['format: 1\n', 'format: 1\npipeline: 3\n', 'format: 1\npipeline: [a]\n', '{format: 1, pipeline: {oil: {use: [1]}}}\n',
          'format: 1\ninclude: old.yaml\npipeline:\n', 'format: 1\ninclude: [nowhere.yaml]\n', 'format: 1\nstudy: {sweep: {oil: [1]}}\n',
          'format: 1\npipeline:\n  oil: &o {use: viscosity/barus, grade: x}\n  rho: *o\nstudy: 3\n']


def format_1_is_one_error():
    with laboratory() as lab:
        write(lab, OLD)
        write(lab, 'format: 2\ninclude: old.yaml\noutputs: [nothing]\n', 'mine.yaml')
        law = os.path.join(plugins, 'viscosity', 'barus.so')
        for words in (['check', 'old.yaml'], ['run', 'old.yaml', '--set', 'oil.grade=x'], ['check', 'mine.yaml'],
                      ['explain', 'old.yaml'], ['plan', 'old.yaml']):
            code, out, said = flankfilm(lab, *words)
            check(f'{words}: one error', code == 2 and said.startswith(SAID), out + said)
        code, out, said = flankfilm(lab, 'verify', law, '--pipeline', 'old.yaml')
        check('verify: one error', code == 2 and 'old.yaml: format: expected 2' in said and '1 error;' in said, out + said)
        for text in BROKEN:
            write(lab, text)
            code, out, said = flankfilm(lab, 'check', 'old.yaml')
            check(f'{text!r}: code {code}', code == 2 and '1 error;' in said, out + said)
        with open(os.path.join(source, 'docs', 'lubricants.md'), encoding='utf-8') as page:
            check('the table is there', '### From format 1\n' in page.read())


names = sorted(os.path.basename(p)[:-5] for p in glob.glob(os.path.join(folder, '*.yaml')))
check('all files have cheap cases', names == sorted(FEW))
for each in names:
    runs(each)
a_swap_is_of_the_law_alone()
format_1_is_one_error()
print(f'{failed} failed')
sys.exit(1 if failed else 0)
