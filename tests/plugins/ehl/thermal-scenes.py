# Random line contacts with thermal: full, steady and in time: slide-roll ratios from -1.9 to 1.9, 0.1 to 100 m/s, up to 4 GPa,
# oils of 40 to 200 degC, Newtonian and Eyring's. No run may crash, hang, give NaN, or leave the heat balance
# open; a film that is not found is refused in a sentence, and looked for with 1024 cells in place of 256. Each scene is a
# line of LOG, and is not run again. With `rough` the flanks of all scenes are, Rq 0.02 to 0.5 um.
#   thermal-scenes.py FLANKFILM SOURCE_ROOT LOG [COUNT [SECONDS [rough]]]
import collections
import json
import math
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time

flankfilm, root, log = sys.argv[1:4]
count = int(sys.argv[4]) if len(sys.argv) > 4 else 200
seconds = float(sys.argv[5]) if len(sys.argv) > 5 else math.inf
if sys.argv[6:] not in ([], ['rough']):
    sys.exit('%s: expected rough or nothing after SECONDS' % ' '.join(sys.argv[6:]))
rough = sys.argv[6:] == ['rough']
LIMIT = 300  # s of processor time; by the clock twenty times that, since other work may stand beside it
OUTPUTS = ['h_min', 'h_central', 'friction_coefficient', 'temperature_max', 'flash_temperature', 'power_loss']


def draw(number):
    """A scene, the same for the same number."""
    r = random.Random(2400 + number)
    R = 10 ** r.uniform(-2.3, -1.3)
    p_H = 10 ** r.uniform(math.log10(0.2), math.log10(4))
    scene = {
        'R': R, 'u': 10 ** r.uniform(-1, 2), 'slip': r.uniform(-1.9, 1.9), 'T': r.uniform(40, 200), 'p_H': p_H,
        'load': 2 * math.pi * R * (p_H * 1e9) ** 2 / 226.4e9, 'tau0': r.uniform(2, 30) if r.random() < 0.7 else 0,
        'moving': r.random() < 0.4, 'swing': r.uniform(0.05, 0.5), 'passages': r.uniform(1, 20),
    }
    if rough:
        scene.update(rq=10 ** r.uniform(math.log10(0.02), math.log10(0.5)), passages=min(scene['passages'], 2))
    return scene


def text_of(s, lab, cells=256):
    """The file of the scene, with a table of its history."""
    flow = 'rheology/ree-eyring, tau0: %g MPa' % s['tau0'] if s['tau0'] else 'rheology/newtonian'
    discs = ('contact/constant, radius: %r m, entrainment_speed: %r m/s, slide_roll_ratio: %r, load_per_width: %r N/m'
             % (s['R'], s['u'], s['slip'], s['load']))
    if s['moving']:
        a = math.sqrt(8 * s['load'] * s['R'] / (math.pi * 226.4e9))
        lasts = s['passages'] * 2 * a / s['u']
        with open(lab + '/history.csv', 'w') as f:
            f.write('time [s]; radius [m]; speed_1 [m/s]; speed_2 [m/s]; load_per_width [N/m]\n')
            for k in range(41):
                wave = math.sin(2 * math.pi * k / 40)
                u = s['u'] * (1 + s['swing'] / 2 * wave)
                f.write('%r; %r; %r; %r; %r\n' % (lasts * k / 40, s['R'], u * (1 + s['slip'] / 2), u * (1 - s['slip'] / 2),
                                                  s['load'] * (1 + s['swing'] * wave)))
        discs = 'contact/table, file: history.csv'
    skin = '  skin:  {use: surface/synthetic, rq: %r um}\n' % s['rq'] if rough else ''
    return """format: 2
include: [%s/configs/lubricants/gear-oil-mineral.yaml]
pipeline:
  oil:   {grade: ISO VG 100, temperature: %r degC}
  flow:  {use: %s}
  discs: {use: %s}
%s  film:  {use: ehl/finite-volume, cells: %d, thermal: full%s}
outputs: [%s]
""" % (os.path.abspath(root), s['T'], flow, discs, skin, cells, ', steps: 60' if s['moving'] else '', ', '.join('film.' + o for o in OUTPUTS))


def run(s, cells=256):
    with tempfile.TemporaryDirectory() as lab:
        path = lab + '/scene.yaml'
        with open(path, 'w') as f:
            f.write(text_of(s, lab, cells))
        try:
            told = subprocess.run([flankfilm, 'run', path, '--json', '-o', lab + '/out'], capture_output=True, text=True,
                                  timeout=20 * LIMIT, check=False,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT + 1)))
        except subprocess.TimeoutExpired:
            return {'end': 'hang'}
        if told.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            return {'end': 'hang'}
    if told.returncode not in (0, 1):
        return {'end': 'crash', 'code': told.returncode, 'text': told.stderr[-300:] + told.stdout[-300:]}
    answer = json.loads(told.stdout)
    if told.returncode == 1:
        return {'end': 'refused', 'text': answer['errors'][0]['message'][:300]}
    stage = next(x for x in answer['stages'] if x['stage'] == 'film')
    values = [x for name in OUTPUTS for x in answer['outputs']['film.' + name]['data']]
    line = stage['quality']['heat_balance']
    end = 'found' if all(isinstance(x, (int, float)) and math.isfinite(x) for x in values) else 'not a number'
    return {'end': end, 'balance': line['value'], 'verdict': line['verdict'],
            'flanks': stage['quality'].get('heat_of_flanks', {}).get('value'),
            'bad': [k for k, v in stage['quality'].items() if v['verdict'] == 'bad'],
            'hottest': max(answer['outputs']['film.temperature_max']['data'])}


done = {}
if os.path.exists(log):
    with open(log) as f:
        done = {line['scene']: line for line in map(json.loads, f)}
if any(('rq' in x['of']) != rough for x in done.values()):
    sys.exit(log + ' has scenes of ' + ('smooth' if rough else 'rough') + ' flanks: give another LOG')
begin = time.monotonic()
for number in range(count):
    if number in done or time.monotonic() - begin > seconds:
        continue
    scene = draw(number)
    came, cells = run(scene), 256
    if came['end'] == 'refused':
        came, cells = {'first': came['text'], **run(scene, 1024)}, 1024
    done[number] = {'scene': number, 'cells': cells, **came, 'of': scene}
    with open(log, 'a') as f:
        f.write(json.dumps(done[number]) + '\n')
lines = [done[k] for k in sorted(done) if k < count]
found = [x for x in lines if x['end'] == 'found']
print('%d of %d scenes run: %s' % (len(lines), count, dict(collections.Counter(x['end'] for x in lines))))
for moving in (False, True):
    part = [x for x in found if x['of']['moving'] == moving]
    refused = [x for x in lines if x['end'] == 'refused' and x['of']['moving'] == moving]
    if part:
        balances = sorted(x['balance'] for x in part)
        print('%s: %d found, %d refused; heat balance median %.1e, largest %.1e; verdicts %s'
              % ('in time' if moving else 'steady', len(part), len(refused), balances[len(balances) // 2], balances[-1],
                 dict(collections.Counter(x['verdict'] for x in part))))
sys.exit(any(x['end'] in ('hang', 'crash', 'not a number') or x.get('verdict') == 'bad' for x in lines))
