# SPDX-License-Identifier: GPL-3.0-or-later
"""The package in configs/python against what the program prints and writes; its examples run.

python.py FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT
"""
import csv
import gc
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading

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


case = """format: 2
include: [{0}/configs/li-kahraman-2011.yaml]
pipeline: {{mesh: {{use: stiffness/iso-6336}}, film: {{use: ehl/film-formula}}}}
outputs: [film.h_min, film.h_min_lowest, film.roll_angle, motion.dte_rms, gears.teeth]
""".format(source)
study = case + """study:
  sweep:
    duty.torque: [100 N m, -2e12 N m, 300 N m]
    viscosity.use: [viscosity/barus, viscosity/roelands]
"""
follow = case + """study:
  sweep: {duty.mesh_frequency: {from: 2000 Hz, to: 3000 Hz, points: 3, follow: both}}
  zip: {gears.face_width: [20 mm, 30 mm], viscosity.use: [viscosity/barus, viscosity/roelands]}
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
    # numbers of the answer have twelve digits, those of the directory all
    same = [np.allclose(again[k].data, r[k].data, rtol=5e-12, atol=0) for k in told]
    check("the directory holds the same", all(same) and again["film.h_min"].data.shape == r["film.h_min"].data.shape)
    other = flankfilm.run("case.yaml", {"duty.torque": "300 N m", "gears.teeth": [49, 51],
                                        "outputs": ["gears.teeth"]})
    check("lists are handed over", list(other["gears.teeth"]) == [49, 51] and other.path is None)


def test_fields():
    """Fields come from files, which are mapped; numpy writes the same ones."""
    sets = {"film": "{use: ehl/finite-volume, cells: 128, steps: 100}", "outputs": ["film.film", "film.x"]}
    here, gone = flankfilm.run("case.yaml", sets, directory="fields"), flankfilm.run("case.yaml", sets)
    film = gone["film.film"]
    place = film.data.base.filename
    check("a field", film.dims == ("t", "x") and film.data.shape == (101, 129) and film.unit == "m")
    check("is mapped", isinstance(film.data.base, np.memmap) and os.path.exists(place))
    check("the same in a directory", film.data.tobytes() == here["film.film"].data.tobytes() and
          film.data.tobytes() == np.load("fields/film.film.npy").tobytes())
    film.data[0] = 1
    check("may be changed in memory alone", flankfilm.open("fields")["film.film"].data[0, 0] < 1e-3)
    del gone
    gc.collect()
    check("outlives its temporary file", not os.path.exists(place) and film.data[1].max() < 1e-3)

    def bad(what, *parts, array=None, data=None, pickled=False):
        if array is not None:
            np.save("fields/film.film.npy", array, allow_pickle=pickled)
        else:
            with open("fields/film.film.npy", "wb") as file:
                file.write(data)
        check(what, raised(lambda: flankfilm.open("fields")["film.film"], "film.film.npy cannot be read",
                           *parts, code=None))

    good = np.array(here["film.film"].data)
    with open("fields/film.film.npy", "rb") as file:
        whole = file.read()
    np.save("twin.npy", good)
    with open("twin.npy", "rb") as file:
        check("numpy writes the same bytes", file.read() == whole)
    del here
    gc.collect()
    bad("a field that is cut off", data=whole[:-8])
    bad("no field at all", data=b"t,x\n" * 1000)
    bad("nothing", data=b"")
    bad("big-endian", ">f8", array=good.astype(">f8"))
    bad("single precision", "<f4", array=good.astype("<f4"))
    bad("Fortran order", "Fortran order", array=np.asfortranarray(good))
    bad("another shape", "(129, 101)", array=good.reshape(129, 101))
    bad("pickled objects", array=good.astype(object), pickled=True)
    os.remove("fields/film.film.npy")
    check("a field that is gone", raised(lambda: flankfilm.open("fields")["film.film"], "No such file", code=None))


def test_errors():
    check("a wrong word", raised(lambda: flankfilm.run("case.yaml", {"duty.torqu": "3 N m"}),
                                 'unknown key "torqu"; did you mean "torque"?'))
    check("two at once", raised(lambda: flankfilm.check("case.yaml", {"duty.torque": 3, "viscosity.use": "viscosity/no"}),
                                "duty.torque", "viscosity/no"))
    check("no file", raised(lambda: flankfilm.run("none.yaml"), "none.yaml"))
    check("no results", raised(lambda: flankfilm.open("."), "no results of flankfilm", code=None))
    check("a file that is right", flankfilm.check("case.yaml") is False)
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
    check("its shape", s.shape == (3, 2) and s.dims == ["torque", "viscosity.use"])
    check("what is varied", list(s.axes["torque"]) == [100, -2e12, 300] and s.axes["torque"].unit == "N m" and
          list(s.axes["viscosity.use"]) == ["viscosity/barus", "viscosity/roelands"])
    check("failed cases", list(s.status[1]) == ["invalid"] * 2 and "too small" in s.reason[1, 0])
    rms, film = s["motion.dte_rms"], s["film.h_min"]
    check("a scalar over the study", rms.dims == ("torque", "viscosity.use") and np.isnan(rms[1]).all())
    check("a series over the study", film.dims == ("torque", "viscosity.use", "t") and film.data.shape[:2] == (3, 2))
    one = flankfilm.run("case.yaml", {"duty.torque": "300 N m", "viscosity.use": "viscosity/roelands"})
    check("a case of it", np.allclose(film[2, 1], one["film.h_min"].data, rtol=1e-11, atol=0))
    check("and its scalars", np.isclose(float(rms[2, 1]), float(one["motion.dte_rms"]), rtol=1e-11))
    with open("study/table.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    check("the table", s.table["motion.dte_rms [m]"] == [row["motion.dte_rms [m]"] for row in rows])
    check("all names", set(s) >= {"film.h_min", "motion.dte_rms"})
    check("a case", np.array_equal(s.case(0)["film.h_min"].data, film[0, 0]) and s.case(2) == {})
    check("is mapped", s.case(0)["film.h_min"].data.base is not None)
    check("with its axis", film.against == ("film.roll_angle",) and s["film.roll_angle"].data.shape == film.data.shape)
    log = "study/" + next(n for n in os.listdir("study") if n.endswith(".log"))
    with open(log, "r+b") as file:
        file.seek(-200, os.SEEK_END)
        byte = file.read(1)
        file.seek(-1, os.SEEK_CUR)
        file.write(bytes([byte[0] ^ 1]))
    check("a byte that was changed", raised(lambda: [flankfilm.open("study").case(i) for i in range(6)],
                                            log, "does not have its checksum", code=None))
    os.truncate(log, os.path.getsize(log) - 1)
    check("a log that is cut off", raised(lambda: [flankfilm.open("study").case(i) for i in range(6)],
                                          log, "is cut off", code=None))
    os.remove(log)
    check("a log that is gone", raised(lambda: [flankfilm.open("study").case(i) for i in range(6)],
                                       log, "No such file", code=None))
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


def test_engine():
    engine = flankfilm.Engine()
    told = flankfilm.run("case.yaml", {"duty.torque": "300 N m"})
    shares = []
    run = engine.run("case.yaml", {"duty.torque": "300 N m"}, progress=shares.append)
    film = run["film.h_min"]
    check("a run in this process", np.allclose(film.data, told["film.h_min"].data, rtol=1e-11, atol=0))  # JSON has 12 digits
    check("has the same words", (film.unit, film.dims, film.doc) ==
          (told["film.h_min"].unit, told["film.h_min"].dims, told["film.h_min"].doc))
    check("names what it has", set(told.asked) <= set(run) and len(run) == len(list(run)))
    check("judges it", run.quality["gears"]["pitch_error"]["verdict"] == "good")
    field = engine.run("case.yaml", {"film.use": "ehl/finite-volume", "film.cells": 64, "film.steps": 40,
                                     "outputs": ["film.pressure"]}, progress=shares.append)
    pressure = field["film.pressure"].data
    check("arrays share the engine's memory", np.shares_memory(pressure, field["film.pressure"].data))
    check("nobody writes there", not pressure.flags.writeable)
    check("progress is told", shares and all(0 <= x <= 1 for x in shares))
    kept, high = pressure[3], float(pressure[3].max())
    del field, pressure, run, engine
    gc.collect()
    check("arrays keep their run", float(kept.max()) == high)
    engine = flankfilm.Engine()
    ring = [engine, engine.run("case.yaml"), engine.model("viscosity/barus")]
    ring.append(ring)
    del engine, ring
    gc.collect()
    check("a cycle of objects is collected", True)  # in whatever order


def test_engine_errors():
    engine = flankfilm.Engine()
    check("a wrong word", raised(lambda: engine.run("case.yaml", {"duty.torqu": "3 N m"}),
                                 'unknown key "torqu"; did you mean "torque"?'))
    check("no file", raised(lambda: engine.run("none.yaml"), "none.yaml"))
    check("a study is the program's", raised(lambda: engine.run("study.yaml"), "study"))
    check("no model", raised(lambda: engine.model("viscosity/baru"), "viscosity/barus"))
    check("no parameter", raised(lambda: engine.model("viscosity/barus", {"alpa": 1e-8}), "alpa"))
    check("a wrong unit", raised(lambda: engine.model("viscosity/barus", {"alpha": "3 mm"}), "alpha"))
    check("no law", raised(lambda: engine.model("gear/involute-spur").law(), "not a law"))
    check("stopped", raised(lambda: engine.run("case.yaml", {"film.use": "ehl/finite-volume"},
                                               progress=lambda share: True), "stopped", code=1))
    try:
        engine.run("case.yaml", {"film.use": "ehl/finite-volume"}, progress=lambda share: 1 // 0)
        check("an error of one's own passes", False)
    except ZeroDivisionError:
        check("an error of one's own passes", True)
    killer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
    killer.start()
    try:
        engine.run("case.yaml", {"film.use": "ehl/finite-volume", "film.cells": 1024, "film.steps": 4000})
        check("Ctrl-C stops a run", False)
    except KeyboardInterrupt:
        check("Ctrl-C stops a run", True)
    check("the engine goes on", float(engine.run("case.yaml")["motion.dte_rms"]) > 0)


def test_laws():
    engine = flankfilm.Engine()
    eta0, alpha = 0.01, 2e-8
    barus = engine.model("viscosity/barus", {"eta0": eta0, "alpha": alpha}).law()
    p = np.array([[0, 1e8], [2e8, 3e8]])
    ln_eta, over_p, over_T = barus(p, slopes=True)
    check("a viscosity", np.allclose(ln_eta, np.log(eta0) + alpha * p, rtol=1e-14))
    check("its slopes", np.allclose(over_p, alpha) and not over_T.any() and over_p.shape == p.shape)
    rho = engine.model("density/incompressible", {"rho0": "870 kg/m3"}).law()
    check("a density", np.all(rho(p, 300) == 870))
    flow = engine.model("rheology/ree-eyring", {"tau0": "5 MPa"}).law()
    psi = flow.flow(ln_eta, 1e-7, 1.0)
    check("a flow law", np.allclose(psi, np.hypot(np.exp(-ln_eta), 1 / (5e6 * 1e-7)), rtol=1e-12))
    check("its shear", np.allclose(flow.shear(p, ln_eta, 1e-7, 1.0), 5e6 * np.arcsinh(np.exp(ln_eta) / 5e6 / 1e-7)))
    grade = engine.model("lubricant/grade", {"grade": "ISO VG 100", "temperature": "40 degC"}).law()
    ln_eta0, rho0 = (grade(name, 313.15) for name in ("ln_eta0", "rho0"))
    check("no such property", raised(lambda: engine.model("lubricant/grade", {
        "grade": "ISO VG 100"}).law()("eta0", 300), "ln_eta0"))
    check("an oil", np.isclose(np.exp(ln_eta0) / rho0, 100e-6, rtol=1e-6))


def test_models():
    engine = flankfilm.Engine()
    gear = engine.model("gear/involute-spur", {"teeth": [50, 50], "module": 3e-3, "face_width": "20 mm"})
    out = gear.run("contact_ratio", "teeth")
    check("a model by hand", list(out["teeth"].data) == [50, 50] and 1 < float(out["contact_ratio"]) < 2)
    gear.set({"teeth": [20, 20]})
    fewer = gear.run("contact_ratio")["contact_ratio"]
    check("set anew", float(fewer) < float(out["contact_ratio"]))
    duty = engine.model("operating/steady", {"torque": 250.0, "speed": "1500 rpm"}, {"gear": gear})
    check("wanted outputs are named", raised(gear.run, "name the outputs"))
    check("wired to another", np.isclose(float(duty.run("mesh_frequency")["mesh_frequency"]), 1500 / 60 * 20))


def test_arguments():
    """A careless user: numbers of numpy, one text for a list of them, things of another sort."""
    engine = flankfilm.Engine(plugins)
    plain_run = engine.run("case.yaml", {"duty.torque": "300 N m", "gears.teeth": [49, 51]})
    same = engine.run(pathlib.Path("case.yaml"), {
        "duty.torque": np.str_("300 N m"), "gears.teeth": np.array([49, 51]), "film.use": "ehl/film-formula"})
    check("numbers of numpy in a run", np.array_equal(plain_run["film.h_min"].data, same["film.h_min"].data))
    check("and in the program's", list(flankfilm.run("case.yaml", {
        "gears.teeth": (np.int64(49), 51), "outputs": ["gears.teeth"]})["gears.teeth"]) == [49, 51])
    check("one of them", raised(lambda: engine.run("case.yaml", {"gears.teeth": np.float64(49.5)}), "gears.teeth"))
    barus = engine.model("viscosity/barus", {"eta0": np.float32(0.01), "alpha": np.array(2e-8)})
    check("and of a model", np.isclose(barus.law()(np.float64(1e8)), np.log(0.01) + 2))
    gear = engine.model("gear/involute-spur", {"teeth": ["50", "50"], "module": np.float64(3e-3),
                                               "face_width": "20 mm"})
    check("texts in a list", float(gear.run("contact_ratio")["contact_ratio"]) > 1)
    check("one directory", isinstance(flankfilm.Engine(pathlib.Path(plugins)), flankfilm.Engine))
    check("no directory", raised(lambda: flankfilm.Engine([3]), "plugin_paths: expected a path, found an int"))
    check("no list", raised(lambda: flankfilm.Engine(3), "plugin_paths: expected"))
    check("one law to fit", raised(lambda: flankfilm.fit("viscosity", os.path.join(
        source, "configs", "measured", "pao-b.csv"), laws="viscosity/no", at="80 degC"), "viscosity/no"))
    calls = {
        "no file": (lambda: engine.run(None), "file: expected a path, found a NoneType"),
        "nor for the program": (lambda: flankfilm.run(3), "file: expected a path"),
        "sets in a list": (lambda: engine.run("case.yaml", ["duty.torque=3 N m"]),
                           "sets: expected a dictionary, found a list"),
        "a key that is no text": (lambda: flankfilm.check("case.yaml", {3: 4}), "sets: expected a name, found an int"),
        "a value that is none": (lambda: engine.run("case.yaml", {"duty.torque": object()}), "duty.torque: expected"),
        "nor in a list": (lambda: flankfilm.check("case.yaml", {"gears.teeth": [1j]}), "gears.teeth: expected"),
        "progress": (lambda: engine.run("case.yaml", progress=3), "progress: expected a function"),
        "a model's name": (lambda: engine.model(3), "model: expected a name"),
        "parameters": (lambda: engine.model("viscosity/barus", ["alpha"]), "parameters: expected a dictionary"),
        "no number": (lambda: barus.set({"alpha": None}), "alpha: expected numbers, found a NoneType"),
        "a complex one": (lambda: barus.set({"alpha": 1j}), "alpha: expected numbers"),
        "ragged lists": (lambda: gear.set({"teeth": [[1], [2, 3]]}), "teeth: expected numbers"),
        "a wire to a text": (lambda: engine.model("ehl/film-formula").use({"viscosity": "barus"}),
                             "viscosity: expected a model"),
        "a wire to another engine": (lambda: flankfilm.Engine().model("ehl/film-formula").use({"viscosity": barus}),
                                     "viscosity: expected a model of the same engine"),
        "an input": (lambda: engine.model("ehl/film-formula").give({"contact.t": "now"}), "contact.t: expected numbers"),
        "outputs in a list": (lambda: gear.run(["contact_ratio"]), "an output: expected a name"),
        "a pressure": (lambda: barus.law()("high"), "p: expected numbers, found a str"),
        "no pressure": (lambda: barus.law()(None), "p: expected numbers"),
        "shapes": (lambda: barus.law()([1, 2, 3], [300, 400]), "p (3,), T (2,)"),
        "a sliding speed": (lambda: engine.model("rheology/newtonian").law().flow(-4, 1e-7, [1, 2]), "u_s: expected one"),
        "results": (lambda: flankfilm.open(None), "path: expected a path"),
    }
    for what, (call, says) in calls.items():
        check(what, raised(call, says))
    try:
        plain_run["film.h_mi"]
        check("a result that is not there", False)
    except KeyError as error:
        check("a result that is not there", "there is no result" in str(error) and "film.h_min" in str(error))


def test_read_only():
    """A view of the engine's memory stays read-only."""
    film = flankfilm.Engine().run("case.yaml")["film.h_min"].data
    for writable in film, film.view(), film.base:
        try:
            writable.setflags(write=True)
            check("nobody can write there", False)
        except ValueError:
            check("nobody can write there", True)
        except AttributeError:  # the buffer itself
            check("nobody can write there", memoryview(writable).readonly)


def test_examples():
    for name, words in {"example.py": "to the power of -0.1", "laws.py": "central film",
                        "optimise.py": "9.8 um of relief"}.items():
        done = subprocess.run([sys.executable, os.path.join(source, "configs", "python", name)],
                              capture_output=True, text=True, check=False)
        check(name + " runs", done.returncode == 0 and words in done.stdout)
        if done.returncode:
            print(done.stdout, done.stderr)


with tempfile.TemporaryDirectory() as lab:
    os.chdir(lab)
    for name, text in {"case": case, "study": study, "follow": follow}.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
    test_run()
    test_fields()
    test_errors()
    test_study()
    test_fit()
    test_engine()
    test_engine_errors()
    test_laws()
    test_models()
    test_arguments()
    test_read_only()
    test_examples()
    os.chdir("/")
print("all well" if not failed else f"{failed} failed")
sys.exit(failed > 0)
