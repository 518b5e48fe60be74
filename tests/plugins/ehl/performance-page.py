#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the counts for the dynamic film in docs/performance.md with those of a run.

performance-page.py PROGRAM SOURCE

Counts of Newton steps and convolutions depend on the machine only by the rounding of its mathematical functions, which may change
some steps: they must agree to 3 %. Otherwise, the page is out of date.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

WITHIN = 0.03


def main():
    program, source = sys.argv[1:]
    page = (pathlib.Path(source) / "docs/performance.md").read_text(encoding="utf-8")
    row = re.search(r"^\| 512 \| 1000 \| ([\d.]+) \| ([\d.]+) \| [\d.]+ \|$", page, re.M)
    with tempfile.TemporaryDirectory() as results:
        run = subprocess.run(
            [program, "run", source + "/configs/li-kahraman-2011.yaml", "--json", "--set", "mesh.use=stiffness/iso-6336",
             "--set", "film.cells=512", "--set", "outputs=[film.h_min,film.newton_steps,film.convolutions]", "-o", results],
            capture_output=True, text=True, check=True)
    outputs = json.loads(run.stdout)["outputs"]
    failed = 0
    for place, name in ((1, "newton_steps"), (2, "convolutions")):
        told, found = float(row.group(place)), outputs["film." + name]["value"] / 1000
        good = abs(told / found - 1) <= WITHIN
        failed += not good
        print("%s %s by step: the page says %g, the run %g" % ("ok  " if good else "FAIL", name, told, found))
    return failed


if __name__ == "__main__":
    sys.exit(main())
