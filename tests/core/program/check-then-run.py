#!/usr/bin/python3
"""What `check` finds before anything runs: outputs that lack what they need, cases of a study that
cannot be, stages that are taken away, keys of other programs; and the examples of a build folder.
check-then-run.py FLANKFILM BUILD_ROOT SOURCE_ROOT"""
import os
import shutil
import subprocess
import sys
import tempfile

flankfilm, build, source = map(os.path.realpath, sys.argv[1:4])
env = {**os.environ, "FLANKFILM_PLUGIN_PATH": os.path.join(build, "plugins"), "OPENBLAS_NUM_THREADS": "1"}
lab = tempfile.mkdtemp()
bad = 0

GEARS = """format: 2
include: [lubricants/gear-oil-mineral.yaml]
pipeline:
  oil: {temperature: 60 degC}
  gears: {use: gear/involute-spur, teeth: [19, 41], module: 4 mm, face_width: 30 mm, roughness_rq: [0.3 um, 0.4 um]}
  duty: {use: operating/steady, torque: 300 N m, speed: 1800 rpm}
  mesh: {use: stiffness/iso-6336}
  tooth: {use: contact/tooth-pair, load: mesh}
  film: {use: ehl/film-formula}
  losses: {use: losses/tooth-mesh}
  pits: {use: rating/micropitting}
"""


def call(*words, program=None):
    done = subprocess.run([program or flankfilm, *words], cwd=lab, env=env, capture_output=True, text=True)
    return done.returncode, " ".join((done.stdout + done.stderr).split())


def holds(what, good, said=""):
    global bad
    if not good:
        bad += 1
        print("not so:", what, said)


def write(name, text):
    with open(os.path.join(lab, name), "w") as out:
        out.write(text)


def refused(name, text, *says):
    """By `check` and, with the same words, by `run`."""
    write(name, text)
    for command in (["check", name], ["run", name, "-o", "out"]):
        code, said = call(*command)
        holds("%s %s says %s" % (command[0], name, says), code == 2 and all(s in said for s in says), said)


def passes(name, text, says):
    write(name, text)
    code, said = call("check", name)
    holds("check %s says %s" % (name, says), code == 0 and says in said, said)
    code, said = call("run", name, "-o", "out-" + name, "-j", "1") if "study" in text else call("run", name, "-o", "out-" + name)
    holds("run %s" % name, code in (0, 4), said)
    return said


# who reads what nobody gives is known before anything runs
refused("temperature.yaml", GEARS + "outputs: [losses.efficiency, pits.lambda_gf_min]\n",
        "duty.oil_temperature (operating/steady): oil_temperature is missing", "duty.oil_temperature is needed by losses, pits")
refused("named.yaml", GEARS + "outputs: [duty.oil_temperature]\n", "duty.oil_temperature is requested by name")
warm = GEARS.replace("1800 rpm", "1800 rpm, oil_temperature: 60 degC")
refused("own.yaml", warm.replace("rating/micropitting", "rating/micropitting, ehl: none") + "outputs: [pits.own_lambda_gf_min]\n",
        "pits.own_lambda_gf_min (rating/micropitting): this output needs a film", "requested by name")
refused("test.yaml", warm + "outputs: [pits.safety]\n", "this output needs test_lambda")
# what a model refuses when it runs, before its first word on its progress
HEAT = """format: 2
pipeline:
  discs: {use: contact/constant, radius: 12.8 mm, entrainment_speed: 4 m/s, slide_roll_ratio: 0.1, load_per_width: 177 N/mm}
  viscosity: {use: viscosity/barus, eta0: 40 mPa s, alpha: 18 1/GPa}
  density: {use: density/dowson-higginson, rho0: 870 kg/m3}
  flow: {use: rheology/newtonian}
  film: {use: ehl/finite-volume, cells: 128}
outputs: [film.temperature_max]
"""
refused("cold.yaml", HEAT, "film.temperature_max (ehl/finite-volume): this output needs thermal: full")
# where nobody needs it, it is left out, and what it feeds does without
passes("star.yaml", GEARS + "outputs: [duty.*, oil.eta0]\n", "ok")
passes("optional.yaml", GEARS + "outputs: [film.h_min]\n", "ok")

# each case of a study is looked at, each case with its own values
pairs = warm + "outputs: [gears.contact_ratio]\nstudy: {sweep: {gears.teeth: [%s], gears.module: [4 mm, 3 mm]}}\n"
passes("pairs.yaml", pairs % "[19, 41], [20, 40]", "all 4 cases")
# at a centre distance of 120 mm both pairs have 4 mm; with half of it no teeth meet
zipped = warm.replace("module: 4 mm", "module: 4 mm, centre_distance: 120 mm")
cross = "outputs: [gears.contact_ratio]\nstudy: {sweep: {gears.teeth: [[19, 41], [20, 40]], gears.module: [4 mm, 3.99 mm]}}\n"
write("cross.yaml", zipped + cross.replace("3.99", "2"))
code, said = call("check", "cross.yaml")
holds("a case that cannot be is found", code == 2 and "gears" in said, said)
write("many.yaml", warm + "outputs: [duty.line_force]\nstudy: {sweep: {duty.torque: {from: 1 N m, to: 300 N m, points: 400}}}\n")
code, said = call("check", "many.yaml")
holds("of many cases it says what was looked at", code == 0 and "400 cases, of which each value was checked once" in said, said)
drawn = """study:
  uncertainty: {outputs: [duty.line_force], samples: 40, inputs: {duty.torque: {uniform: [%s N m, 300 N m]}}}
"""
write("drawn.yaml", GEARS + drawn % "100")
code, said = call("check", "drawn.yaml", "--strict")
holds("of drawn cases, too", code == 0 and "2 of 2 cases" in said and "warning" not in said, said)

# an empty value takes a stage away
passes("away.yaml", "format: 2\ninclude: [star.yaml]\npipeline: {pits: , losses: }\noutputs: [film.h_min]\n", "ok (9 stages)")
code, said = call("check", "star.yaml", "--set", "losses=", "--set", "pits=", "--set", "outputs=[film.h_min]")
holds("by an assignment, too", code == 0 and "ok (9 stages)" in said, said)
refused("nothing.yaml", GEARS.replace("losses: {use: losses/tooth-mesh}", "losses:") + "outputs: [film.h_min]\n",
        "losses: expected a map that says which model it uses, found nothing")

# what is meant by keys of other programs, and by a list without commas
for old, new, hint in (("teeth: [19, 41]", "teeth: [19 41]", "separate the numbers of a list by commas: [1, 2]"),
                       ("module", "helix_angle: 15 deg, module", "spur teeth have no helix angle"),
                       ("torque", "power: 50 kW, torque", "perhaps \"torque\" is meant"),
                       ("oil: {", "oil: {viscosity: 220 cSt, ", "perhaps \"grade\" is meant"),
                       ("film: {use: ehl/film-formula", "film: {use: ehl/film-formula, test_lambda: 1",
                        "perhaps \"test_lambda\" of pits (rating/micropitting) is meant")):
    refused("hint.yaml", warm.replace(old, new) + "outputs: [film.h_min, pits.lambda_gf_min]\n", hint)
code, said = call("check", "hint.yaml", "--set", "gears.nonsense=1")
holds("no hint where nothing is near", "gears: unknown key \"nonsense\" for gear/involute-spur" in said
      and "meant" not in said.split("nonsense")[1].split("perhaps")[0].split("film")[0], said)

# the examples are found from a build folder wherever it is
away = os.path.join(lab, "elsewhere/build")
os.makedirs(away)
for name in os.listdir(build):
    if name == "flankfilm" or name.startswith("libflankfilm.so") and os.path.isfile(os.path.join(build, name)):
        shutil.copy(os.path.join(build, name), away, follow_symlinks=False)
os.symlink(os.path.join(build, "plugins"), os.path.join(away, "plugins"))
shutil.copy(os.path.join(build, "configs"), away, follow_symlinks=False)
code, said = call("check", "star.yaml", program=os.path.join(away, "flankfilm"))
holds("examples beside a build folder that is not in the sources", code == 0 and "ok" in said, said)
shutil.rmtree(lab)
sys.exit(bad > 0)
