# SPDX-License-Identifier: GPL-3.0-or-later
"""Gears without torque, and gears whose torque or speed oscillates.

Without torque: no force, no loss, and the use of reference_torque. Oscillations: when flanks stay in contact under F + F_1 cos w t, in closed
form, and with a given speed and rigid teeth; a torque of both signs, compared with an integration in small steps; the exchanged pair; energy.

idle.py FLANKFILM SOURCE
"""
import json
import math
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


def run(outputs, torque="0 N m", motion="shooting", film="film-formula", mesh="load-distribution, compliance: analytical", more="", frequency=1900):
    text = f"""format: 2
include: [{source}/configs/lubricants/mil-l-23699.yaml]
pipeline:
  {GEARS}
  duty: {{use: operating/steady, torque: {torque}, mesh_frequency: {frequency} Hz, oil_temperature: 100 degC{more}}}
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


K, TEETH, BASE = 2e8, (27, 52), (27 * math.cos(math.radians(20)) * 1e-3, 52 * math.cos(math.radians(20)) * 1e-3)


def swing(duty, motion="shooting, damping_ratio: 0.1", gap=100e-6, names=(), mass="equivalent_mass: 0.4 kg", inertia=""):
    """Returns a motion with constant stiffness and no transmission error."""
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as table, tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        table.write(f"phase; stiffness [N/m]\n0; {K}\n1; {K}\n")
        table.flush()
        file.write(f"""format: 2
pipeline:
  gears: {{use: gear/involute-spur, module: 2 mm, face_width: 20 mm, teeth: {list(TEETH)}, backlash: {gap} m{inertia}}}
  duty: {{use: operating/steady, {duty}}}
  mesh: {{use: stiffness/table, file: {table.name}, load_share: rigid}}
  motion: {{use: dynamics/{motion}{', ' + mass if mass else ''}}}
outputs: [motion.period, motion.dte_rms, motion.contact_loss, motion.back_contact, motion.mesh_force, motion.natural_frequency,
  gears.backlash, gears.equivalent_mass, gears.inertia{''.join(', ' + name for name in names)}]
""")
        file.flush()
        answer = json.loads(subprocess.run([program, "run", file.name, "--json", "--arrays"], stdout=subprocess.PIPE).stdout)
    if answer["exit"]:
        return answer["errors"][0]["message"]
    return {name: o.get("value", o.get("data")) for name, o in answer["outputs"].items()}


def together():
    """k constant, e = 0: the deflection is F_0 + F_1 cos(w t - ..)/sqrt(D) in units of k, D = (1 - r^2)^2 + (2 zeta r)^2. Flanks stay
    together (damping: always) where it stays above 0; they never pull (clipped) where the mesh force does not."""
    zeta, frequency = 0.1, 1900
    natural = math.sqrt(K / 0.4) / (2 * math.pi)
    for order, period in (27, 1), (9, 3), (2, 27):
        r = order / 27 * frequency / natural
        D = (1 - r * r) ** 2 + (2 * zeta * r) ** 2
        for damping, share in ("always", 1 / math.sqrt(D)), ("clipped", math.sqrt((1 + (2 * zeta * r) ** 2) / D)):
            for more, stays in (1.005, True), (0.995, False):
                found = swing(f"torque: {10 * share * more} N m, mesh_frequency: {frequency} Hz, torque_fluctuation: {{amplitude: [10 N m], order: [{order}]}}",
                              f"shooting, damping_ratio: {zeta}, damping: {damping}")
                what = f"order {order}, {damping}, {more} of the limit"
                report((found["motion.contact_loss"] == 0) == stays, f"{what}: {'together' if stays else 'apart'}")
                if stays:
                    report(found["motion.period"] == period, f"{what}: period {period}")
                    check(f"{what}: rms", found["motion.dte_rms"], 10 / BASE[0] / K / math.sqrt(2 * D), 1e-9)


def driven():
    """Stiff teeth and a given speed of gear 1: they stay in contact if drag slows gear 2 at least as fast as gear 1 slows down."""
    inertia, rpm, order = 1e-2, 600, 2
    omega, most = rpm * math.pi / 30, 20 * math.pi / 30
    slowing = most * order * omega
    for more, stays in (1.02, True), (0.98, False):
        drag = inertia * BASE[0] / BASE[1] * slowing * more  # on gear 2
        found = swing(f"torque: {drag * TEETH[0] / TEETH[1]} N m, speed: {rpm} rpm, speed_fluctuation: {{amplitude: [20 rpm], order: [{order}]}}",
                      "shooting, damping_ratio: 0.5", mass="", inertia=f", inertia: [1e-2 kg m2, {inertia} kg m2]")
        report((found["motion.contact_loss"] == 0) == stays, f"a drag of {more} of the limit: {'together' if stays else 'apart'}")
        check("the mass that swings is that of gear 2", found["motion.natural_frequency"], math.sqrt(K * BASE[1] ** 2 / inertia) / (2 * math.pi), 1e-9)


def twin(mean, swings, frequency, zeta, half_gap, cycles, steps=4000):
    """rms of s and least and largest mesh force by Runge and Kutta's method, after a tenth of the cycles; swings: (N, order, rad)."""
    m, c = 0.4, 2 * zeta * math.sqrt(K * 0.4)

    def force(s, v):
        over = abs(s) - half_gap
        return (math.copysign(K * over, s) if over > 0 else 0) + c * v

    def rate(t, s, v):
        return (mean + sum(a * math.cos(2 * math.pi * n / TEETH[0] * frequency * t + p) for a, n, p in swings) - force(s, v)) / m
    s, v, h, sums, low, high = half_gap, 0, 1 / frequency / steps, [0, 0, 0], 0, 0
    begin = cycles - TEETH[0]
    for i in range(cycles * steps):
        t = i * h
        a1 = rate(t, s, v)
        a2 = rate(t + h / 2, s + h / 2 * v, v + h / 2 * a1)
        a3 = rate(t + h / 2, s + h / 2 * v + h * h / 4 * a1, v + h / 2 * a2)
        a4 = rate(t + h, s + h * v + h * h / 2 * a2, v + h * a3)
        s, v = s + h * v + h * h / 6 * (a1 + a2 + a3), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
        if i >= begin * steps:
            f = force(s, v)
            sums = [sums[0] + 1, sums[1] + s, sums[2] + s * s]
            low, high = min(low, f), max(high, f)
    return math.sqrt(sums[2] / sums[0] - (sums[1] / sums[0]) ** 2), low, high


def both_signs():
    """A torque that changes sign must load both flanks alternately."""
    duty = "torque: 4 N m, mesh_frequency: 6000 Hz, torque_fluctuation: {amplitude: [30 N m, 12 N m], order: [1, 2], phase: [0 deg, 70 deg]}"
    expected = twin(4 / BASE[0], [(30 / BASE[0], 1, 0), (12 / BASE[0], 2, math.radians(70))], 6000, 0.3, 10e-6, 81, 400)
    for motion in "shooting", "time-integration":
        powers = ("motion.torque_power", "motion.damper_loss", "motion.excitation_power") if motion == "shooting" else ()
        found = swing(duty, f"{motion}, damping_ratio: 0.3", 20e-6, ("motion.tooth_force", "motion.phase") + powers)
        if powers:
            check("the damper takes what the torque swings in", found[powers[0]] + found[powers[2]], found[powers[1]], 1e-9)
            report(found[powers[0]] > 100 * abs(found[powers[2]]), "since neither k nor e changes")
        report(found["motion.period"] == 27 and found["motion.back_contact"] > 0.1, f"{motion}: both flanks bear, period {found['motion.period']}")
        check(f"{motion}: rms of the twin", found["motion.dte_rms"], expected[0], 1e-3)
        check(f"{motion}: its least force", min(found["motion.mesh_force"]), expected[1], 2e-3)
        check(f"{motion}: its largest", max(found["motion.mesh_force"]), expected[2], 2e-3)
        force, phase = found["motion.mesh_force"], found["motion.phase"]
        mean = sum((z - a) * (f + g) / 2 for a, z, f, g in zip(phase, phase[1:], force, force[1:])) / phase[-1]
        check(f"{motion}: its mean is the line force", mean, 4 / BASE[0], 1e-5)
        teeth = flat(found["motion.tooth_force"])
        report(len(teeth) % 27 == 0 and min(teeth) < -0.5 * max(teeth), f"{motion}: tooth forces of 27 pairs, {min(teeth):.0f} to {max(teeth):.0f} N, below 0 on the back flanks")
    report("use dynamics/shooting" in swing(duty, "harmonic-balance"), "a series of the mesh cycle is refused")
    report("use dynamics/shooting" in swing(duty, "quasi-static", mass=""), "and the loaded error")


def folds():
    """Negligible oscillations must not change a motion and its folds, whatever their period in mesh cycles."""
    names = ["motion.fold_frequency", "motion.dte_harmonics", "motion.dte_rms"]
    none, *others = (run(names, "20 N m", "shooting, damping_ratio: 0.02, max_period: 1",
                         more=f", torque_fluctuation: {{amplitude: [1e-7 N m], order: [{order}]}}" if order else "") for order in (0, 27, 9))
    report(len(none["motion.fold_frequency"]) >= 4, f"{len(none['motion.fold_frequency'])} folds")
    for period, found in zip((1, 3), others):
        check(f"period {period}: rms", found["motion.dte_rms"], none["motion.dte_rms"], 1e-8)
        off = max(abs(a / b - 1) for a, b in zip(found["motion.dte_harmonics"], none["motion.dte_harmonics"]))
        report(off < 1e-6, f"period {period}: harmonics of the mesh frequency, off by {off:.2g}")
        off = max(min(abs(a / b - 1) for a in found["motion.fold_frequency"]) for b in none["motion.fold_frequency"])
        report(off < 1e-6, f"period {period}: each fold is there, off by {off:.2g}")


def small_torque():
    """With nearly no mean load, the scale of a motion's errors must come from the oscillation."""
    one, other = (swing(f"torque: {torque} N m, mesh_frequency: 3000 Hz, torque_fluctuation: {{amplitude: [10 N m], order: [27]}}",
                        "shooting, damping_ratio: 0.05, max_period: 1, atlas: {from: 1000 Hz, to: 6000 Hz}", 1e-7, ["motion.atlas_rms"]) for torque in (1e-3, 1))
    check("the atlas goes on to its resonance under a torque of next to nothing", max(one["motion.atlas_rms"]), max(other["motion.atlas_rms"]), 1e-3)


def landing():
    """Oil between the flanks with a negligible oscillation: tooth pairs, radii and speeds must be equal in each of the three mesh cycles."""
    names = ["motion.squeeze_loss", "motion.dte_rms", "motion.period", "motion.contact_loss"]
    for rolling in "true", "false":
        one, three = (run(names, "30 N m", f"shooting, damping_ratio: 0.01, squeeze: series, squeeze_rolling: {rolling}, handover_film: 0.5 um",
                          more=f", torque_fluctuation: {{amplitude: [1e-7 N m], order: [{order}]}}", frequency=3000) for order in (27, 9))
        report(three["motion.period"] == 3 * one["motion.period"] and one["motion.contact_loss"] > 0.2, f"squeeze_rolling {rolling}: {three['motion.period']:g} mesh cycles")
        for name in names[:2]:
            check(f"squeeze_rolling {rolling}: {name}", three[name], one[name], 1e-6)


def exchanged():
    """Gear 2 written first: the same motion, its swings those of the other gear. Their angle counts from a pair at the start of the profile of
    gear 1, which with a torque below 0 is its end: the contact ratio apart."""
    names = ["gears.contact_ratio", "motion.dte_rms", "motion.mesh_force", "motion.dynamic_factor_mesh", "losses.power_loss_mean", "film.h_min_lowest"]

    def pair(first, second, torque, swings, order, phase):
        global GEARS
        GEARS = (f"gears: {{use: gear/involute-spur, module: 2 mm, face_width: 20 mm, centre_distance: 81 mm, teeth: [{first}, {second}], "
                 f"profile_shift: [{'0.5, 0.55' if first < second else '0.55, 0.5'}], backlash: 0.1 mm, stations: 6000, "
                 f"{'tip_relief: 12 um, back_relief' if first < second else 'back_relief: 12 um, tip_relief'}: [{'10 um, 15 um' if first < second else '15 um, 10 um'}]}}")
        return run(names, f"{torque} N m", mesh="load-distribution, compliance: analytical, points: 6000",
                   more=f", torque_fluctuation: {{amplitude: [{swings} N m], order: [{order}], phase: [{phase} deg]}}")
    one = pair(27, 52, -30, 12, 27, 40)
    other = pair(52, 27, 30 * 52 / 27, 12 * 52 / 27, 52, math.remainder(40 - 180 - 360 * one[names[0]], 360))
    for name in names[1:]:
        limit = 1e-3 if name.startswith("film") else 1e-4
        check(f"exchanged, {name}", *(max(map(abs, flat(x[name] if isinstance(x[name], list) else [x[name]]))) for x in (one, other)), limit)


def idle():
    """The file in configs/: compared with an integration in small steps, and its energy balance."""
    found = []
    for motion in "shooting", "time-integration":
        names = "motion.period, motion.dte_rms, motion.back_contact" + (", motion.torque_power, motion.damper_loss, motion.excitation_power" if motion == "shooting" else "")
        done = subprocess.run([program, "run", source + "/configs/idle.yaml", "--json", "--set", f"motion.use=dynamics/{motion}", "--set", f"outputs=[{names}]"], stdout=subprocess.PIPE)
        answer = json.loads(done.stdout)
        found.append({name: o["value"] for name, o in answer["outputs"].items()})
    report(all(x["motion.period"] == 27 and x["motion.back_contact"] > 0.05 for x in found), "idle.yaml rattles on both flanks, with period 27")
    check("idle.yaml by small steps", found[1]["motion.dte_rms"], found[0]["motion.dte_rms"], 1e-6)
    check("what swings and mesh bring in the damper takes", found[0]["motion.torque_power"] + found[0]["motion.excitation_power"], found[0]["motion.damper_loss"], 1e-9)


def wrong():
    for more, hint in ((", torque_fluctuation: {amplitude: [1 N m, 2 N m], order: [1]}", "one order for each"), (", speed_fluctuation: {order: [1]}", "one order for each"),
                       (", torque_fluctuation: {amplitude: [1 N m], order: [1.5]}", "whole"),
                       (", speed_fluctuation: {amplitude: [3000 rpm, 2000 rpm], order: [1, 2]}", "must not turn back")):
        text = run(["motion.dte_rms"], "90 N m", more=more)
        report(isinstance(text, str) and hint in text, f"{more[2:]}: {text if isinstance(text, str) else 'taken'}")


def floats():
    for motion in "shooting", "time-integration", "harmonic-balance", "quasi-static":
        found = run(FLOATING, motion=motion)
        report("floating" in found["lines"] and "float" in found["lines"]["floating"]["text"], f"{motion}: says that the gears float")
        report(all(largest(found[name]) == 0 for name in FLOATING[:-1]), f"{motion}: stands still without force")
        report(abs(largest(found["motion.gap"]) / 50e-6 - 1) < 0.31, f"{motion}: in the middle of the backlash")
    for film in "film-formula", "inlet-analysis", "finite-volume, thermal: full", "dense-newton", "control-volume":
        found = run(LOST, film=film)
        report(found["film.h_min_lowest"] > 30e-6 and all(largest(found[name]) == 0 for name in LOST[1:]), f"{film}: the gap, without pressure and loss")
    report("transmit no power" in run(["losses.efficiency"]), "an efficiency is refused")
    report("nothing to rate" in run(["scuffing.margin"]), "a rating is refused")
    report("there is no branch" in run(["motion.fold_frequency"]), "an atlas is refused")


def reference():
    """The force at which stiffness, natural frequency and load fractions are computed."""
    names = ["motion.natural_frequency", "mesh.stiffness_mean", "mesh.load_share", "mesh.force_level"]
    loaded, at_rest = run(names, "90 N m"), run(names, more=", reference_torque: 90 N m")
    for name in names:
        report(loaded[name] == at_rest[name], f"{name} of the reference torque")
    names = ["mesh.stiffness_mean", "mesh.load_share"]
    swings = run(names, more=", torque_fluctuation: {amplitude: [30 N m, 60 N m], order: [1, 3]}")
    for name in names:
        check(f"of swings about 0 it is the largest torque, {name}", sum(flat([swings[name]])), sum(flat([loaded[name]])), 1e-8)
    names = ["motion.dte_rms", "mesh.tooth_force"]
    same, other = run(names, "90 N m"), run(names, "90 N m", more=", reference_torque: 180 N m")
    report(run(names, "90 N m", more=", reference_torque: 90 N m") == same, "the torque itself is the preset")
    report(abs(other["motion.dte_rms"] / same["motion.dte_rms"] - 1) > 1e-3, "another one is another stiffness")
    check("its shares are of the load", max(other["mesh.tooth_force"]), max(same["mesh.tooth_force"]), 0.02)
    damped = ["shooting, damping_ratio: 0.3", ", torque_fluctuation: {amplitude: [60 N m], order: [2]}"]
    at_rest, near, held, beyond = (run(names[:1], f"{torque} N m", damped[0], more=damped[1]) for torque in (0, 1e-3, 59.999, 60.001))
    check("a swing about 0 and one about next to 0 are alike", near["motion.dte_rms"], at_rest["motion.dte_rms"], 1e-3)
    check("so are those whose torque just reaches 0, and just does not", held["motion.dte_rms"], beyond["motion.dte_rms"], 1e-3)
    swings = run(["mesh.force_level", "duty.largest_force"], "4 N m", more=", reference_torque: 4 N m, torque_fluctuation: {amplitude: [60 N m], order: [2]}")
    levels = swings["mesh.force_level"]
    check("the levels hold what the torque swings to", levels[-1], 1.2 * swings["duty.largest_force"], 1e-10)
    check("and the mean", levels[3] / levels[-1], 4 / (1.2 * 64), 1e-10)
    report("leave reference_torque" in run(["motion.dte_rms"], "90 N m", "quasi-static", more=", reference_torque: 180 N m"), "no error of another load")
    report("reference_torque of the operating stage" in run(["motion.dte_rms"], motion="shooting", mesh="iso-6336"), "a standard that needs a load names it")


floats()
reference()
together()
driven()
both_signs()
idle()
wrong()
folds()
small_torque()
landing()
exchanged()
sys.exit(failed)
