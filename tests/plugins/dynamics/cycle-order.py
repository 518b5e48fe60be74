#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""cycle-order.py FLANKFILM SOURCE

A motion that repeats after two mesh cycles begins with the same one of them, however it was found: by shooting, by time integration, and
with half the points of the mesh, which exchanged them.
"""
import json
import subprocess
import sys


def cycles(program, source, *sets):
    """Largest transmission error of each mesh cycle, m."""
    words = [word for one in ('outputs=[motion.period, motion.dte]', *sets) for word in ('--set', one)]
    done = subprocess.run([program, 'run', f'{source}/configs/light-load.yaml', '--json', '--arrays', *words], stdout=subprocess.PIPE,
                          text=True, check=True)
    outputs = json.loads(done.stdout)['outputs']
    count, dte = round(outputs['motion.period']['value']), outputs['motion.dte']['data']
    length = len(dte) // count
    return [max(dte[k * length:(k + 1) * length]) for k in range(count)]


def main():
    program, source = sys.argv[1:3]
    first = cycles(program, source)
    print(first)
    good = len(first) == 2 and first[0] > 1.02 * first[1]
    for sets in ('mesh.points=50', 'motion.use=dynamics/time-integration', 'motion.branch=upper'):
        other = cycles(program, source, sets)
        same = len(other) == 2 and all(abs(a / b - 1) < 5e-3 for a, b in zip(first, other))
        print(sets, other, 'as expected' if same else 'DIFFERS')
        good = good and same
    sys.exit(not good)


main()
