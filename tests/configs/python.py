# SPDX-License-Identifier: GPL-3.0-or-later
"""configs/python/flankfilm.py against what the program prints and writes; its example runs.

python.py FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT
"""
import csv
import json
import os
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    print("needs NumPy")
    sys.exit(77)

program, plugins, source = map(os.path.realpath, sys.argv[1:4])
sys.dont_write_bytecode = True
os.environ.update(FLANKFILM=program, FLANKFILM_PLUGIN_PATH=plugins, PYTHONDONTWRITEBYTECODE="1")
sys.path.insert(0, os.path.join(source, "configs", "python"))
import flankfilm  # noqa: E402

failed = 0


def check(what, holds):
    global failed
    failed += not holds
    print("ok  " if holds else "FAIL", what)


def raised(call, *parts, code=2):
    """Whether the call raises an Error that has all of the parts."""
    try:
        call()
    except flankfilm.Error as error:
        text = str(error)
        if error.code == code and all(part in text for part in parts):
            return True
        print(error.code, text)
    return False


case = """format: 1
include: [{0}/configs/li-kahraman-2011.yaml]
pipeline: {{mesh: {{use: stiffness/iso-6336}}, film: {{use: ehl/film-formula}}}}
outputs: [film.h_min, film.h_min_lowest, film.roll_angle, motion.dte_rms, gears.teeth]
""".format(source)
study = case + """study:
  sweep:
    duty.torque: [100 N m, -1 N m, 300 N m]
    oil.use: [viscosity/barus, viscosity/roelands]
"""
follow = case + """study:
  sweep: {duty.mesh_frequency: {from: 2000 Hz, to: 3000 Hz, points: 3, follow: both}}
  zip: {gears.face_width: [20 mm, 30 mm], oil.use: [viscosity/barus, viscosity/roelands]}
"""


def plain(*words):
    done = subprocess.run([program, *words], capture_output=True, text=True, check=False)
    return json.loads(done.stdout)


def test_run():
    r = flankfilm.run("case.yaml", {"duty.torque": "300 N m"}, directory="here")
    told = plain("run", "case.yaml", "--set", "duty.torque=300 N m", "--json")["outputs"]
    film = r["film.h_min"]
    check("a series", film.unit == "m" and film.dims == ("t",) and film.doc == told["film.h_min"]["doc"])
    check("its numbers", np.array_equal(film.data, told["film.h_min"]["data"]))
    check("a scalar", float(r["motion.dte_rms"]) == told["motion.dte_rms"]["value"])
    check("numpy takes it", np.max(film) == film.data.max() and len(film) == film.data.size)
    check("what it is plotted against", r.against("film.h_min") is r["film.roll_angle"])
    check("what was asked", r.asked == list(told) and set(told) <= set(r))
    check("checks of the numbers", r.quality["gears"]["pitch_error"]["verdict"] == "good")
    again = flankfilm.open("here")
    check("the directory holds the same", all(np.array_equal(again[k].data, r[k].data) for k in told))
    other = flankfilm.run("case.yaml", {"duty.torque": "300 N m", "gears.teeth": [49, 51],
                                        "outputs": ["gears.teeth"]})
    check("lists are handed over", list(other["gears.teeth"]) == [49, 51] and other.path is None)


def test_errors():
    check("a wrong word", raised(lambda: flankfilm.run("case.yaml", {"duty.torqu": "3 N m"}),
                                 'unknown key "torqu"; did you mean "torque"?'))
    check("two at once", raised(lambda: flankfilm.check("case.yaml", {"duty.torque": 3, "oil.use": "viscosity/no"}),
                                "duty.torque", "viscosity/no", code=3))
    check("no file", raised(lambda: flankfilm.run("none.yaml"), "none.yaml"))
    check("no results", raised(lambda: flankfilm.open("."), "no results of flankfilm", code=None))
    check("a file that is right", flankfilm.check("case.yaml") is None)
    try:
        flankfilm.open("here")["film.h_mi"]
        check("a name that is not there", False)
    except KeyError as error:
        check("a name that is not there", "film.h_min" in str(error))
    os.environ["FLANKFILM"] = "/nowhere/flankfilm"
    check("no program", raised(lambda: flankfilm.run("case.yaml"), "/nowhere/flankfilm", code=None))
    os.environ["FLANKFILM"] = program


def test_study():
    s = flankfilm.run("study.yaml", directory="study", jobs=2)
    check("its shape", s.shape == (3, 2) and s.dims == ["torque", "oil.use"])
    check("what is varied", list(s.axes["torque"]) == [100, -1, 300] and s.axes["torque"].unit == "N m" and
          list(s.axes["oil.use"]) == ["viscosity/barus", "viscosity/roelands"])
    check("failed cases", list(s.status[1]) == ["invalid"] * 2 and "too small" in s.reason[1, 0])
    rms, film = s["motion.dte_rms"], s["film.h_min"]
    check("a scalar over the study", rms.dims == ("torque", "oil.use") and np.isnan(rms[1]).all())
    check("a series over the study", film.dims == ("torque", "oil.use", "t") and film.data.shape[:2] == (3, 2))
    one = flankfilm.run("case.yaml", {"duty.torque": "300 N m", "oil.use": "viscosity/roelands"})
    check("a case of it", np.allclose(film[2, 1], one["film.h_min"].data, rtol=1e-11, atol=0))
    check("and its scalars", np.isclose(float(rms[2, 1]), float(one["motion.dte_rms"]), rtol=1e-11))
    with open("study/table.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    check("the table", s.table["motion.dte_rms [m]"] == [row["motion.dte_rms [m]"] for row in rows])
    check("all names", set(s) >= {"film.h_min", "motion.dte_rms"})
    f = flankfilm.run("follow.yaml", directory="follow")
    check("chains and what varies together", f.dims == ["follow", "mesh_frequency", "point"] and
          list(f.axes["gears.face_width"]) == [0.02, 0.03] and f["motion.dte_rms"].data.shape == (2, 3, 2))
    os.rename("follow/table.csv", "follow/table")
    check("a study without its table", raised(lambda: flankfilm.open("follow"), "table.csv", code=None))


def test_fit():
    data = os.path.join(source, "configs", "measured", "pao-b.csv")
    found = flankfilm.fit("viscosity", data, laws=["roelands"], at=["80 degC"])["laws"][0]
    z = next(p for p in found["parameters"] if p["name"] == "z")
    check("a fit covers the law of the data", z["interval"][0] < 0.4857 < z["interval"][1])
    check("and refuses what lies outside", raised(lambda: flankfilm.fit("viscosity", data, at=["9 GPa"]), "outside"))


def test_example():
    done = subprocess.run([sys.executable, os.path.join(source, "configs", "python", "example.py")],
                          capture_output=True, text=True, check=False)
    check("the example runs", done.returncode == 0 and "to the power of -0.1" in done.stdout)
    if done.returncode:
        print(done.stdout, done.stderr)


with tempfile.TemporaryDirectory() as lab:
    os.chdir(lab)
    for name, text in {"case": case, "study": study, "follow": follow}.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
    test_run()
    test_errors()
    test_study()
    test_fit()
    test_example()
    os.chdir("/")
print("all well" if not failed else f"{failed} failed")
sys.exit(failed > 0)
