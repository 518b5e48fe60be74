# SPDX-License-Identifier: GPL-3.0-or-later
"""A torque below 0 must act like a torque above 0 on the exchanged pair: the back flanks carry the load, and gear 2 drives.

Compares an unequal pair, with unequal materials and reliefs, at -T with the exchanged pair at T z_2/z_1 and the same
mesh frequency, with the tip relief of the back flanks: motion and losses must agree to 1e-4, films to 1e-3, at corresponding
roll angles. Data of the driving flanks must have no effect.

flanks.py FLANKFILM SOURCE
"""
import json
import math
import subprocess
import sys
import tempfile

program, source = sys.argv[1:]
failed = False
outputs = ("gears.roll_angle, motion.dte_rms, motion.dte_mean, motion.dynamic_factor_mesh, motion.dynamic_factor_tooth, "
           "motion.mesh_force, film.roll_angle, film.h_min, film.h_min_lowest, film.p_max_highest, film.h_min_lowest_at, "
           "losses.power_loss_mean, losses.power_input, losses.sliding_loss_mean, losses.rolling_loss_mean, losses.flash_temperature_max, "
           "losses.flash_temperature_max_at, scuffing.margin, scuffing.flash_temperature_max_at, micropitting.lambda_gf_min")


def report(good, text):
    global failed
    failed = failed or not good
    print(f"{'ok' if good else 'FAIL'} {text}")


def check(what, found, expected, limit):
    off = abs(found / expected - 1)
    report(off <= limit, f"{what}: off by {off:.2g}, at most {limit:g}")


def run(gear, torque, model, film="ehl/film-formula"):
    text = f"""format: 2
include: [{source}/configs/lubricants/mil-l-23699.yaml]
pipeline:
  gears: {{use: gear/involute-spur, module: 2 mm, face_width: 20 mm, centre_distance: 81 mm, stations: 3000, {gear}}}
  duty: {{use: operating/steady, torque: {torque} N m, mesh_frequency: 1900 Hz, oil_temperature: 100 degC}}
  mesh: {{use: stiffness/load-distribution, compliance: analytical, points: 3000}}
  motion: {{use: dynamics/{model}}}
  tooth: {{use: contact/tooth-pair, load: motion, points: 1500}}
  film: {{use: {film}}}
  losses: {{use: losses/tooth-mesh}}
  scuffing: {{use: rating/scuffing, load_stage: 12}}
  micropitting: {{use: rating/micropitting, test_lambda: 0.102}}
outputs: [{outputs}]
"""
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write(text)
        file.flush()
        done = subprocess.run([program, "run", file.name, "--json", "--arrays"], stdout=subprocess.PIPE)
    answer = json.loads(done.stdout)
    if answer["exit"]:
        sys.exit(f"{model}, {gear}: {answer['errors']}")
    return {name: o.get("value", o.get("data")) for name, o in answer["outputs"].items()}


ratio = 27 / 52
back = ("teeth: [27, 52], profile_shift: [0.5, 0.55], elastic_modulus: [206 GPa, 190 GPa], thermal_conductivity: [50 W/(m K), 40 W/(m K)], roughness_ra: [0.3 um, 0.4 um], "
             "specific_heat: 484 J/(kg K), tip_relief: 30 um, back_relief: [12 um, 7 um], back_relief_length: [1.6 mm, 1.9 mm]")
driving = ("teeth: [52, 27], profile_shift: [0.55, 0.5], elastic_modulus: [190 GPa, 206 GPa], thermal_conductivity: [40 W/(m K), 50 W/(m K)], roughness_ra: [0.4 um, 0.3 um], "
            "specific_heat: 484 J/(kg K), tip_relief: [7 um, 12 um], tip_relief_length: [1.9 mm, 1.6 mm], back_relief: 35 um")
signed, other = run(back, -90, "shooting"), run(driving, 90 / ratio, "shooting")
for name in "motion.dte_rms", "motion.dynamic_factor_mesh", "motion.dynamic_factor_tooth", "losses.power_loss_mean", "losses.power_input", "losses.sliding_loss_mean", "losses.rolling_loss_mean", "scuffing.margin":
    check(name, signed[name], other[name], 1e-4)
for name in "film.h_min_lowest", "film.p_max_highest", "losses.flash_temperature_max", "micropitting.lambda_gf_min":
    check(name, signed[name], other[name], 1e-3)
check("the mean error is mirrored", -signed["motion.dte_mean"], other["motion.dte_mean"], 1e-4)
check("and the mesh force", -min(signed["motion.mesh_force"]), max(other["motion.mesh_force"]), 1e-4)

# the roll angles of a place on both gears: xi_2 = tan(alpha) + z_1/z_2 (tan(alpha) - xi_1)
angle = math.acos((27 + 52) * 2e-3 / 2 * math.cos(math.radians(20)) / 81e-3)
for name in "film.h_min_lowest_at", "losses.flash_temperature_max_at", "scuffing.flash_temperature_max_at":
    check(name, math.tan(angle) + ratio * (math.tan(angle) - signed[name]), other[name], 1e-3)
falls = signed["film.roll_angle"]
report(all(a >= b for a, b in zip(falls, falls[1:])) and falls[0] > falls[-1], "contact runs from the tip of gear 1 to its root")

film = "ehl/finite-volume, cells: 96, steps: 200"
signed, other = (run(gear, torque, "time-integration", film) for gear, torque in ((back, -90), (driving, 90 / ratio)))
for name in "motion.dte_rms", "motion.dynamic_factor_tooth", "losses.power_loss_mean":
    check(f"by another motion and film, {name}", signed[name], other[name], 1e-4)
for name in "film.h_min_lowest", "film.p_max_highest":
    check(f"by another motion and film, {name}", signed[name], other[name], 1e-3)
sys.exit(failed)
