#!/usr/bin/env python3
"""Two gears entered in either order: pinion first, or wheel first, so that the wheel drives at the same power.

  roles.py FLANKFILM PLUGINS

Compares every output of every stage with the corresponding output of the exchanged pair. The rule follows from its dimensions,
or is in EXCEPT. Outputs that may differ are in MAY, with the reason and the largest difference found. An output without a rule
is an error, and so is a kind of models that no scene uses.

mirrored   The quasi-static pipeline. If the wheel drives, contact moves along the same line of action, but from the other end.
           At the place where a flank pair meets, forces, radii, pressures, films by formula, losses and ratings are the
           same; speeds and flanks exchange their numbers, sliding and friction their sign. Reliefs exceed C_eff and no
           addendum contact ratio is 1.5 times the other, so that X_J, X_Q and X_Ca of the scuffing standard, which ask
           who drives, are the same, too; test `scuffing` has them where they differ.
motions    A motion has friction, and so a direction of time. Here stiffness and path are the same from both ends: k is
           rectangular, both flanks have the same largest radius of curvature. Then all motions are the same from SAP on.
films      Films in time: they carry through the contact what its inlet gave them, and so remember where they come from.
"""
import bisect
import fnmatch
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile

flankfilm, plugins = sys.argv[1:]

OIL = {
    'oil': 'use: lubricant/grade, grade: ISO VG 220, base: mineral',
    'viscosity': 'use: viscosity/roelands', 'density': 'use: density/dowson-higginson', 'flow': 'use: rheology/ree-eyring, tau0: 6 MPa',
}
# values of the two gears, in the order of the file; all differ
RELIEVED = {
    'teeth': (19, 41), 'profile_shift': (0.35, -0.1), 'bore_diameter': ('20 mm', '45 mm'), 'dedendum': (1.25, 1.2),
    'tool_tip_radius': (0.3, 0.35), 'thickness_allowance': ('-60 um', '-90 um'), 'elastic_modulus': ('206 GPa', '188 GPa'),
    'poisson_ratio': (0.3, 0.28), 'density': ('7850 kg/m3', '7200 kg/m3'),
    'thermal_conductivity': ('47 W/(m K)', '40 W/(m K)'), 'specific_heat': ('455 J/(kg K)', '500 J/(kg K)'), 'tip_relief': ('26 um', '21 um'),
    'root_relief': ('3 um', '5 um'), 'crowning': ('2 um', '1 um'), 'profile_slope': ('1 um', '-2 um'), 'roughness_ra': ('0.3 um', '0.7 um'),
}
INDEXED = ([3, -1, 0, 2] + 8 * [0], [0, 4] + 16 * [0])  # um; teeth in the order in which they come
RAMP = 4.  # deg over the teeth of gear 1: load_ramp is a roll angle of gear 1
TORQUE, SPEED = 90., 1800.  # of the gear with index 0

# both tips reach 22.85 mm beyond the point of tangency of the line of action, x1 = 0.5 and x2 = -0.5
BASE = [3 * z * math.cos(math.radians(20)) / 2 for z in (25, 40)]
ALIKE = {
    'teeth': (25, 40), 'profile_shift': (0.5, -0.5), 'tip_diameter': tuple('%.12g mm' % (2 * math.hypot(b, 22.85)) for b in BASE),
    'elastic_modulus': ('206 GPa', '120 GPa'), 'density': ('7850 kg/m3', '7100 kg/m3'), 'bore_diameter': ('20 mm', '50 mm'),
}


def flow(values):
    return '{' + ', '.join('%s: %s' % item for item in values.items()) + '}'


def gear(pair, order, **more):
    values = {name: '[%s, %s]' % ((v[0], v[1]) if order == 0 else (v[1], v[0])) for name, v in pair.items()}
    return flow({'use': 'gear/involute-spur', 'module': '3 mm', 'face_width': '18 mm', **values, **more})


def duty(pair, order, torque=TORQUE, speed=SPEED):
    ratio = pair['teeth'][order] / pair['teeth'][0]
    return '{use: operating/steady, torque: %.17g N m, speed: %.17g rpm, oil_temperature: 70 degC}' % (torque * ratio, speed / ratio)


def mirrored(order):
    """All stiffness models, each with the quasi-static stages after it."""
    stages = {'gears': gear(RELIEVED, order), 'duty': duty(RELIEVED, order), **{k: '{%s}' % v for k, v in OIL.items()}}
    ratio = run(lambda _: {'gears': stages['gears']}, 0)['of']['gears.contact_ratio']['value']
    double, single = [(0, 3.2), (0.2, 3.3), (ratio - 1, 3.1)], [(ratio - 1, 2.0), (0.8, 2.3), (1, 2.2)]
    if order == 1:
        double, single = [(ratio - 1 - x, k) for x, k in double[::-1]], [(ratio - x, k) for x, k in single[::-1]]
    phases, levels = zip(*double, *single)
    sources = {
        'elastic': 'use: stiffness/load-distribution, points: 1600', 'energy': 'use: stiffness/potential-energy, points: 400',
        'rectangle': 'use: stiffness/iso-6336, points: 400',
        'ramps': 'use: stiffness/iso-6336, shape: trapezoidal, points: 400',
        'table': 'use: stiffness/table, ends: jump, points: 400, phase: [%s], stiffness: [%s]' % (
            ', '.join('%.13g' % x for x in phases), ', '.join('%g N/m' % (1e8 * k) for k in levels)),
    }
    for name, source in sources.items():
        stages[name] = '{%s}' % source
        stages['still_' + name] = '{use: dynamics/quasi-static, stiffness: %s}' % name
        stages['pair_' + name] = '{use: contact/tooth-pair, load: still_%s, points: 400, load_ramp: %.12g deg}' % (name, RAMP / RELIEVED['teeth'][order])
        stages['film_' + name] = '{use: ehl/film-formula, contact: pair_%s}' % name
    stages['inlet'] = '{use: ehl/inlet-analysis, contact: pair_energy}'
    for film in ('film_elastic', 'film_ramps'):
        stages['loss_' + film] = '{use: losses/tooth-mesh, ehl: %s}' % film
    stages['scuffing'] = '{use: rating/scuffing, load_stage: 12, losses: loss_film_elastic, dynamics: still_elastic}'
    stages['micropitting'] = '{use: rating/micropitting, ehl: film_elastic, dynamics: still_elastic, test_lambda: 0.1, test_own_lambda: 0.2}'
    return stages


def indexed(order):
    """Index deviations, over the whole hunting period; from the other end the teeth come in the other order."""
    lists = INDEXED if order == 0 else [[w[-k] for k in range(len(w))] for w in INDEXED[::-1]]
    names = {n: '[%s]' % ', '.join('%g um' % x for x in w) for n, w in zip(('pitch_error', 'pitch_error_2'), lists)}
    pair = {**RELIEVED, 'teeth': (12, 18), 'profile_shift': (0.4, 0.1)}
    return {
        'gears': gear(pair, order, **names), 'duty': duty(pair, order),
        'mesh': '{use: stiffness/potential-energy, points: 200}',
    }


def motions(order):
    stages = {
        'gears': gear(ALIKE, order, backlash='0.1 mm'), 'duty': duty(ALIKE, order, 60, 3000),
        'mesh': '{use: stiffness/iso-6336}', **{k: '{%s}' % v for k, v in OIL.items()},
    }
    stages['shooting'] = '{use: dynamics/shooting, damping_ratio: 0.05, atlas: {from: 600 Hz, to: 1300 Hz}}'
    stages['balance'] = '{use: dynamics/harmonic-balance, damping_ratio: 0.05}'
    stages['steps'] = '{use: dynamics/time-integration, damping_ratio: 0.05}'
    stages['coupled'] = '{use: dynamics/coupled, damping_ratio: 0.05, bearing_stiffness: [%s]}' % ', '.join(
        ('3e8 N/m', '5e8 N/m') if order == 0 else ('5e8 N/m', '3e8 N/m'))
    return stages


def rattle(order):
    """Oil between separated flanks, whose entrainment carries the load of an idling pair."""
    return {
        'gears': gear(ALIKE, order, backlash='0.1 mm'), 'duty': duty(ALIKE, order, 1, 1500), 'mesh': '{use: stiffness/iso-6336}',
        **{k: '{%s}' % v for k, v in OIL.items()},
        'idle': '{use: dynamics/time-integration, damping_ratio: 0.05, squeeze: series, squeeze_rolling: true, '
                'cycles_settle: 50, cycles_measured: 20, steps_per_cycle: 100}',
    }


def films(order):
    def rough(*flanks):
        return ', '.join(flanks if order == 0 else flanks[::-1])
    stages = {
        'gears': gear(RELIEVED, order), 'duty': duty(RELIEVED, order), **{k: '{%s}' % v for k, v in OIL.items()},
        'mesh': '{use: stiffness/iso-6336, shape: trapezoidal, points: 1600}', 'tooth': '{use: contact/tooth-pair, load: mesh}',
        'rough': '{use: surface/synthetic, rq: [%s]}' % rough('0.1 um', '0.2 um'),
        'volume': '{use: ehl/finite-volume, contact: tooth, surface: none, cells: 128, steps: 200}',
        'control': '{use: ehl/control-volume, contact: tooth, surface: none, cells: 128, steps: 200}',
        'mixed': '{use: ehl/finite-volume, contact: tooth, surface: rough, cells: 256, steps: 300}',
    }
    for film in ('volume', 'control', 'mixed'):
        stages['loss_' + film] = '{use: losses/tooth-mesh, ehl: %s}' % film
    return stages


def run(scene, order):
    stages = scene(order)
    wanted = [s for s in stages if s not in ('viscosity', 'density', 'flow')]
    with tempfile.TemporaryDirectory() as place:
        path = os.path.join(place, 'pair.yaml')
        with open(path, 'w') as out:
            out.write('format: 2\npipeline:\n')
            for name, stage in stages.items():
                out.write('  %s: %s\n' % (name, stage))
            out.write('outputs: [%s]\n' % ', '.join([s + '.*' for s in wanted] + ['gears.profile_roll', 'gears.profile_deviation']))
        words = [flankfilm, 'run', path, '--json', '--arrays', '--plugin-path', plugins]
        told = subprocess.run(words, capture_output=True, text=True, check=False)
    result = json.loads(told.stdout)
    if told.returncode not in (0, 1) or not result.get('outputs'):
        sys.exit('%s, order %d: %s%s' % (scene.__name__, order, told.stdout[:2000], told.stderr[:2000]))
    used = {s['model'] for s in result['stages']}
    return {'of': result['outputs'], 'used': used, 'exit': told.returncode}


# What takes the place of the rule that dimensions give, by patterns of stage and output: the first that fits.
EXCEPT = {
    'duty.torque': 'times', 'duty.speed': 'over', 'gears.pinion': 'pinion', '*.*radius_1': 'other', '*.*radius_2': 'other',
    '*.speed_1': 'other', '*.speed_2': 'other', '*.rq_1': 'other', '*.rq_2': 'other', 'gears.pitch_deviation_?': 'other',
    'micropitting.friction_coefficient': 'same', 'scuffing.friction_coefficient': 'same', '*.sliding_speed': 'minus',
    '*.slide_roll_ratio': 'minus', '*.friction_coefficient': 'minus', '*.traction': 'minus', '*.roll_*': 'place',
    '*.engagement_roll': 'place', '*_at': 'place', '*.time': 'time', '*.phase': 'skip', '*.breakpoints': 'phases',
    '*.worst_teeth': 'teeth', '*.worst_mesh_cycle': 'cycles', '*.hunting_hertz_pressure': 'cycles',
    '*.hunting_transmission_error': 'hunting', 'duty.fluctuation_[cos]*': 'skip',
}
ENDS = {'roll_sap': 'roll_tip', 'roll_lpstc': 'roll_hpstc', 'roll_tip': 'roll_sap', 'roll_hpstc': 'roll_lpstc'}

# What may change, within that share, by scene and pattern, and why. None: not compared number by number.
REMEMBERS = 'a film remembers where it comes from: where the load rises in one order it falls in the other'
MAY = {
    'mirrored': {
        'inlet.h_min_lowest_at': (0.05, REMEMBERS), 'inlet.*_lowest*': (0.1, REMEMBERS),
        **{'inlet.' + name: (None, REMEMBERS) for name in ('h_min', 'h_central', 'h_min_error', 'lambda_ratio', 'friction_coefficient',
                                                            'traction', 'power_loss', 'sliding_loss')},
    },
    'indexed': {
        'mesh.hunting*': (0, ''), 'mesh.worst*': (0, ''),
        'mesh.*': (None, 'mesh cycle 0 begins where its pair comes in, which is where the same pair leaves in the other order'),
    },
    'motions': {
        'coupled.multipliers': (None, 'the pair of multipliers of a mode may turn'),
        'coupled.*': (0.01, 'where pairs come and go is told by the turning of gear 1, whose mesh with gear 2 moves by the half gap that opens'),
    },
    'rattle': {},
    'films': {
        'volume.*': (None, REMEMBERS), 'control.*': (None, REMEMBERS), 'mixed.*': (None, REMEMBERS), 'loss_*.squeeze_loss_mean': (None, REMEMBERS),
        'loss_mixed.rolling_loss_mean': (0.3, REMEMBERS), 'loss_*.*_at': (0.1, REMEMBERS), 'loss_*.flash_temperature_max': (0.15, REMEMBERS),
        'loss_*_mean': (0.1, REMEMBERS), 'loss_*.contact_temperature_max': (0.01, REMEMBERS), 'loss_*.*': (None, REMEMBERS),
        'rough.height_?': (None, 'each flank keeps its own record of random heights, and takes the amplitude of the other'),
    },
}
HEADLINES = {'*.h_min_lowest': 0.25, '*.p_max_highest': 0.15, '*.alpha_star': 1e-9}  # of the films in time
ROUGHLY = 2e-4  # of the largest value, beyond the neighbours: sampling, and the twelve digits of a number
INSTANTS = 3e-3  # likewise of a history, whose instants differ at the ramps of its load
# outputs of a chain whose highest or lowest value is that of an instant, which another instant misses
# the tangent of k has corners between its points: harmonics 5.3e-4 off on 400 of them, 2.2e-4 on 1600
SAMPLED = {'*.stiffness_harmonics': 5e-4, '*.natural_frequency': 2e-5, '*_lowest*': 2e-3, '*_highest': 2e-3, '*_max': 2e-3, '*_mean': 5e-4, '*peak_to_peak': 1e-4, 'micropitting.own_*': 2e-3, '*loss_spread': 1}


def match(path, table):
    return next((table[p] for p in table if fnmatch.fnmatchcase(path, p)), None)


class Pair:
    """The results of both runs of a scene."""

    def __init__(self, scene):
        self.scene = scene.__name__
        self.runs = [run(scene, order) for order in (0, 1)]
        self.of = [r['of'] for r in self.runs]
        self.used = self.runs[0]['used']
        self.base = [self.of[order]['gears.base_radius']['data'][0] for order in (0, 1)]
        self.length = self.base[0] * self.value('gears.roll_sap', 0) + self.base[1] * self.value('gears.roll_tip', 1)
        self.ratio = self.value('gears.contact_ratio', 0)
        self.seen = 0
        self.bad = []

    def value(self, path, order):
        out = self.of[order][path]
        return out['value'] if 'value' in out else out['data']

    def place(self, roll, order):
        """Along the line of action, from the tangent point of the gear with index 0."""
        s = self.base[order] * roll
        return s if order == 0 else self.length - s

    def along(self, path, order):
        """Where the values of a series stand, or None: they are no series over a place or a phase."""
        stage = path.split('.')[0]
        out = self.of[order][path]
        dims = out['dims'][-1]
        rows = self.of[order]
        for name in ('engagement_roll', 'roll_angle'):
            for at in (stage, 'gears') if dims == 'station' else (stage,):
                other = rows.get('%s.%s' % (at, name))
                if other and other['dims'] == [dims] and other['shape'] == out['shape'][-1:]:
                    if self.alike(stage):  # from SAP on
                        return [(x - other['data'][0]) * self.base[order] for x in other['data']], None
                    return [self.place(x, order) for x in other['data']], None
        phase = rows.get('%s.phase' % stage)
        if phase and phase['shape'] == out['shape'][-1:] and dims in ('phase', 'cycle', 'hunting'):
            turned = order == 1 and not self.alike(stage)
            return [self.ratio - x if turned else x for x in phase['data']], 1
        return None

    def alike(self, stage):
        return self.scene in ('motions', 'rattle') and stage not in ('gears', 'duty')

    def say(self, path, off, within, what=''):
        self.seen += 1
        if not off <= within:
            self.bad.append('%s %s: off by %.3g of %.3g %s' % (self.scene, path, off, within, what))


def off(a, b):
    a, b = (x if isinstance(x, list) else [x] for x in (a, b))
    if len(a) != len(b):
        return math.inf
    most = max(map(abs, a), default=0)
    return max((abs(x - y) for x, y in zip(a, b)), default=0) / (most or 1)


def beyond(xa, a, xb, b, period, most=max):
    """How far the values a leave the band of the two values of b on either side, over the largest."""
    if period:
        xa = [x % period for x in xa]
        xb, b = zip(*sorted((x % period + turn, k, y) for turn in (-1, 0, 1) for k, (x, y) in enumerate(zip(xb, b)))), None
        xb, _, b = xb
    else:
        xb, b = zip(*sorted(zip(xb, b)))
    out = []
    for x, y in zip(xa, a):
        first, last = bisect.bisect_left(xb, x - 1e-9), bisect.bisect_right(xb, x + 1e-9)
        near = b[max(0, first - 2):last + 2]
        out.append(max(0, min(near) - y, y - max(near)))
    return most(out) / (max(map(abs, a)) or 1)


def compare(pair, path):
    stage, name = path.split('.')
    rule, may = match(path, EXCEPT), match(path, MAY[pair.scene])
    headline = match(path, HEADLINES) if pair.scene == 'films' else None
    if headline:
        may = (headline, REMEMBERS)
    if may and may[0] is None:
        pair.seen += 1
        return
    if name not in ENDS and rule == 'other':
        other = '%s.%s%d' % (stage, name[:-1], 3 - int(name[-1]))
    else:
        other = '%s.%s' % (stage, ENDS.get(name, name))
    if other not in pair.of[1]:
        return pair.say(path, math.inf, 0, 'is not there in the other order')
    a, b = pair.value(path, 0), pair.value(other, 1)
    if may and may[0]:
        within = may[0]
    else:
        within = match(path, SAMPLED) if pair.scene == 'mirrored' else None
        chain = stage.split('_')[0] in ('pair', 'film', 'inlet', 'loss')
        within = within or (1e-6 if 'value' in pair.of[0][path] else INSTANTS if chain else ROUGHLY)
    dims = pair.of[0][path].get('dims', [])
    z = pair.value('gears.teeth', 0)
    if rule in ('skip', 'time'):
        return pair.say(path, 0 if rule == 'skip' else off(a[-1], b[-1]) if dims else off(a, b), 1e-6)
    if rule == 'minus' and not (dims and pair.along(path, 0)):
        b = [-y for y in b] if dims else -b
    if rule == 'pinion':
        return pair.say(path, off(a, 3 - b), 0)
    if rule == 'times':
        return pair.say(path, off(a, b * z[0] / z[1]), 1e-9)
    if rule == 'over':
        return pair.say(path, off(a, b * z[1] / z[0]), 1e-9)
    if rule == 'place' and not dims:
        # a highest value may stand at another instant, or at one of two ends
        return pair.say(path, abs(pair.place(a, 0) - pair.place(b, 1)) / pair.length, within if name.startswith('roll') else max(within, 0.02))
    if rule == 'phases':
        turned = sorted((pair.ratio - x + 1e-9) % 1 for x in b) if not pair.alike(stage) else sorted((x + 1e-9) % 1 for x in b)
        return pair.say(path, off(sorted((x + 1e-9) % 1 for x in a), turned), 1e-6)
    if rule == 'cycles':
        if not dims:
            n = len(pair.value('mesh.hunting_hertz_pressure', 0))
            return pair.say(path, off(a, -b % n), 0)
        return pair.say(path, off(a, [b[-k] for k in range(len(b))]), 2e-3)  # of instants
    if rule == 'teeth':
        return pair.say(path, max(abs(a[g] - 1 - (1 - b[1 - g]) % z[g]) for g in (0, 1)), 0)
    if pair.scene == 'indexed' and name.startswith('pitch_deviation'):
        b = [b[-k] for k in range(len(b))]
    if rule == 'hunting' and pair.scene == 'indexed':
        n = pair.value('mesh.hunting_period', 0)
        at = [n * k / len(a) for k in range(len(a))]  # 32 steps a mesh cycle miss corners: on the mean
        return pair.say(path, beyond(at, a, [pair.ratio - x for x in at], b, n, statistics.fmean), 2e-3)
    if dims and dims[0] == 'gear':
        half = len(b) // 2
        return pair.say(path, off(a, b[half:] + b[:half]), within)
    if stage in ('elastic', 'energy') and name.startswith('back_'):  # the curves of the other flank: T both-flanks exchanges them
        return pair.say(path, 0, 0)
    if not dims:
        return pair.say(path, off(a, b), within)
    if rule == 'place' and not pair.alike(stage):
        xa, xb = sorted(pair.place(x, 0) for x in a), sorted(pair.place(x, 1) for x in b)
        return pair.say(path, max(abs(xa[0] - xb[0]), abs(xa[-1] - xb[-1])) / pair.length, 1e-6)
    if rule == 'place':
        return pair.say(path, 0, 0)
    at = [pair.along(path, 0), pair.along(other, 1)]
    if all(at):
        b = [-y for y in b] if rule == 'minus' else b
        pair.say(path, beyond(at[0][0], a, at[1][0], b, at[0][1]), within)
        return pair.say(path, beyond(at[1][0], b, at[0][0], a, at[0][1]), within)
    if len(dims) == 1 and dims[0] in ('harmonic', 'level', 'landing', 'method', 'engagement', 'x', 'point', 'fold', 'doubling', 'hunting', 'tooth_1', 'tooth_2', 'arc'):
        return pair.say(path, off(a, b), 0.03 if dims[0] == 'x' else max(within, ROUGHLY))
    if pair.alike(stage):
        return pair.say(path, off(a, b), within)
    return pair.say(path, math.inf, 0, 'has no rule: dimensions %s' % dims)


def main():
    told = json.loads(subprocess.run([flankfilm, 'models', '--json', '--plugin-path', plugins], capture_output=True, text=True, check=True).stdout)
    kinds = {m['id'].split('/')[0] for m in told['models']} - {'conformance', 'executor', 'writer'}
    wrong, used, seen = [], set(), 0
    for scene in (mirrored, indexed, motions, rattle, films):
        pair = Pair(scene)
        for path in pair.of[0]:
            compare(pair, path)
        used |= pair.used
        seen += pair.seen
        print('%s: %d outputs, %d checks, %d fail' % (scene.__name__, len(pair.of[0]), pair.seen, len(pair.bad)))
        wrong += pair.bad
    wrong += ['no scene has a stage of the kind %s' % k for k in sorted(kinds - {m.split('/')[0] for m in used})]
    print('\n'.join(wrong))
    sys.exit(1 if wrong or not seen else 0)


if __name__ == '__main__':
    main()
