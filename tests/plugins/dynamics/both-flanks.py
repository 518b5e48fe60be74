# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh force of both signs, with separate stiffness, transmission error and relief of the back flanks.

Equal gears under a torque that oscillates about 0 once in a mesh cycle: the second half of the motion must mirror the first.
Unequal gears with unequal reliefs on all four flanks: the exchanged pair must have the same motion. An integration in small steps,
with the curves of the stiffness, must agree. The data of a flank without load must not change any bit.

both-flanks.py FLANKFILM SOURCE
"""
import bisect
import json
import math
import subprocess
import sys
import tempfile

program, source = sys.argv[1:]
failed = False
EQUAL = "teeth: [50, 50], module: 3 mm, pressure_angle: 20 deg, face_width: 20 mm, backlash: 0.04 mm, tip_relief: 12 um"
FIRST = ("teeth: [27, 52], module: 2 mm, face_width: 20 mm, centre_distance: 81 mm, profile_shift: [0.5, 0.55], backlash: 0.06 mm, stations: 2000, "
         "tip_relief: [18 um, 22 um], tip_relief_length: [2.1 mm, 1.8 mm], back_relief: [9 um, 14 um], back_relief_length: [1.6 mm, 1.9 mm]")
OTHER = ("teeth: [52, 27], module: 2 mm, face_width: 20 mm, centre_distance: 81 mm, profile_shift: [0.55, 0.5], backlash: 0.06 mm, stations: 2000, "
         "tip_relief: [14 um, 9 um], tip_relief_length: [1.9 mm, 1.6 mm], back_relief: [22 um, 18 um], back_relief_length: [1.8 mm, 2.1 mm]")
RATIO = 27 / 52


def report(good, text):
    global failed
    failed = failed or not good
    print(f"{'ok' if good else 'FAIL'} {text}")


def check(what, found, expected, limit):
    off = abs(found / expected - 1)
    report(off <= limit, f"{what}: off by {off:.2g}, at most {limit:g}")


def run(gears, duty, motion, outputs, mesh="points: 400"):
    text = f"""format: 2
pipeline:
  gears: {{use: gear/involute-spur, {gears}}}
  duty: {{use: operating/steady, {duty}}}
  mesh: {{use: stiffness/load-distribution, compliance: analytical, {mesh}}}
  motion: {{use: dynamics/{motion}}}
outputs: [{', '.join(outputs)}]
"""
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write(text)
        file.flush()
        done = subprocess.run([program, "run", file.name, "--json", "--arrays"], stdout=subprocess.PIPE, timeout=100)
    answer = json.loads(done.stdout)
    if answer["exit"]:
        sys.exit(f"{motion}, {gears}: {answer['errors']}")
    found = {name: o.get("value", o.get("data")) for name, o in answer["outputs"].items()}
    found["lines"] = {name: line for stage in answer["stages"] for name, line in stage["quality"].items()}
    return found


def series(phase, value):
    """Returns a function of the phase, linear between the points, with the values after jumps."""
    def at(x):
        i = min(max(bisect.bisect_right(phase, x) - 1, 0), len(phase) - 2)
        return value[i] + (value[i + 1] - value[i]) * (x - phase[i]) / (phase[i + 1] - phase[i])
    return at


CURVES = ["stiffness", "transmission_error"]


def phases():
    """Equation (5) of the theory: for equal gears, the flanks differ by half a cycle; for unequal gears, the back flanks have the curves of the exchanged pair's driving flanks."""
    names = ["mesh.phase", "mesh.back_phase", "mesh.back_offset"] + [f"mesh.{b}{name}" for name in CURVES for b in ("", "back_")]
    found = run(EQUAL, "torque: 100 N m, mesh_frequency: 1000 Hz", "quasi-static", names)
    places = [0.013 + 0.05 * i for i in range(20)]
    for name in CURVES:
        driving, back = series(found["mesh.phase"], found["mesh." + name]), series(found["mesh.back_phase"], found["mesh.back_" + name])
        size = max(found["mesh." + name])
        off = max(abs(back(x) - driving((x + 0.5) % 1)) for x in places) / size
        report(off < 1e-5, f"equal gears, {name}: half a cycle apart, off by {off:.2g}")
    one = run(FIRST, "torque: 90 N m, mesh_frequency: 1000 Hz", "quasi-static", names)
    other = run(OTHER, f"torque: {90 / RATIO} N m, mesh_frequency: 1000 Hz", "quasi-static", names + ["gears.contact_ratio"])
    # back flanks begin at the tip of gear 1, where their age along it is the contact ratio and the phase is back_offset less that
    turn = other["gears.contact_ratio"] - one["mesh.back_offset"]
    for name in CURVES:
        for first, second in (("", "back_"), ("back_", "")):
            here = series(one[f"mesh.{first}phase"], one[f"mesh.{first}{name}"])
            there = series(other[f"mesh.{second}phase"], other[f"mesh.{second}{name}"])
            size = max(map(abs, one[f"mesh.{first}{name}"]))
            off = max(abs(here(x) - there((x + turn) % 1)) for x in places) / size
            report(off < 2e-3, f"exchanged, {first}{name} is {second}{name}, off by {off:.2g}")


def halves():
    for motion in "shooting", "time-integration":
        for more in "damping: always", "damping: contact", "damping: contact, force: shared":
            found = run(EQUAL, "torque: 0 N m, mesh_frequency: 900 Hz, torque_fluctuation: {amplitude: [400 N m], order: [50]}",
                        f"{motion}, damping_ratio: 0.3, {more}, steps_per_cycle: 200",
                        ["motion.phase", "motion.dte", "motion.mesh_force", "motion.back_contact", "motion.contact_loss", "motion.dte_mean", "motion.dte_rms", "motion.period"])
            what = f"{motion}, {more}"
            report(found["motion.back_contact"] > 0.2 and found["motion.contact_loss"] > 0.02 and found["motion.period"] == 1, f"{what}: both flanks bear in each cycle")
            for name in "dte", "mesh_force":
                at, size = series(found["motion.phase"], found["motion." + name]), max(map(abs, found["motion." + name]))
                off = max(abs(at(i / 200 + 0.5) + at(i / 200)) for i in range(1, 100)) / size
                report(off < 2e-5, f"{what}: the second half of {name} mirrors the first, off by {off:.2g}")
            report(abs(found["motion.dte_mean"]) < 1e-6 * found["motion.dte_rms"], f"{what}: the mean is the middle of the gap")
            report(found["lines"]["back_flank"]["verdict"] == "good" and "their own" in found["lines"]["back_flank"]["text"], f"{what}: says so")


def exchanged():
    """Exchanged gears. The phase of the oscillation refers to a tooth pair at the start of gear 1's profile, the end of gear 2's."""
    names = ["gears.contact_ratio", "motion.dte_rms", "motion.dte_peak_to_peak", "motion.dynamic_factor_mesh", "motion.back_contact", "motion.contact_loss", "motion.floquet_max"]
    for motion in "shooting, damping: contact", "shooting, damping: always", "time-integration, damping: contact", "shooting, damping: contact, force: shared":
        def swing(gears, torque, order, phase):
            return run(gears, f"torque: {torque} N m, mesh_frequency: 1300 Hz, torque_fluctuation: {{amplitude: [{abs(torque) * 9} N m], order: [{order}], phase: [{phase} deg]}}",
                       f"{motion}, damping_ratio: 0.15", names, mesh="points: 3000")
        one = swing(FIRST, -10, 27, 40)
        other = swing(OTHER, 10 / RATIO, 52, math.remainder(40 - 180 - 360 * one[names[0]], 360))
        report(one["motion.back_contact"] > 0.1, f"{motion}: both flanks bear, the back one for {one['motion.back_contact']:.3f} of the time")
        for name in names[1:-1]:
            check(f"exchanged, {motion}, {name}", one[name], other[name], 1e-4)


def twin():
    """Integrates the equation with linear springs of both flanks by Runge and Kutta's method."""
    names = ["mesh.phase", "mesh.back_phase"] + [f"mesh.{b}{name}" for name in CURVES for b in ("", "back_")]
    names += ["gears.equivalent_mass", "gears.backlash", "duty.line_force", "mesh.stiffness_mean", "motion.dte_rms", "motion.dte_mean", "motion.mesh_force", "motion.back_contact"]
    found = run(FIRST, "torque: 8 N m, mesh_frequency: 1300 Hz, torque_fluctuation: {amplitude: [80 N m], order: [27], phase: [25 deg]}",
                "shooting, damping_ratio: 0.15, damping: contact", names, mesh="points: 400, definition: secant")
    steps, cycles, m, b = 6000, 12, found["gears.equivalent_mass"], found["gears.backlash"] / 2
    F, c = found["duty.line_force"], 2 * 0.15 * math.sqrt(found["mesh.stiffness_mean"] * found["gears.equivalent_mass"])
    flanks = []
    for back in "", "back_":
        k, e = (series(found[f"mesh.{back}phase"], found[f"mesh.{back}{name}"]) for name in CURVES)
        at = [(i % (2 * steps)) / (2 * steps) for i in range(2 * steps)]
        flanks.append([[k(x) for x in at], [e(x) for x in at], [(e(min(x + 1e-6, 1)) - e(max(x - 1e-6, 0))) / 2e-6 * 1300 for x in at]])

    def force(i, s, v):
        total = 0
        for sign, (k, e, slope) in zip((1, -1), flanks):
            over = sign * s - e[i] - b
            if over > 0:
                total += sign * (k[i] * over + c * (sign * v - slope[i]))
        return total

    def rate(n, s, v):
        i = n % (2 * steps)
        return (F * (1 + 10 * math.cos(2 * math.pi * n / (2 * steps) + math.radians(25))) - force(i, s, v)) / m
    s, v, h, sums, low, high = b, 0, 1 / 1300 / steps, [0, 0, 0], 0, 0
    for n in range(cycles * steps):
        a1 = rate(2 * n, s, v)
        a2 = rate(2 * n + 1, s + h / 2 * v, v + h / 2 * a1)
        a3 = rate(2 * n + 1, s + h / 2 * v + h * h / 4 * a1, v + h / 2 * a2)
        a4 = rate(2 * n + 2, s + h * v + h * h / 2 * a2, v + h * a3)
        s, v = s + h * v + h * h / 6 * (a1 + a2 + a3), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
        if n >= (cycles - 1) * steps:
            sums = [sums[0] + 1, sums[1] + s, sums[2] + s * s]
            f = force((2 * n + 2) % (2 * steps), s, v)
            low, high = min(low, f), max(high, f)
    report(found["motion.back_contact"] > 0.1, f"the twin's motion bears on back flanks for {found['motion.back_contact']:.3f} of the time")
    check("twin: rms", math.sqrt(sums[2] / sums[0] - (sums[1] / sums[0]) ** 2), found["motion.dte_rms"], 3e-4)
    check("twin: least force", low, min(found["motion.mesh_force"]), 3e-3)
    check("twin: largest force", high, max(found["motion.mesh_force"]), 3e-3)


def steps():
    """Exact steps and small ones pass from track to track, each with a derivation of its own: the motion and how fast disturbances die out."""
    names = ["motion.floquet_max", "motion.back_contact", "motion.contact_loss", "motion.dte_rms"]
    for damping in "always", "contact", "clipped":
        one, other = (run(FIRST, "torque: 10 N m, mesh_frequency: 1300 Hz, torque_fluctuation: {amplitude: [60 N m], order: [27], phase: [25 deg]}",
                          f"{motion}, damping_ratio: 0.1, damping: {damping}", names) for motion in ("shooting", "time-integration"))
        for name in names:
            check(f"damping: {damping}, by small steps, {name}", other[name], one[name], 1e-6)
        for found in one, other:
            for line in "energy_balance", "determinant":
                report(abs(found["lines"][line]["value"]) < 1e-11, f"damping: {damping}, {line} {found['lines'][line]['value']:.2g}")
    # without error of the driving flanks, a separation is one step unless it ends at the nodes of the back flanks
    gears = "teeth: [27, 52], module: 2 mm, face_width: 20 mm, backlash: 0.004 mm, back_relief: [40 um, 30 um], back_relief_length: [3.2 mm, 2.9 mm]"
    one, other = (run(gears, "torque: 30 N m, mesh_frequency: 5600 Hz", f"{motion}, damping_ratio: 0.05, damping: contact, branch: upper", names, "points: 100")
                  for motion in ("shooting", "time-integration"))
    report(one["motion.back_contact"] > 0.3, "a motion that lands on back flanks in each cycle")
    for name in names:
        check(f"nodes of the other flank, {name}", other[name], one[name], 1e-6)


def shares():
    """At every phase the pairs carry the mesh force: driving flanks where it is above 0, back flanks, each at its own age, where it is below."""
    for force in "frozen", "shared":
        found = run(FIRST, "torque: 8 N m, mesh_frequency: 1300 Hz, torque_fluctuation: {amplitude: [80 N m], order: [27], phase: [25 deg]}",
                    f"shooting, damping_ratio: 0.15, damping: contact, force: {force}, steps_per_cycle: 1000",
                    ["motion.phase", "motion.mesh_force", "motion.tooth_force", "motion.back_tooth_force", "gears.roll_angle", "gears.roll_sap", "mesh.back_offset", "motion.period"])
        roll = [(x - found["gears.roll_sap"]) * 27 / (2 * math.pi) for x in found["gears.roll_angle"]]
        mesh, largest = series(found["motion.phase"], found["motion.mesh_force"]), max(map(abs, found["motion.mesh_force"]))
        driving, back = series(roll, found["motion.tooth_force"]), series(roll, found["motion.back_tooth_force"])
        worst, seen = 0, [0, 0]
        for i in range(400):
            x = (i + 0.5) / 400
            ages = [x + n for n in range(3) if x + n < roll[-1]]
            backs = [a + n for a in ((found["mesh.back_offset"] - x) % 1,) for n in range(3) if a + n < roll[-1]]
            sums = sum(map(driving, ages)), -sum(map(back, backs))
            if abs(mesh(x + 2e-3) - mesh(x - 2e-3)) > 0.03 * largest:
                continue  # flanks touch or separate, or the number of tooth pairs changes
            worst = max(worst, min(map(abs, sums)) / largest, abs(sum(sums) - mesh(x)) / largest)
            seen[sums[0] == 0] += abs(mesh(x)) > 0.02 * largest
        report(min(seen) > 15 and worst < 5e-3, f"{force}: pairs carry the mesh force at {seen[0]} phases on driving and {seen[1]} on back flanks, off by {worst:.2g}")
    report(found["motion.period"] == 1, "over one mesh cycle")


def unloaded():
    """A motion that loses contact, and touches again on the driving flanks only."""
    names = ["motion.dte", "motion.mesh_force", "motion.floquet_max", "motion.contact_loss", "motion.back_contact", "motion.landing_speed"]
    for motion in "shooting", "time-integration":
        # back flanks with 1 and 30 um of relief; equal reliefs of the driving flanks
        one, other = (run(EQUAL.replace("0.04 mm", "0.3 mm") + f", back_relief: {amount} um", "torque: 100 N m, mesh_frequency: 2350 Hz", f"{motion}, branch: upper", names)
                      for amount in (1, 30))
        report(one["motion.contact_loss"] > 0.05 and one["motion.back_contact"] == 0, f"{motion}: contact is lost for {one['motion.contact_loss']:.2f} of the time")
        report(all(one[name] == other[name] for name in names), f"{motion}: not a bit depends on flanks that never bear")


def deviations():
    """With index deviations, there are no curves for the back flanks: a motion that never touches them needs none."""
    for motion in "shooting", "time-integration", "shooting, force: shared":
        found = run(FIRST + ", pitch_error: [2 um, 1 um]", "torque: 100 N m, mesh_frequency: 900 Hz", motion + ", damping_ratio: 0.1", ["motion.dte_rms"])
        report(found["motion.dte_rms"] > 0, f"{motion}: index deviations")


def one_relief():
    """Gears with relief on one flank only: its transmission error differs from that of the other flank, which is 0."""
    plain = "teeth: [27, 52], module: 2 mm, face_width: 20 mm"
    names = ["mesh.transmission_error", "mesh.back_transmission_error", "motion.dte_rms"]
    for relief, relieved in (("back_relief: [25 um, 8 um], back_relief_length: [3.2 mm, 2.9 mm]", 1), ("tip_relief: [25 um, 8 um], tip_relief_length: [3.2 mm, 2.9 mm], back_relief: 0 um", 0)):
        found = run(f"{plain}, {relief}", "torque: 100 N m, mesh_frequency: 900 Hz", "shooting, damping_ratio: 0.1", names)
        report(max(found[names[1 - relieved]]) == 0 and found["motion.dte_rms"] > 0 and len(found[names[relieved]]) > 2, f"{relief[:11]} alone")
    # the forces at which the stiffness is known lie too far apart for relieved flanks, whichever these are: 0.098 and 0.094
    for driving, back in ("30 um", "0 um"), ("0 um", "30 um"):
        found = run("teeth: [27, 52], module: 2 mm, face_width: 20 mm, centre_distance: 81 mm, profile_shift: [0.5, 0.55], backlash: 0.06 mm, "
                    f"tip_relief: {driving}, tip_relief_length: 2 mm, back_relief: {back}, back_relief_length: 2 mm",
                    "torque: 8 N m, mesh_frequency: 1300 Hz, torque_fluctuation: {amplitude: [60 N m], order: [27]}",
                    "shooting, damping_ratio: 0.15, damping: contact, force: shared", ["motion.back_contact"], "points: 100")
        told = found["lines"]["force_levels"]
        report(told["value"] > 0.05 and told["verdict"] == "doubtful", f"relief of {driving} and {back}: force_levels {told['value']:.2g}")


phases()
one_relief()
deviations()
halves()
exchanged()
twin()
steps()
shares()
unloaded()
sys.exit(failed)
