#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Each setting that the coarser runs for error bars change must allow two levels below its preset: tunables.py FLANKFILM

If a setting does not, the third level, and with it the order of convergence, is missing for all results of its model."""
import json
import subprocess
import sys

LEVELS = 2
BAD = []


def ask(*words):
    return json.loads(subprocess.run([sys.argv[1], 'models', *words, '--json'], check=True, capture_output=True, text=True).stdout)


def coarse(parameter):
    """Returns the preset some levels coarser: half a count per level, or four times a tolerance."""
    preset = float(parameter['preset'].split()[0])
    return preset / 2 ** LEVELS if parameter['type'] == 'whole number' else preset * 4 ** LEVELS


seen = 0
for model in ask()['models']:
    for parameter in ask(model['id'])['parameters']:
        if parameter['tunable'] and parameter['preset'] not in (None, 'auto'):
            seen += 1
            least, most = parameter['limits']
            if not least <= coarse(parameter) <= most:
                BAD.append(f"{model['id']}: {parameter['name']}: {parameter['preset']}, {LEVELS} levels coarser, is outside {least} to {most}")
print(f'{seen} settings')
print('\n'.join(BAD))
sys.exit(bool(BAD) or seen < 20)
