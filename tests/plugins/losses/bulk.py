# The tooth temperature that results from the losses: compares the loop film.bulk with its closed form. Over a few kelvins the loss
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


def agreement(*sets):
    """The line that holds the losses' temperature of the teeth against that of the film: value, its limit, is it a doubt of the range?"""
    told = json.loads(run(*sets, 'outputs=[losses.power_loss_mean]').stdout)
    lines = [stage['quality']['bulk_temperature_agreement'] for stage in told['stages'] if 'bulk_temperature_agreement' in stage['quality']]
    return (lines[0]['value'], lines[0]['limit'], lines[0].get('of', lines[0]['verdict'])) if len(lines) == 1 else None


def true(what, holds, told=''):
    print('%s  %s %s' % ('ok  ' if holds else 'BAD ', what, told))
    return holds


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
# The rise that the loss of a film at r over the oil makes falls with r, so that r = f(r) has one root; from far above it,
# f again and again ends where the loop does, which begins at the oil.
RULED = RULE[2:4]
from_hot = [70.]
for _ in range(4):
    from_hot.append(loss(*RULED, 'film.bulk_temperature=%.9g degC' % (110 + from_hot[-1]))[1])
at_oil = loss(*RULED, 'film.bulk_temperature=110 degC')[1]
good += [
    hold('the root from above, in K over 1 K', 1 + from_hot[-1] - standard_rise, 1, 0.01),
    true('the rise falls with the temperature of the film', at_oil > standard_rise > from_hot[1], (at_oil, standard_rise, from_hot[1])),
    hold('rise_factor', loss(*RULED, 'losses.rise_factor=1.3', 'film.bulk_temperature=110 degC')[1], 1.3 * at_oil, 1e-9),
]
apart = agreement('film.bulk_temperature=117 degC', 'losses.bulk_temperature=130 degC')
near = agreement('film.bulk_temperature=117 degC', 'losses.bulk_temperature=125 degC')
closed = agreement(*RULE)
good += [
    true('13 K apart are told', apart and abs(apart[0] - 13) < 1e-6 and apart[1] == 10 and apart[2] != 'good', apart),
    true('8 K are not', near and abs(near[0] - 8) < 1e-6 and near[2] == 'good', near),
    true('a loop agrees with itself', closed and closed[0] < 1e-3 and closed[2] == 'good', closed),
]
sys.exit(0 if all(good) else 1)
