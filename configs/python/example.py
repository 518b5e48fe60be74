# SPDX-License-Identifier: GPL-3.0-or-later
"""An example of flankfilm in Python, in cells; editors that support "# %%" run one cell at a time.

    python3 example.py        # beside the folder flankfilm
"""

# %% One case, and the same with more torque
import os

import numpy as np

import flankfilm

here = os.path.dirname(os.path.abspath(__file__))
pair = os.path.join(here, "..", "li-kahraman-2011.yaml")
sets = {"film.use": "ehl/film-formula",  # fast; leave it out for the full film
        "outputs": ["film.h_min", "film.h_min_lowest", "film.roll_angle", "motion.dte_rms"]}

case = flankfilm.run(pair, sets)
heavy = flankfilm.run(pair, {**sets, "duty.torque": "400 N m"})
for name, r in {"250 N m": case, "400 N m": heavy}.items():
    film = r["film.h_min"]
    print(f"{name}: least film {film.data.min() * 1e6:.3f} um, "
          f"rms of the transmission error {float(r['motion.dte_rms']) * 1e6:.2f} um")

# %% An error: the program's message
try:
    flankfilm.run(pair, {"duty.torqu": "3 N m"})
except flankfilm.Error as error:
    print(error)

# %% A loop in Python: film over torque. A study does the same, in parallel, and can be resumed.
torque = np.array([50, 100, 200, 400])
least = [float(flankfilm.run(pair, {**sets, "duty.torque": f"{t} N m"})["film.h_min_lowest"])
         for t in torque]
slope = np.polyfit(np.log(torque), np.log(least), 1)[0]
print(f"the least film varies with the torque to the power of {slope:.2f}")

# %% Figures, if matplotlib is installed
try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    print("matplotlib is not installed: no figure")
else:
    figure, axes = plt.subplots()
    for name, r in {"250 N m": case, "400 N m": heavy}.items():
        film, along = r["film.h_min"], r.against("film.h_min")  # film.roll_angle
        axes.plot(np.degrees(along.data), film.data * 1e6, label=name)
    axes.set_xlabel("roll angle [deg]")
    axes.set_ylabel("least film [um]")
    axes.legend()
    figure.savefig("film.svg")
    print("film.svg")
