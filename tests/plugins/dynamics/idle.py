# SPDX-License-Identifier: GPL-3.0-or-later
"""Gears without a torque: they float, with no force and no loss, and what a reference torque stands for.

idle.py FLANKFILM SOURCE
"""
import json
import subprocess
import sys
import tempfile

program, source = sys.argv[1:]
failed = False
GEARS = ("gears: {use: gear/involute-spur, module: 2 mm, face_width: 20 mm, centre_distance: 81 mm, teeth: [27, 52], profile_shift: [0.5, 0.55], "
         "roughness_ra: 0.3 um, backlash: 0.1 mm, tip_relief: [10 um, 15 um]}")
FLOATING = ["motion.dte_rms", "motion.dte_mean", "motion.mesh_force", "motion.tooth_force", "motion.dynamic_factor_tooth", "motion.gap"]
LOST = ["film.h_min_lowest", "film.p_max_highest", "film.traction", "losses.power_loss_mean", "losses.power_input", "losses.flash_temperature_max"]


def report(good, text):
    global failed
    failed = failed or not good
    print(f"{'ok' if good else 'FAIL'} {text}")


def run(outputs, torque="0 N m", motion="shooting", film="film-formula", mesh="load-distribution, compliance: analytical", more=""):
    text = f"""format: 2
include: [{source}/configs/lubricants/mil-l-23699.yaml]
pipeline:
  {GEARS}
  duty: {{use: operating/steady, torque: {torque}, mesh_frequency: 1900 Hz, oil_temperature: 100 degC{more}}}
  mesh: {{use: stiffness/{mesh}}}
  motion: {{use: dynamics/{motion}}}
  tooth: {{use: contact/tooth-pair, load: motion, points: 200}}
  film: {{use: ehl/{film}}}
  losses: {{use: losses/tooth-mesh}}
  scuffing: {{use: rating/scuffing, load_stage: 12}}
outputs: [{', '.join(outputs)}]
"""
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write(text)
        file.flush()
        done = subprocess.run([program, "run", file.name, "--json", "--arrays"], stdout=subprocess.PIPE)
    answer = json.loads(done.stdout)
    if answer["exit"]:
        return answer["errors"][0]["message"]
    found = {name: o.get("value", o.get("data")) for name, o in answer["outputs"].items()}
    found["lines"] = {name: line for stage in answer["stages"] for name, line in stage["quality"].items()}
    return found


def flat(value):
    return [y for x in value for y in flat(x)] if isinstance(value, list) else [value]


def largest(value):
    return max(abs(x) for x in flat(value))


def check(what, found, expected, limit):
    off = abs(found / expected - 1)
    report(off <= limit, f"{what}: off by {off:.2g}, at most {limit:g}")


def floats():
    for motion in "shooting", "time-integration", "harmonic-balance", "quasi-static":
        found = run(FLOATING, motion=motion)
        report("floating" in found["lines"] and "float" in found["lines"]["floating"]["text"], f"{motion}: says that the gears float")
        report(all(largest(found[name]) == 0 for name in FLOATING[:-1]), f"{motion}: stands still without force")
        report(abs(largest(found["motion.gap"]) / 50e-6 - 1) < 0.31, f"{motion}: in the middle of the backlash")
    for film in "film-formula", "inlet-analysis", "finite-volume, thermal: full", "dense-newton", "control-volume":
        found = run(LOST, film=film)
        report(found["film.h_min_lowest"] > 30e-6 and all(largest(found[name]) == 0 for name in LOST[1:]), f"{film}: the gap, without pressure and loss")
    report("no power goes" in run(["losses.efficiency"]), "an efficiency is refused")
    report("nothing to rate" in run(["scuffing.margin"]), "a rating is refused")
    report("there is no branch" in run(["motion.fold_frequency"]), "an atlas is refused")


def reference():
    """What stiffness, natural frequency and shares are taken at."""
    names = ["motion.natural_frequency", "mesh.stiffness_mean", "mesh.load_share", "mesh.force_level"]
    loaded, at_rest = run(names, "90 N m"), run(names, more=", reference_torque: 90 N m")
    for name in names:
        report(loaded[name] == at_rest[name], f"{name} of the reference torque")
    names = ["motion.dte_rms", "mesh.tooth_force"]
    same, other = run(names, "90 N m"), run(names, "90 N m", more=", reference_torque: 180 N m")
    report(run(names, "90 N m", more=", reference_torque: 90 N m") == same, "the torque itself is the preset")
    report(abs(other["motion.dte_rms"] / same["motion.dte_rms"] - 1) > 1e-3, "another one is another stiffness")
    check("its shares are of the load", max(other["mesh.tooth_force"]), max(same["mesh.tooth_force"]), 0.02)
    report("leave reference_torque" in run(["motion.dte_rms"], "90 N m", "quasi-static", more=", reference_torque: 180 N m"), "no error of another load")
    report("reference_torque of the duty" in run(["motion.dte_rms"], motion="shooting", mesh="iso-6336"), "a standard that needs a load names it")


floats()
reference()
sys.exit(failed)
