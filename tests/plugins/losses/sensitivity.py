# What 10 % of the rise with pressure and of the limiting stress make of the friction: a film that is solved anew against
# the formula by hand on the film as it was, tau = tau_E asinh(eta u_s/(tau_E h)), tau_E = 2 Lambda p/ln(eta/eta0).
#   sensitivity.py FLANKFILM PLUGINS SOURCE_ROOT
import json
import math
import subprocess
import sys

flankfilm, plugins, root = sys.argv[1:]
SLIDING, LOAD, LAMBDA, T = 1.2, 500e3, 0.047, 363.15
A, B = -2.28e7 + 2.26e5 * T, -0.0682 + 2.768e-4 * T
FILE = '''format: 2
include: [%s/configs/lubricants/vg-100-paraffinic.yaml]
pipeline:
  oil: {temperature: 90 degC}
  discs: {use: contact/constant, radius: 12 mm, entrainment_speed: 4 m/s, slide_roll_ratio: 0.3, load_per_width: 500 N/mm}
  film: {use: ehl/finite-volume, cells: 256}
outputs: [oil.eta0, film.friction_coefficient, film.x, film.film, film.pressure]
'''


def film(*sets):
    with open('sensitivity-film.yaml', 'w', encoding='utf-8') as f:
        f.write(FILE % root)
    words = [flankfilm, 'run', 'sensitivity-film.yaml', '--json', '--plugin-path', plugins]
    for word in sets:
        words += ['--set', word]
    told = json.loads(subprocess.run(words, capture_output=True, text=True, check=False).stdout)
    got = {}
    for path, output in told['outputs'].items():
        got[path.split('.')[1]] = output['value'] if 'value' in output else output['data']
    return got


def by_hand(f, rise=1., stress=1., thicker=1.):
    total = 0.
    x, h, p = f['x'], f['film'], f['pressure']
    for i, at in enumerate(p):
        if at <= 0:
            continue
        log = rise * at / (A + B * at)
        tau_E = 2 * stress * LAMBDA * at / log
        argument = f['eta0'] * math.exp(log) * SLIDING / (tau_E * thicker * h[i])
        total += min(tau_E * math.asinh(argument), max(stress * LAMBDA * at, tau_E)) * (x[1] - x[0])
    return total / LOAD


def hold(what, value, expected, within):
    off = abs(value / expected - 1)
    print('%s  %s: %.6g, by hand %.6g, off by %.2g of %.2g' % ('ok  ' if off <= within else 'BAD ', what, value, expected, off, within))
    return off <= within


base = film()
mu = abs(base['friction_coefficient'][-1])
limit = abs(film('flow.limiting_stress_coefficient=%g' % (1.1 * LAMBDA))['friction_coefficient'][-1])
rise = abs(film('viscosity.pressure_factor=1.1')['friction_coefficient'][-1])
# the film thickness is proportional to alpha^0.47 (Pan & Hamrock 1989)
good = [
    hold('friction', mu, by_hand(base), 1e-3),
    hold('Lambda +10 %', limit / mu, by_hand(base, stress=1.1) / by_hand(base), 2e-3),
    hold('alpha +10 %', rise / mu, by_hand(base, rise=1.1, thicker=1.1 ** 0.47) / by_hand(base), 1e-3),
]
sys.exit(0 if all(good) else 1)
