# SPDX-License-Identifier: GPL-3.0-or-later
"""Scripts that choose the cases of a study: an optimiser, and a sample made in Python. Needs scipy.

    python3 optimise.py [DIRECTORY]       # beside the folder flankfilm

The directory keeps finished cases, so a second or interrupted call continues.
"""

# %% The tip relief with the least loaded transmission error: each case depends on the one before
import csv
import os
import sys

import numpy as np
from scipy import optimize, stats

import flankfilm

here = os.path.dirname(os.path.abspath(__file__))
pair = os.path.join(here, "..", "profile-relief.yaml")
results = sys.argv[1] if len(sys.argv) > 1 else "results"

sets = {"motion.use": "dynamics/quasi-static", "outputs": ["motion.dte_rms"]}
with flankfilm.Rows(pair, ["gears.tip_relief [um]"], os.path.join(results, "relief"), sets) as rows:
    def error(relief):
        answer = rows.ask(relief)
        if answer["status"] != "ok":
            raise RuntimeError(answer["reason"])
        return answer["outputs"]["motion.dte_rms"]

    best = optimize.minimize_scalar(error, bounds=(0, 40), method="bounded",
                                    options={"xatol": 0.2})
print(f"{best.x:.1f} um of relief: {best.fun * 1e6:.3f} um rms, found in {best.nfev} cases")

# %% What the film depends on: a Latin hypercube as a table of cases
inputs = {"duty.torque [N m]": (200, 300), "duty.mesh_frequency [Hz]": (1000, 1500),
          "duty.oil_temperature [degC]": (90, 110)}
least, most = zip(*inputs.values())
points = stats.qmc.scale(stats.qmc.LatinHypercube(len(inputs), seed=1).random(40), least, most)
table = os.path.join(results, "sample.csv")
with open(table, "w", newline="") as file:
    csv.writer(file).writerows([inputs, *points])

sample = flankfilm.run(pair, {"study": {"cases": os.path.abspath(table)},
                              "film.use": "ehl/film-formula",
                              "motion.use": "dynamics/quasi-static",
                              "outputs": ["film.h_min_lowest"]}, os.path.join(results, "sample"))
film = np.ravel(sample["film.h_min_lowest"].data)
for name, column in zip(inputs, points.T):
    rank = stats.spearmanr(column, film).statistic
    print(f"{name}: rank correlation with the lowest film {rank:+.2f}")
