# SPDX-License-Identifier: GPL-3.0-or-later
"""At 20 Hz the motion is the loaded transmission error, whether the stiffness is slope or chord.

Three reliefs that let no pair enter or leave with load, on an equal and on an unequal pair: dte_rms to 5e-4,
dte_mean to 1e-4. Without relief the
jumps of the loaded error ring: quasi-static is the loaded error exactly, and the mean of the mesh force
of the other models is the line force to 1e-6.

And the spring of the motion against the load distribution solved at other forces: from 0.75 to 1.25 F 0.6 times as far from
it as the chord is, or nearer, and at the knee hardly further.

slow-motion.py FLANKFILM
"""
import json
import subprocess
import sys
import tempfile

program = sys.argv[1]
PAIRS = {"equal": "teeth: [50, 50], module: 3 mm, face_width: 20 mm", "unequal": "teeth: [25, 52], module: 3 mm, face_width: 24 mm, elastic_modulus: [206 GPa, 170 GPa]"}
RELIEFS = {
    "linear": "tip_relief: 40 um, tip_relief_shape: linear",
    "parabolic": "tip_relief: 45 um, tip_relief_shape: parabolic",
    "unequal": "tip_relief: [44 um, 50 um], tip_relief_shape: linear",
}
failed = False


def run(model, gear, relief, definition, outputs, frequency="20 Hz", more="", torque=250):
    text = f"""format: 2
pipeline:
  gears: {{use: gear/involute-spur, {gear}, pressure_angle: 20 deg, backlash: 0.14 mm{', ' + relief if relief else ''}}}
  duty: {{use: operating/steady, torque: {torque} N m, mesh_frequency: {frequency}}}
  mesh: {{use: stiffness/load-distribution, compliance: analytical, definition: {definition}}}
  motion: {{use: dynamics/{model}{more}}}
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


def check(what, found, expected, limit):
    global failed
    off = abs(found / expected - 1)
    failed = failed or not off <= limit
    print(f"{'ok' if off <= limit else 'FAIL'} {what}: off by {off:.2g}, at most {limit:g}")


for pair, gear in PAIRS.items():
    for name, relief in RELIEFS.items():
        for definition in "tangent", "secant":
            static = run("quasi-static", gear, relief, definition, "motion.dte_rms, motion.dte_mean")
            slow = run("shooting", gear, relief, definition, "motion.dte_rms, motion.dte_mean")
            what = f"{pair} pair, {name} relief, {definition}"
            check(what + ", rms", slow["motion.dte_rms"], static["motion.dte_rms"], 5e-4)
            check(what + ", mean", slow["motion.dte_mean"], static["motion.dte_mean"], 1e-4)
    mesh = "mesh.loaded_transmission_error, gears.backlash"
    both = run("quasi-static", gear, "", "tangent", f"motion.dte, {mesh}")
    exact = [x + both["gears.backlash"] / 2 for x in both["mesh.loaded_transmission_error"]]
    same = max(abs(a / b - 1) for a, b in zip(exact, both["motion.dte"])) < 1e-11  # the digits shown
    failed = failed or not same
    print(f"{'ok' if same else 'FAIL'} {pair} pair without relief: quasi-static is the loaded error")
    for model in "shooting", "time-integration":
        wave = run(model, gear, "", "tangent", "motion.phase, motion.mesh_force, duty.line_force", "400 Hz",
                   ", steps_per_cycle: 16384")
        phase, force = wave["motion.phase"], wave["motion.mesh_force"]
        mean = sum((b - a) * (x + y) / 2 for a, b, x, y in zip(phase, phase[1:], force, force[1:])) / (phase[-1] - phase[0])
        check(f"{pair} pair without relief, {model}: mean mesh force", mean, wave["duty.line_force"], 1e-6)

def solve(gear, relief, torque, definition):
    """k, and the deflection e_l - e, at the middles of 100 steps of the phase."""
    names = "mesh.phase, mesh.stiffness, mesh.transmission_error, mesh.loaded_transmission_error, duty.line_force"
    found = run("quasi-static", gear, relief, definition, names, torque=torque)
    phase, rows = found["mesh.phase"], []
    for i in range(100):
        at = (i + 0.5) / 100
        j = max(k for k in range(len(phase) - 1) if phase[k] < at)
        x = (at - phase[j]) / (phase[j + 1] - phase[j])
        k, e, loaded = (found["mesh." + n][j] * (1 - x) + found["mesh." + n][j + 1] * x
                        for n in ("stiffness", "transmission_error", "loaded_transmission_error"))
        rows.append((k, loaded - e))
    return found["duty.line_force"], rows


for relief in "", "tip_relief: 20 um, tip_relief_shape: linear":
    gear = PAIRS["equal"]
    F, mean = solve(gear, relief, 250, "tangent")
    size = sum(way for _, way in mean) / 100
    for level in 0.25, 0.5, 0.75, 1.25, 1.5:
        _, solved = solve(gear, relief, 250 * level, "secant")
        law = chord = 0
        for (k, way), (_, true) in zip(mean, solved):
            r = k * way - F
            bend = level * (F + 2 * r) / k if level <= 0.5 else (level * F + r) / k
            law += (bend - true) ** 2 / 100
            chord += (level * way - true) ** 2 / 100
        ratio = (law / chord) ** 0.5
        good = ratio <= (0.6 if 0.7 < level < 1.3 else 1.15)
        failed = failed or not good
        print(f"{'ok' if good else 'FAIL'} {relief or 'no relief'}, {level} F: spring off by {law ** 0.5 / size:.4f}, chord by {chord ** 0.5 / size:.4f} of the mean deflection")
sys.exit(failed)
