# SPDX-License-Identifier: GPL-3.0-or-later
"""flankfilm from Python; needs numpy. Numbers are in SI.

`run` starts the program in a separate process and runs any file: a case, a study, a file with `use: KIND/auto`.

    import flankfilm
    r = flankfilm.run("case.yaml", {"duty.torque": "300 N m"})
    r["film.h_min"].data, r["film.h_min"].unit, r["film.h_min"].dims
    s = flankfilm.open("results/speed-sweep")
    s["motion.dte_rms"].data, s.axes["mesh_frequency"].data

With `Rows`, a script chooses the cases of a study one after the other; finished cases are kept in the directory.

    with flankfilm.Rows("case.yaml", ["duty.torque [N m]"], "results/least") as rows:
        rows.ask(300)["outputs"]["film.h_min_lowest"]

`Engine` runs a case, a model or a law in this process, without result files.

    engine = flankfilm.Engine()
    film = engine.run("case.yaml", {"outputs": ["film.pressure"]})["film.pressure"].data
    barus = engine.model("viscosity/barus", {"eta0": "10 mPa s", "alpha": "20 1/GPa"})
    ln_eta = barus.law()(np.linspace(0, 1e9))

An error raises flankfilm.Error with the message of the program or the engine. The program is found on
the path or by the variable FLANKFILM, the engine's library beside the program or by FLANKFILM_LIBRARY.
"""

from .arrays import Array, Error
from .engine import Engine, Model, Run
from .program import Result, Study, check, fit, open, run
from .rows import Rows

__all__ = ["Array", "Engine", "Error", "Model", "Result", "Rows", "Run", "Study", "check", "fit",
           "open", "run"]
