# SPDX-License-Identifier: GPL-3.0-or-later
"""Stages after a motion with `force: shared`: they use its tooth forces as those of any motion.

configs/relief-under-load.yaml, unchanged, with a pitch error of one tooth of 25, and with three tooth pairs in contact: at every phase, the
forces of the pairs must add up to the mesh force, and be those of the stiffness's levels at this force; the contact must pass them on; loss
and ratings must differ from those with the load fractions at the mean load. A pitch error has a period of 25 mesh cycles, which the motion does
not have: the mesh must report this. In a loop, a film with a fixed number of steps must converge; a film that chooses its steps in each round
must be named as the reason if the loop does not converge.

shared-chain.py FLANKFILM SOURCE
"""
import bisect
import json
import subprocess
import sys

program, source = sys.argv[1:3]
failed = False
CASES = {
    "as it is": [],
    "a tooth that stands out": ["gears.pitch_error=[6 um]"],
    "three pairs": ["gears.teeth=[50, 61]", "gears.module=2 mm", "gears.tip_diameter=[105.4 mm, 127.4 mm]", "gears.dedendum=1.6",
                    "gears.tip_relief=[10 um, 12 um]", "gears.tip_relief_length=[0.8 mm, 0.7 mm]"],
}


def answer_of(sets, outputs):
    words = [program, "run", f"{source}/configs/relief-under-load.yaml", "--json", "--arrays"]
    for one in ["mesh.compliance=analytical", f"outputs=[{outputs}]"] + sets:
        words += ["--set", one]
    return json.loads(subprocess.run(words, stdout=subprocess.PIPE).stdout)


def run(sets, outputs):
    answer = answer_of(sets, outputs)
    if answer["exit"]:
        sys.exit(f"{sets}: {answer['errors']}")
    quality = {name: line for stage in answer["stages"] for name, line in stage["quality"].items()}
    return {name: o.get("value", o.get("data")) for name, o in answer["outputs"].items()}, quality


def check(good, text):
    global failed
    failed = failed or not good
    print(f"{'ok' if good else 'FAIL'} {text}")


def at(x, y, where, behind=True):
    i = (bisect.bisect_right if behind else bisect.bisect_left)(x, where) - 1
    i = min(max(i, 0), len(x) - 2)
    span = x[i + 1] - x[i]
    return y[i] + (y[i + 1] - y[i]) * min(max((where - x[i]) / span, 0), 1) if span > 0 else y[i + 1]


ARRAYS = ("gears.roll_angle, gears.roll_sap, gears.teeth, gears.face_width, gears.contact_ratio, duty.line_force, mesh.force_level, "
          "mesh.level_tooth_force, motion.phase, motion.mesh_force, motion.tooth_force, tooth.load_per_width")
shared_rms = run([], "motion.dte_rms")[0]["motion.dte_rms"]
ENDS = "losses.power_loss_mean, losses.contact_temperature_max, film.h_min_lowest, scuffing.own_contact_temperature_max"
for case, sets in CASES.items():
    x, quality = run(sets, ARRAYS)
    pitch, F = 6.283185307179586 / x["gears.teeth"][0], x["duty.line_force"]
    age = [(r - x["gears.roll_sap"]) / pitch for r in x["gears.roll_angle"]]
    W, n = x["motion.tooth_force"], len(age)
    level, rows = x["mesh.force_level"], x["mesh.level_tooth_force"]
    rows = rows if isinstance(rows[0], list) else [rows[k * n:(k + 1) * n] for k in range(len(level))]


    def wrong(i):
        force = at(x["motion.phase"], x["motion.mesh_force"], age[i] % 1)
        return W[i] - at(level, [row[i] for row in rows], F) * force / F

    off = 0
    for i in range(200):
        phase = (i + 0.5) / 200
        if min(abs(phase - a % 1) for a in (0, x["gears.contact_ratio"])) < 0.02:
            continue  # a corner of the gap ends in a steep rise, which few stations have
        there = sum(at(age, W, phase + k) for k in range(4) if phase + k < x["gears.contact_ratio"])
        off = max(off, abs(there - at(x["motion.phase"], x["motion.mesh_force"], phase)) / F)
    check(off < 0.01, f"{case}: the pairs bear the mesh force, off by {off:.1e} of F")
    worst = max(range(1, n - 1), key=lambda i: abs(wrong(i)) if abs(age[i + 1] - age[i]) > 1e-9 < abs(age[i] - age[i - 1]) else 0)
    force = at(x["motion.phase"], x["motion.mesh_force"], age[worst] % 1)
    there = run(sets + [f"duty.torque={250 * force / F} N m"], "mesh.tooth_force, gears.roll_angle")[0]["mesh.tooth_force"][worst]
    off, frozen = abs(W[worst] - there) / F, abs(at(level, [row[worst] for row in rows], F) * force / F - there) / F
    check(off < min(0.004, frozen / 3), f"{case}: under {force / F:.3f} F the pair at {age[worst]:.3f} bears {there / F:.4f} F, off by "
          f"{off:.1e} of F, by {frozen:.1e} with the share of the mean load")
    passed = max(x["tooth.load_per_width"]) * x["gears.face_width"]
    check(abs(passed / max(W) - 1) < 2e-3, f"{case}: largest load of the contact {passed:.6g} N, of the motion {max(W):.6g} N")
    check(("index_excitation" in quality and quality["index_excitation"]["verdict"] == "doubtful") == ("stands" in case),
          f"{case}: index_excitation")
    if not sets:
        shared, frozen = run([], ENDS)[0], run(["motion.force=frozen"], ENDS)[0]
        for name in shared:
            check(abs(shared[name] / frozen[name] - 1) > 1e-5, f"{name}: {shared[name]:.8g}, frozen {frozen[name]:.8g}")
BACK = ["film.use=ehl/finite-volume", "film.cells=64", "motion.film=film"]
back, quality = run(BACK + ["film.steps=150"], "motion.dte_rms")
check(quality["feedback_residual"]["verdict"] == "good" and abs(back["motion.dte_rms"] / shared_rms - 1) > 1e-3,
      f"the film wired back moves the motion, {back['motion.dte_rms']:.6g} m from {shared_rms:.6g} m")
why = answer_of(BACK + ["feedback.rounds=3"], "motion.dte_rms")["errors"][0]["message"]
check("film.roll_angle had " in why and "a loop converges only if this number stays the same" in why, why)
sys.exit(failed)
