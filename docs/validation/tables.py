# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the series of results as tables beside them, for awk.

   tables.py DIR...

<stage>.csv has those along the first dimension of the stage's kind, <stage>-<dimension>.csv those along another, and
<stage>-scalars.csv its scalars.
"""
import json
import math
import os
import struct
import sys

FIRST = {"gear": "station", "stiffness": "phase", "dynamics": "cycle", "contact": "t", "ehl": "t", "surface": "arc"}


def read(path, count):
    """The numbers of a .npy file, the last `count` of its doubles."""
    with open(path, "rb") as file:
        return struct.unpack(f"<{count}d", file.read()[-8 * count :] if count else b"")


def write(path, head, rows):
    with open(path, "w", encoding="utf-8") as file:
        file.write(",".join(head) + "\n")
        file.writelines(",".join(x if isinstance(x, str) else f"{x:.10g}" for x in row) + "\n" for row in rows)


def convert(folder):
    with open(os.path.join(folder, "result.json"), encoding="utf-8") as file:
        told = json.load(file)
    first = {s["stage"]: FIRST.get(s["model"].split("/")[0]) for s in told["stages"]}
    tables, scalars = {}, {}
    for name, entry in {**told["outputs"], **told["computed"]}.items():
        stage, output = name.split(".")
        if "value" in entry:
            scalars.setdefault(stage, []).append((output, math.nan if entry["value"] is None else entry["value"], entry["unit"]))
        elif len(entry["shape"]) == 1:
            dim = entry["dims"][0]
            table = f"{stage}.csv" if dim == first[stage] else f"{stage}-{dim}.csv"
            numbers = read(os.path.join(folder, entry["file"]), entry["shape"][0])
            tables.setdefault(table, []).append((f"{output} [{entry['unit']}]", numbers))
    for name, columns in tables.items():
        write(os.path.join(folder, name), [head for head, _ in columns], zip(*(numbers for _, numbers in columns)))
    for stage, rows in scalars.items():
        write(os.path.join(folder, stage + "-scalars.csv"), ["name", "value", "unit"], rows)


for directory in sys.argv[1:]:
    convert(directory)
