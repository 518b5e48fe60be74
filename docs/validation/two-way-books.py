# SPDX-License-Identifier: GPL-3.0-or-later
"""What the motion gives the squeeze of its films at point III and what they dissipate, term by term: a table for two-way.md.

    python3 docs/validation/two-way-books.py FLANKFILM CONFIG

The film's squeeze loss is the work of its pressure on the gap h = h00 + x^2/(2 R) + v - v(X), less what is stored:
-int W dh00 - int M d(1/R) - [E] - [C], with M = int p x^2/2 dx, the elastic energy E = 1/2 int p v dx and that of the
compressed oil, C = int rho h int_0^p p' drho/rho^2 dx. `separation` takes Hertz' contact under the same force in place of the first three, for
which W d(approach) = dE + M d(1/R) holds too. What is left of both differs from 0, since a film begins loaded."""
import json
import math
import subprocess
import sys
import tempfile

import numpy as np

FREQUENCY = 2375.0
DENSITY = 0.6e-9, 1.7e-9  # Dowson & Higginson's a and b of the oil's card
SERIES = 'film.time', 'film.separation', 'film.squeeze_loss', 'tooth.time', 'tooth.load_per_width', 'tooth.gap', 'tooth.equivalent_radius'
SCALARS = 'tooth.reduced_modulus', 'gears.face_width', 'motion.squeeze_loss', 'motion.film_power', 'loss.power_loss_mean', 'loss.squeeze_loss_mean'


def solve(program, config, cells):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, 'run', config, '--set', f'duty.mesh_frequency={FREQUENCY} Hz', '--set', 'motion.branch=upper',
                        '--set', 'motion.squeeze=series', '--set', 'motion.squeeze_rolling=true', '--set', 'film.inlet=16', '--set', 'film.outlet=16',
                        '--set', f'film.cells={cells}', '--set', 'outputs=[' + ','.join(SERIES + SCALARS + ('film.x', 'film.film', 'film.pressure')) + ']',
                        '-o', folder], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(folder + '/result.json') as file:
            outputs = json.load(file)['outputs']

        def array(name):
            return np.load(f"{folder}/{outputs[name]['file']}")
        found = {name: array(name) for name in SERIES + ('film.x',)}
        found.update({name: outputs[name]['value'] for name in SCALARS})
        return found, array('film.pressure'), array('film.film')


def elastic(p, dx, modulus):
    """1/2 int p v dx; the kernel is 0 at half the domain's length."""
    n = len(p)
    edge = (np.arange(n + 1) - 0.5) * dx
    whole = edge * np.log(np.abs(edge)) - edge
    kernel = -4 / (math.pi * modulus) * (np.diff(whole) - dx * math.log((n - 1) * dx / 2))
    return 0.5 * dx * p @ np.convolve(p, np.concatenate([kernel[:0:-1], kernel]))[n - 1:2 * n - 1]


def hertz(load, radius, modulus, half):
    """Its elastic energy, and int p x^2/2 dx."""
    square = 8 * load * radius / (math.pi * modulus)
    middle = 4 * load / (math.pi * modulus) * (np.log(2 * half / np.sqrt(square)) + 0.5)
    return 0.5 * load * (middle - square / (8 * radius)), load * square / 8


def compressed(p, h, dx):
    a, b = DENSITY
    grid = np.linspace(0, 3e9, 30001)
    rho, slope = 1 + a * grid / (1 + b * grid), a / (1 + b * grid)**2
    rate = grid * slope / rho**2
    energy = np.concatenate([[0], np.cumsum((rate[1:] + rate[:-1]) / 2 * np.diff(grid))])
    return dx * np.sum(np.interp(p, grid, rho) * h * np.interp(p, grid, energy))


def work(force, way):
    return np.sum((force[1:] + force[:-1]) / 2 * np.diff(way))


def terms(program, config, cells):
    run, p, h = solve(program, config, cells)
    time, x, modulus = run['film.time'], run['film.x'], run['tooth.reduced_modulus']
    load, gap, radius = (np.interp(time, run['tooth.time'], run['tooth.' + name]) for name in ('load_per_width', 'gap', 'equivalent_radius'))
    dx, power = x[1] - x[0], run['gears.face_width'] * FREQUENCY
    force, way = p.sum(1) * dx, gap + run['film.separation']
    energy, moment = hertz(force, radius, modulus, (x[-1] - x[0]) / 2)
    stored = [elastic(p[i], dx, modulus) - energy[i] for i in (0, -1)]
    oil = [compressed(p[i], h[i], dx) for i in (0, -1)]
    given = run['motion.squeeze_loss'] - run['motion.film_power']
    parts = [('input of the motion: its own sum minus the sum over the stations', given + power * work(load, way)),
             ('work of the oil force during contact loss: in the motion minus in the film', power * (work(force, way) - work(load, way))),
             ('elastic energy of a Hertzian contact minus that with which the film begins', power * (stored[1] - stored[0])),
             ('energy of the compressed oil with which the film begins', power * (oil[1] - oil[0])),
             ('work of the pressure as the flanks become flatter, minus that of Hertz\' pressure', power * work((p * x**2 / 2).sum(1) * dx - moment, 1 / radius))]
    whole = given - run['loss.squeeze_loss_mean']
    parts += [('the rest: cells and steps', whole - sum(value for _, value in parts)), ('sum', whole)]
    return [(name, value / run['loss.power_loss_mean']) for name, value in parts]


def main():
    program, config = sys.argv[1:]
    coarse, fine = (terms(program, config, cells) for cells in (1024, 2048))
    print('| contribution to (input - output)/loss | 1024 cells | 2048 cells |\n|---|---|---|')
    for (name, one), (_, other) in zip(coarse, fine):
        print(f'| {name} | {1e3 * one:.2f}e-3 | {1e3 * other:.2f}e-3 |')


main()
