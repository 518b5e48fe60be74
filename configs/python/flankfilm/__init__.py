# SPDX-License-Identifier: GPL-3.0-or-later
"""flankfilm from Python; needs numpy. Numbers are in SI.

The program, in a process of its own, runs any file: a case, a study, a file with choices.

    import flankfilm
    r = flankfilm.run("case.yaml", {"duty.torque": "300 N m"})
    r["film.h_min"].data, r["film.h_min"].unit, r["film.h_min"].dims
    s = flankfilm.open("results/speed-sweep")
    s["motion.dte_rms"].data, s.axes["mesh_frequency"].data

A script may make up the cases of a durable study one after the other.

    with flankfilm.Rows("case.yaml", ["duty.torque [N m]"], "results/least") as rows:
        rows.ask(300)["outputs"]["film.h_min_lowest"]

The engine, in this process, runs a case, a model or a law without any file in between.

    engine = flankfilm.Engine()
    film = engine.run("case.yaml", {"outputs": ["film.pressure"]})["film.pressure"].data
    barus = engine.model("viscosity/barus", {"eta0": "10 mPa s", "alpha": "20 1/GPa"})
    ln_eta = barus.law()(np.linspace(0, 1e9))

What goes wrong raises flankfilm.Error with the sentence of the program or the engine. The program is
found on the path, or where the variable FLANKFILM says; the engine's library beside the program, or
where FLANKFILM_LIBRARY says.
"""

from .arrays import Array, Error
from .engine import Engine, Model, Run
from .program import Result, Study, check, fit, open, run
from .rows import Rows

__all__ = ["Array", "Engine", "Error", "Model", "Result", "Rows", "Run", "Study", "check", "fit",
           "open", "run"]
