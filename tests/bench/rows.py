# SPDX-License-Identifier: GPL-3.0-or-later
"""The time between a row of standard input and its answer: rows.py ROWS, with FLANKFILM set."""
import os
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../configs/python"))
import flankfilm

STUDY = """
format: 2
pipeline:
  oil: {use: lubricant/grade, grade: ISO VG 220, base: mineral, temperature: 80 degC}
outputs: [oil.eta0]
"""

with tempfile.TemporaryDirectory() as lab:
    os.chdir(lab)
    with open("oil.yaml", "w") as file:
        file.write(STUDY)
    count = int(sys.argv[1])
    with flankfilm.Rows("oil.yaml", ["oil.temperature [degC]"], "results") as rows:
        rows.ask(39)
        start = time.monotonic()
        for i in range(count):
            rows.ask(40 + i / 100)
        print(f"{(time.monotonic() - start) / count * 1e3:.3f} ms a row")
