# SPDX-License-Identifier: GPL-3.0-or-later
"""Contact, film and losses of the back flanks, in a motion that loads both flanks alternately.

Equal gears under a torque that oscillates about 0: the second half of the motion mirrors the first, so that both flanks must give equal results.
Unequal gears with unequal reliefs: the results of the back flanks must be those of the driving flanks of the exchanged pair. The tooth pairs
must carry the mesh force; the losses of both flanks must add up; a flank without load must have no loss, and a film as thick as the gap.

back-tooth-pair.py FLANKFILM SOURCE
"""
import json
import math
import subprocess
import sys
import tempfile

program, source = sys.argv[1:]
failed = False
EQUAL = "teeth: [50, 50], module: 3 mm, pressure_angle: 20 deg, backlash: 0.04 mm, tip_relief: 12 um"
FIRST = ("teeth: [27, 52], module: 2 mm, centre_distance: 81 mm, profile_shift: [0.5, 0.55], backlash: 0.06 mm, elastic_modulus: [206 GPa, 190 GPa], "
         "tip_relief: [18 um, 22 um], tip_relief_length: [2.1 mm, 1.8 mm], back_relief: [9 um, 14 um], back_relief_length: [1.6 mm, 1.9 mm]")
OTHER = ("teeth: [52, 27], module: 2 mm, centre_distance: 81 mm, profile_shift: [0.55, 0.5], backlash: 0.06 mm, elastic_modulus: [190 GPa, 206 GPa], "
         "tip_relief: [14 um, 9 um], tip_relief_length: [1.9 mm, 1.6 mm], back_relief: [22 um, 18 um], back_relief_length: [1.8 mm, 2.1 mm]")
RATIO, WIDTH = 27 / 52, 20e-3
FILMS = ["film.h_min_lowest", "film.p_max_highest", "film.h_min_lowest_at", "losses.flash_temperature_max"]
LOADS = ["tooth.mesh_load_mean", "losses.power_loss_mean", "losses.sliding_loss_mean", "losses.rolling_loss_mean"]


def report(good, text):
    global failed
    failed = failed or not good
    print(f"{'ok' if good else 'FAIL'} {text}")


def check(what, found, expected, limit):
    off = abs(found / expected - 1)
    report(off <= limit, f"{what}: off by {off:.2g}, at most {limit:g}")


def run(gears, duty, outputs, motion="shooting, damping_ratio: 0.15, damping: contact", film="film-formula", losses="ehl: film", back="ehl: back_film", mesh="load-distribution, compliance: analytical, points: 1500"):
    text = f"""format: 2
include: [{source}/configs/lubricants/mil-l-23699.yaml]
pipeline:
  gears: {{use: gear/involute-spur, face_width: {WIDTH} m, stations: 3000, {gears}}}
  duty: {{use: operating/steady, oil_temperature: 100 degC, {duty}}}
  mesh: {{use: stiffness/{mesh}}}
  motion: {{use: dynamics/{motion}}}
  tooth: {{use: contact/tooth-pair, load: motion, load_ramp: 0 deg}}
  film: {{use: ehl/{film}, contact: tooth}}
  losses: {{use: losses/tooth-mesh, {losses}}}
  back_tooth: {{use: contact/back-tooth-pair, load: motion, load_ramp: 0 deg}}
  back_film: {{use: ehl/{film}, contact: back_tooth}}
  back_losses: {{use: losses/tooth-mesh, {back}}}
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
    found["lines"] = {(stage["stage"], name): line for stage in answer["stages"] for name, line in stage["quality"].items()}
    return found


def both(names):
    return [prefix + name for name in names for prefix in ("", "back_")]


def halves():
    for film in "film-formula", "finite-volume, cells: 64, steps: 200":
        found = run(EQUAL, "torque: 0 N m, mesh_frequency: 900 Hz, torque_fluctuation: {amplitude: [400 N m], order: [50]}", both(LOADS + FILMS) + ["motion.period"],
                    "shooting, damping_ratio: 0.3, damping: contact, steps_per_cycle: 1000", film)
        report(found["motion.period"] == 1 and found["tooth.mesh_load_mean"] > 1000, f"{film}: both flanks bear in each cycle")
        for name in LOADS + FILMS:
            if not name.endswith("_at"):
                check(f"equal gears, {film}, {name}: the same on both flanks", found["back_" + name], found[name], 2e-4)


def exchanged():
    """The angle of the swing counts from a pair at the start of the profile of gear 1: on the flanks that gear 1 drives or, with a torque
    below 0, on the others. That is the end of the profile of gear 2, and on the other flanks the age `back_offset` apart. The force jumps where
    flanks land, by up to twice its mean here; if that is between stations at another place, a mean over 3000 of them is off by up to 1e-3."""
    angle = math.acos((27 + 52) * 2e-3 / 2 * math.cos(math.radians(20)) / 81e-3)

    def swing(gears, torque, size, order, phase, film, zeta=0.15):
        return run(gears, f"torque: {torque} N m, mesh_frequency: 1300 Hz, torque_fluctuation: {{amplitude: [{size} N m], order: [{order}], phase: [{phase} deg]}}",
                   both(LOADS + FILMS) + ["gears.contact_ratio", "mesh.back_offset", "mesh.stiffness_mean", "motion.back_contact"],
                   f"shooting, damping_ratio: {zeta}, damping: contact", film)
    for torque, phase, film, limits in ((0, 40, "film-formula", (3e-3, 3e-3)), (-6, 40, "film-formula", (1e-4, 1e-3)), (6, 100, "film-formula", (1e-4, 1e-3)),
                                        (6, 100, "finite-volume, cells: 64, steps: 300", (3e-3, 3e-3))):
        one = swing(FIRST, torque, 80, 27, phase, film)
        turn = one["mesh.back_offset"] - one["gears.contact_ratio"] if torque == 0 else math.copysign(one["gears.contact_ratio"], torque)
        turned = OTHER, -torque / RATIO, 80 / RATIO, 52, math.remainder(phase + 180 + 360 * turn, 360), film
        other = swing(*turned)
        # the damper follows the stiffness of the driving flanks, which are others at a torque of 0
        if torque == 0:
            other = swing(*turned, 0.15 * math.sqrt(one["mesh.stiffness_mean"] / other["mesh.stiffness_mean"]))
        report(one["motion.back_contact"] > 0.1, f"torque {torque} N m, {film}: both flanks bear")
        for name in both(LOADS + FILMS):
            # at a torque of 0 it is gear 1 that drives, and the back flanks of one pair are the driving ones of the other
            there = other[name if torque else name[5:] if name.startswith("back_") else "back_" + name]
            here = math.tan(angle) + RATIO * (math.tan(angle) - one[name]) if name.endswith("_at") else one[name]
            check(f"exchanged at {torque} N m, {film}, {name}", here, there, limits[name.split("back_")[-1] in FILMS])


def sums():
    """The mean load of the driving flanks minus that of the back flanks must be the given load; losses must add up."""
    duty = "torque: 8 N m, mesh_frequency: 1300 Hz, torque_fluctuation: {amplitude: [80 N m], order: [27], phase: [25 deg]}"
    parts = [f"losses.{part}_loss_mean" for part in ("power", "sliding", "rolling")]
    names = both(parts + ["tooth.mesh_load_mean", "film.roll_angle", "film.power_loss", "tooth.load_per_width", "tooth.gap", "tooth.radius_1", "tooth.speed_2", "tooth.roll_angle"])
    names += ["losses.efficiency", "losses.power_input", "duty.line_force", "motion.back_force_mean"]
    alone, found = (run(FIRST, duty, names, "shooting, damping_ratio: 0.15, damping: clipped, force: shared", losses=losses) for losses in ("ehl: film", "ehl: film, back: back_losses"))
    check("the mean load", found["tooth.mesh_load_mean"] - found["back_tooth.mesh_load_mean"], found["duty.line_force"], 2e-3)
    check("the mean force of back flanks", found["back_tooth.mesh_load_mean"], found["motion.back_force_mean"], 2e-3)
    for stage in "tooth", "back_tooth":
        line = found["lines"][stage, "mesh_load"]
        report(line["verdict"] == "good" and "mean force of the motion" in line["text"], f"{stage}: the line mesh_load, {line['value']:.2g}")
    back = found["motion.back_force_mean"]
    said, there = (r["lines"].get(("losses", "other_flank")) for r in (alone, found))
    report(said is not None and said["of"] == "range" and said["verdict"] == "doubtful" and '(wire these as "back")' in said["text"] and there is None, "losses without back, and only these, say what they lack")
    if said:
        check("the share of the force that the other flanks balance", said["value"], back / (back + found["duty.line_force"]), 0.01)
    for rule, verdict in (("", "good"), (", bulk_temperature: 110 degC", "good"), (", bulk_rule: standard", "doubtful"), (", thermal_conductance: 20 W/K", "doubtful")):
        line = run(FIRST, duty, names[:2], back="ehl: back_film" + rule)["lines"].get(("back_losses", "other_flank"), {"verdict": "no line", "text": ""})
        report(line["verdict"] == verdict and "opposite to those that carry" in line["text"] and ("set bulk_temperature" in line["text"]) == (verdict != "good"),
               f"of which flanks the losses are, {rule[2:] or 'teeth as warm as the oil'}: {line['verdict']}")
    for name in parts:
        check(f"{name} of both flanks", found[name], alone[name] + alone["back_" + name], 1e-11)
        report(found["back_" + name] == alone["back_" + name], f"back_{name} stays that of its flanks")
    check("the efficiency is that of both flanks", 1 - found["losses.efficiency"], found["losses.power_loss_mean"] / found["losses.power_input"], 1e-9)
    for film in "film", "back_film":
        roll, loss = found[film + ".roll_angle"], found[film + ".power_loss"]
        mean = sum(abs(z - a) * (f + g) / 2 for a, z, f, g in zip(roll, roll[1:], loss, loss[1:])) * WIDTH / (2 * math.pi / 27)
        check(f"by hand from the {film}", mean, alone[f"{'back_' if film[0] == 'b' else ''}losses.power_loss_mean"], 1e-9)
    for stage, way in ("tooth", 1), ("back_tooth", -1):
        roll, load, gap = (found[f"{stage}.{name}"] for name in ("roll_angle", "load_per_width", "gap"))
        report(all(way * (z - a) >= 0 for a, z in zip(roll, roll[1:])), f"{stage}: contact runs {'from root to tip' if way > 0 else 'from tip to root'} of gear 1")
        report(all(w == 0 or g < 1e-7 for w, g in zip(load, gap)) and max(gap) > 10e-6, f"{stage}: where it bears there is no gap")
    for name in "radius_1", "speed_2":  # at the first and the last instant of the other flank
        a, z = (found[f"{prefix}tooth.{name}"] for prefix in ("", "back_"))
        check(f"the same {name} at the same roll angle", a[0] / a[-1], z[-1] / z[0], 1e-9)


def unloaded():
    names = both(["tooth.mesh_load_mean", "film.p_max_highest", "film.h_min", "tooth.gap", "losses.power_loss_mean", "losses.flash_temperature_max"]) + ["motion.back_force_mean"]
    for torque in 100, -100:
        alone, found = (run(FIRST, f"torque: {torque} N m, mesh_frequency: 1300 Hz", names, losses=losses) for losses in ("ehl: film", "ehl: film, back: back_losses"))
        zero = ["back_tooth.mesh_load_mean", "back_film.p_max_highest", "back_losses.power_loss_mean", "back_losses.flash_temperature_max", "motion.back_force_mean"]
        report(all(found[name] == 0 for name in zero), f"torque {torque} N m: back flanks without force and loss")
        off = max(abs(h / g - 1) for h, g in zip(found["back_film.h_min"], found["back_tooth.gap"]))
        report(off < 1e-5 and min(found["back_film.h_min"]) > 50e-6, f"their film is the gap, off by {off:.2g}")
        report(all(found[name] == alone[name] for name in names), "and the losses of the others stay as they are, to the bit")
        report(("losses", "other_flank") not in alone["lines"], "which lack nothing")
    found = run(FIRST, "torque: 0 N m, mesh_frequency: 1300 Hz", names)
    report(all(found[name] == 0 for name in both(["tooth.mesh_load_mean", "losses.power_loss_mean"])), "gears that float have no force and no loss on either flank")


def refusals():
    duty, forces = "torque: 100 N m, mesh_frequency: 1300 Hz", ["back_tooth.mesh_load_mean"]
    for what, hint, text in (
            ("no backlash", "without backlash", run("teeth: [27, 52], module: 2 mm, backlash: 0 mm", duty, forces)),
            ("index deviations", "without index deviations", run(FIRST + ", pitch_error: [2 um, 1 um]", duty, forces)),
            ("a standard", "use stiffness/load-distribution", run(FIRST, duty, forces, mesh="iso-6336")),
            ("a series", "use dynamics/shooting", run(FIRST, duty, forces, "harmonic-balance")),
            ("oil", "without oil in the gap", run(FIRST, duty, forces, "shooting, squeeze: series")),
            ("the loaded error", "does not offer", run(FIRST, duty, forces, "quasi-static")),
            ("the efficiency of back flanks", "these flanks do not carry the mean load", run(FIRST, duty, ["back_losses.efficiency"])),
            ("the same flanks twice", "the loss of the same flanks", run(FIRST, duty, ["losses.power_loss_mean"], losses="ehl: film, back: again}\n  again: {use: losses/tooth-mesh, ehl: film")),
            ("a film for its losses", "name a losses stage", run(FIRST, duty, ["losses.power_loss_mean"], losses="ehl: film, back: back_film")),
            ("the tooth of the same flanks", "name a losses stage", run(FIRST, duty, ["losses.power_loss_mean"], losses="ehl: film, back: tooth")),
            ("back flanks of back flanks", "wire their losses", run(FIRST, duty, ["losses.power_loss_mean"], losses="ehl: back_film, back: again}\n  again: {use: losses/tooth-mesh, ehl: film"))):
        report(isinstance(text, str) and hint in text, f"{what}: {text if isinstance(text, str) else 'taken'}")


halves()
exchanged()
sums()
unloaded()
refusals()
sys.exit(failed)
