# SPDX-License-Identifier: GPL-3.0-or-later
"""An example of the engine in this process, in cells: laws, one contact, a whole case.

    python3 laws.py           # beside the folder flankfilm
"""

# %% Two laws of one oil, as functions
import os

import numpy as np

import flankfilm

here = os.path.dirname(os.path.abspath(__file__))
engine = flankfilm.Engine()

oil = {"eta0": "10.4 mPa s"}
laws = {name: engine.model(f"viscosity/{name}", {**oil, "alpha": "18 1/GPa"})
        for name in ("barus", "roelands")}
pressure = np.linspace(0, 1e9, 5)
for name, model in laws.items():
    eta = np.exp(model.law()(pressure))
    print(f"{name}: eta at 0 to 1 GPa, Pa s:", " ".join(f"{x:.3g}" for x in eta))

# %% One steady contact of two discs, with each of the laws
contact = engine.model("contact/constant", {
    "load_per_width": "200 N/mm", "radius_1": "20 mm", "radius_2": "20 mm",
    "speed_1": "4 m/s", "speed_2": "3 m/s"})
density = engine.model("density/dowson-higginson", {"rho0": "870 kg/m3"})
film = engine.model("ehl/film-formula", wires={"contact": contact, "density": density})
for name, model in laws.items():
    film.use({"viscosity": model})
    print(f"{name}: central film {film.run('h_central')['h_central'].data[0] * 1e6:.3f} um")

# %% A case from a file; the arrays are in the engine's own memory
pair = os.path.join(here, "..", "li-kahraman-2011.yaml")
run = engine.run(pair, {"film.cells": 96, "film.steps": 100, "outputs": ["film.pressure", "film.h_min"]})
p = run["film.pressure"]
print(f"pressures {p.data.shape} over {p.dims}, up to {p.data.max() / 1e9:.2f} GPa")
print("doubtful:", [f"{stage}.{line}" for stage, lines in run.quality.items()
                    for line, q in lines.items() if q["verdict"] == "doubtful"])
