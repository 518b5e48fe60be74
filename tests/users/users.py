# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of users of format 1: each is refused with what it is in format 2, and that runs.

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
    words = [program, *words, '--plugin-path', plugins]
    for assignment in sets:
        words += ['--set', assignment]
    r = subprocess.run(words, cwd=lab, capture_output=True, text=True, timeout=240)
    return r.returncode, r.stdout, r.stderr


def paste(lab, said):
    """Writes each "# ---- FILE" block of the error over that file."""
    name, text = None, []
    for line in said.splitlines():
        if line.startswith('# ----'):
            if name:
                with open(os.path.join(lab, name), 'w', encoding='utf-8') as out:
                    out.write('\n'.join(text).rstrip('\n') + '\n')
            name, text = line[6:].strip(), []
        elif name:
            text.append(line)
    check('the last block is closed', name == '', said)


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


def old_gives_new(name):
    with laboratory() as lab:
        fresh(lab)
        code, out, said = flankfilm(lab, 'check', name + '.yaml')
        check(f'{name}: one error', code == 2 and 'format 1 is read no more' in said and '1 error;' in said, said)
        _, as_json, _ = flankfilm(lab, 'run', name + '.yaml', '--json')
        errors = json.loads(as_json)['errors']
        check(f'{name}: the same as JSON', len(errors) == 1 and 'format: 2' in errors[0]['hint'], as_json)
        paste(lab, said)
        code, out, said = flankfilm(lab, 'check', name + '.yaml')
        check(f'{name}: the new file is right', code == 0, out + said)
        few = FEW[name] + (QUICK if name != 'trade' else [])
        code, out, said = flankfilm(lab, 'run', name + '.yaml', '-o', 'results', sets=few)
        check(f'{name}: the new file runs', code == 0, out + said)


HAND = """format: 2
pipeline:
  gears: {{use: gear/involute-spur, teeth: [23, 67], module: 4 mm, pressure_angle: 20 deg, face_width: 40 mm,
          profile_shift: [0.35, -0.1], centre_distance: 181.1 mm, tip_relief: 25 um, roughness_rq: [0.4 um, 0.6 um]}}
  oil: {{use: lubricant/grade, grade: ISO VG 320, base: mineral}}
  viscosity: {{use: viscosity/{law}}}
  density: {{use: density/dowson-higginson, a: 0.6 1/GPa, b: 1.7 1/GPa}}
  flow: {{use: rheology/ree-eyring, tau0: 6 MPa}}
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
        paste(lab, flankfilm(lab, 'check', 'pair.yaml')[2])
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


def verify_says_it_too():
    with laboratory() as lab:
        fresh(lab)
        law = os.path.join(plugins, 'viscosity', 'roelands.so')
        r = subprocess.run([program, 'verify', law, '--pipeline', 'pair.yaml'], cwd=lab, capture_output=True,
                           text=True, timeout=60)
        code, said = r.returncode, r.stderr
        check('verify: one error with the new file', code == 2 and '1 error;' in said and '# ---- pair.yaml' in said, said)


def assignments_are_told():
    with laboratory() as lab:
        fresh(lab)
        _, _, said = flankfilm(lab, 'run', 'pair.yaml', sets=['oil.use=viscosity/barus', 'oil.temperature=80 degC'])
        check('a law', '--set oil.use is written --set viscosity.use now' in said, said)
        check('a temperature', '--set oil.temperature is written --set duty.oil_temperature now' in said, said)


def write(lab, text, name='old.yaml'):
    with open(os.path.join(lab, name), 'w', encoding='utf-8') as out:
        out.write(text)


def one_after_the_other():
    """The file that others include is of format 2 already when they are rewritten."""
    with laboratory() as lab:
        fresh(lab)
        paste(lab, flankfilm(lab, 'check', 'pair.yaml')[2])
        with open(os.path.join(lab, 'pair.yaml'), encoding='utf-8') as stream:
            pair = stream.read()
        for name in 'map', 'oils', 'stab', 'tol':
            _, _, said = flankfilm(lab, 'check', name + '.yaml')
            check(f'{name}: itself alone', said.count('# ---- ') == 1 and 'left as it is' not in said, said)
            paste(lab, said)
            code, out, said = flankfilm(lab, 'check', name + '.yaml')
            check(f'{name}: the new file is right', code == 0, out + said)
        with open(os.path.join(lab, 'pair.yaml'), encoding='utf-8') as stream:
            check('pair: left alone', stream.read() == pair)


LINE = '  discs: {use: contact/constant, radius: 12.8 mm, entrainment_speed: 4 m/s, load_per_width: 177 N/mm}\n' \
       '  film: {use: ehl/film-formula, viscosity: oil}\noutputs: [film.h_central]\n'
OTHERS = {
    'data sheet': ('format: 1\npipeline:\n  oil: {use: viscosity/roelands, nu_40: 100 cSt, nu_100: 11 cSt, '
                   'temperature: 60 degC, alpha: 18 1/GPa}\n  rho: {use: density/dowson-higginson, rho0: 870 kg/m3}\n'
                   + LINE, 'nu_40: 100 cSt'),
    'one point': ('format: 1\npipeline:\n  oil: {use: viscosity/barus, eta0: 5 mPa s, alpha: 11 1/GPa, '
                  'temperature: 80 degC}\n  rho: {use: density/dowson-higginson, rho0: 870 kg/m3}\n' + LINE,
                  'at: 80 degC'),
    'bare': ('format: 1\npipeline:\n  oil: {use: viscosity/barus, eta0: 5 mPa s, alpha: 11 1/GPa}\n'
             '  rho: {use: density/dowson-higginson, rho0: 870 kg/m3}\n' + LINE, 'viscosity: {use: viscosity/barus, eta0'),
    'card': ('format: 1\ninclude: [lubricants/mil-l-23699-100C.yaml]\npipeline:\n' + LINE, 'temperature: 100 degC'),
    'several laws': ('format: 1\npipeline:\n  oil: {use: viscosity/roelands, grade: ISO VG 220, temperature: 80 degC}\n'
                     '  other: {use: viscosity/barus, grade: ISO VG 320, temperature: 80 degC}\n'
                     '  rho: {use: density/dowson-higginson, rho0: 870 kg/m3}\n' + LINE.replace(
                         'load_per_width: 177 N/mm', 'load_per_width: 177 N/mm, viscosity: oil').replace(
                             'viscosity: oil}', 'viscosity: oil, oil: none}'), 'oil_oil: {use: lubricant/grade'),
    'temperature of a law': ('format: 1\npipeline:\n  oil: {use: viscosity/roelands, grade: ISO VG 220, temperature: 60 degC}\n'
                             '  rho: {use: density/dowson-higginson}\n  gears: {use: gear/involute-spur, teeth: [30, 40], '
                             'module: 4 mm, pressure_angle: 20 deg, face_width: 20 mm}\n  duty: {use: operating/steady, '
                             'torque: 100 N m, speed: 1000 rpm}\n  mesh: {use: stiffness/iso-6336}\n  tooth: {use: '
                             'contact/tooth-pair, load: mesh}\n  film: {use: ehl/film-formula}\noutputs: [film.h_central]\n',
                             'oil_temperature: 60 degC'),
    'flow style': ('format: 1\ninclude: [lubricants/sae-30-80C.yaml]\npipeline: {discs: {use: contact/constant, '
                   'radius: 12.8 mm, entrainment_speed: 4 m/s, load_per_width: 177 N/mm}, '
                   'film: {use: ehl/film-formula, viscosity: oil}}\noutputs: [film.h_central]\n', 'sae-30.yaml'),
}


def others_are_rewritten():
    for name, (text, holds) in OTHERS.items():
        with laboratory() as lab:
            write(lab, text)
            code, _, said = flankfilm(lab, 'check', 'old.yaml')
            check(f'{name}: refused', code == 2 and holds in said, said)
            paste(lab, said)
            code, out, said = flankfilm(lab, 'run', 'old.yaml')
            check(f'{name}: the new file runs', code == 0, out + said + open(os.path.join(lab, 'old.yaml')).read())


BROKEN = ['format: 1\n', 'format: 1\npipeline: 3\n', 'format: 1\npipeline: [a]\n', 'format: 1\npipeline: {oil: 3}\n',
          'format: 1\npipeline:\n  oil: {use: viscosity/barus, with: 3}\n', 'format: 1\npipeline:\n  oil: {use: [1]}\n',
          'format: 1\npipeline:\n  oil: {use: viscosity/barus, with: {viscosity/barus: 3}, grade: [1], eta0: {a: 1}}\n',
          'format: 1\ninclude: [nowhere.yaml]\npipeline:\n  a: {use: viscosity/barus, eta0: 1 Pa s}\n'
          '  b: {use: viscosity/barus, eta0: 1 Pa s}\n', '{format: 1, pipeline: {oil: {use: viscosity/barus}}}\n',
          'format: 1\ninclude: old.yaml\npipeline:\n', 'format: 1\nstudy: {sweep: {oil: [1, {a: 2}]}}\n',
          'format: 1\npipeline:\n  oil: &o {use: viscosity/barus, grade: x}\n  rho: *o\nstudy: 3\n',
          'format: 1\nstudy: {sweep: {oil: {}}, zip: {oil: [{}]}}\npipeline:\n  oil: {use: viscosity/barus, grade: ISO VG 3}']


def broken_ones_end_in_a_sentence():
    for text in BROKEN:
        with laboratory() as lab:
            write(lab, text)
            code, out, said = flankfilm(lab, 'check', 'old.yaml')
            check(f'{text!r}: code {code}', code == 2 and 'error' in said, out + said)


def a_new_file_over_an_old_one():
    with laboratory() as lab:
        fresh(lab)
        write(lab, 'format: 2\ninclude: pair.yaml\n', 'mine.yaml')
        code, _, said = flankfilm(lab, 'check', 'mine.yaml')
        check('the old one is rewritten', code == 2 and '# ---- pair.yaml' in said and '# ---- mine' not in said, said)


names = sorted(os.path.basename(p)[:-5] for p in glob.glob(os.path.join(folder, '*.yaml')))
check('all files have cheap cases', names == sorted(FEW))
for each in names:
    old_gives_new(each)
a_swap_is_of_the_law_alone()
verify_says_it_too()
assignments_are_told()
one_after_the_other()
others_are_rewritten()
broken_ones_end_in_a_sentence()
a_new_file_over_an_old_one()
print(f'{failed} failed')
sys.exit(1 if failed else 0)
