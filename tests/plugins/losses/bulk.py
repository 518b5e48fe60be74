# The temperature that teeth take by their own loss: the loop film.bulk against its closed form. Over a few kelvins the loss
# is a parabola, L(r) = L0 - s r + b r^2 with r over the oil, and G r = L(r) has a root of its own.
#   bulk.py FLANKFILM PLUGINS SOURCE_ROOT
import json
import math
import subprocess
import sys

flankfilm, plugins, root = sys.argv[1:]
COARSE = ['film.cells=64', 'film.steps=20', 'mesh.use=stiffness/iso-6336', 'duty.speed=6000 rpm',
          'outputs=[losses.power_loss_mean, losses.bulk_temperature]']


def run(*sets):
    words = [flankfilm, 'run', root + '/configs/validation/mesh-loss-heat.yaml', '--json', '--plugin-path', plugins]
    for word in (*COARSE, *sets):
        words += ['--set', word]
    return subprocess.run(words, capture_output=True, text=True, check=False)


def loss(*sets):
    told = json.loads(run(*sets).stdout)
    scalars = next(stage for stage in told['stages'] if stage['stage'] == 'losses')['scalars']
    return scalars['power_loss_mean']['value'], scalars['bulk_temperature']['value'] - 383.15


def hold(what, value, expected, within):
    off = abs(value / expected - 1)
    print('%s  %s: %.8g, expected %.8g, off by %.2g of %.2g' % ('ok  ' if off <= within else 'BAD ', what, value, expected, off, within))
    return off <= within


def refused(what, sentence, *sets):
    told = run(*sets)
    found = told.returncode != 0 and sentence in told.stdout + told.stderr
    print('%s  %s is refused' % ('ok  ' if found else 'BAD ', what))
    return found


G, RISE = 100., 4.
WIRED = ('film.bulk=losses', 'losses.ehl=film', 'losses.thermal_conductance=%g W/K' % G)
cold, _ = loss()
less, least = [cold - loss('film.bulk_temperature=%g degC' % (110 + r))[0] for r in (RISE / 2, RISE)]
bend = 2 * (2 * less - least) / RISE ** 2
slope = least / RISE + bend * RISE
power, rise = loss(*WIRED, 'feedback.tolerance=1e-8')
# G r = L0 - s r + b r^2, within the 1e-4 that the factors of a step settle to
by_hand = 2 * cold / (G + slope + math.sqrt((G + slope) ** 2 - 4 * bend * cold))
RULE = ('film.bulk=losses', 'losses.ehl=film', 'losses.bulk_rule=standard', 'losses.supply=spray', 'feedback.tolerance=1e-6')
standard, standard_rise = loss(*RULE)
good = [
    # ISO/TR 15144-1 (84) at the loss that the loop ends with, a 91.5 mm, b 26.7 mm, X_S 1.2
    hold('rise by the standard', standard_rise, 7400 * (1e-3 * standard / (91.5 * 26.7)) ** 0.72, 1e-4),
    hold('rise of the teeth over the oil', rise, by_hand, 1e-4),
    hold('loss through the conductance', power, G * rise, 1e-6),
    refused('a second bulk temperature', 'leave one of them out', *WIRED, 'losses.bulk_temperature=120 degC'),
    refused('a film without temperatures', 'needs thermal: full', *WIRED, 'film.thermal=none'),
]
sys.exit(0 if all(good) else 1)
