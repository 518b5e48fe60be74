# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares motions requested by name with the atlas of the same file, for six gear pairs.

At each fold that ends a stable part of a branch: 0.1 Hz inside the branch, its name must give a stable motion on it; 0.1 Hz outside, the run must
fail and name the branch's range. Beyond the end of `upper`, the run must report the end at a fold, but not 0.1 Hz before it. At 40 speeds,
stable_motions must be at least the number of stable branches of the atlas, and not depend on the other outputs.

atlas-names.py FLANKFILM [--speeds 40] [--files 6]
"""
import argparse
import json
import subprocess
import tempfile

UNEQUAL = "teeth: [25, 52], module: 3 mm, face_width: 24 mm, elastic_modulus: [206 GPa, 170 GPa]"
FILES = {
    "31/80, iso-6336": ("teeth: [31, 80], module: 2 mm, face_width: 18 mm", "iso-6336", "60 N m"),
    "50/50, iso-6336": ("teeth: [50, 50], module: 3 mm, face_width: 20 mm", "iso-6336", "250 N m"),
    "25/52, linear relief, tangent": (UNEQUAL + ", tip_relief: 20 um, tip_relief_shape: linear", "load-distribution, compliance: analytical", "250 N m"),
    "25/52, unequal parabolic relief, tangent": (UNEQUAL + ", tip_relief: [44 um, 30 um], tip_relief_shape: parabolic", "load-distribution, compliance: analytical", "180 N m"),
    "25/52, potential-energy": (UNEQUAL, "potential-energy", "120 N m"),
    "19/41, relief of the wheel, secant": ("teeth: [19, 41], module: 4 mm, face_width: 30 mm, profile_shift: [0.35, 0.1], tip_relief: [0 um, 25 um], tip_relief_shape: linear", "load-distribution, compliance: analytical, definition: secant", "400 N m"),
}
OFF = 0.1  # Hz
failures = checks = 0


def report(good, text):
    global failures, checks
    checks += 1
    if not good:
        failures += 1
        print("FAIL", text, flush=True)


class Pair:
    def __init__(self, program, gear, mesh, torque):
        self.program = program
        self.text = f"""format: 2
pipeline:
  gears: {{use: gear/involute-spur, {gear}, pressure_angle: 20 deg, backlash: 0.14 mm}}
  duty: {{use: operating/steady, torque: {torque}, mesh_frequency: 2000 Hz}}
  mesh: {{use: stiffness/{mesh}}}
  motion: {{use: dynamics/shooting, natural_frequency: 3242 Hz, damping_ratio: 0.01, max_period: 3, search_speeds: 5, search_starts: 6,
    atlas: {{from: 1000 Hz, to: 4000 Hz}}, steps_per_cycle: 64}}
outputs: [motion.dte_rms]
"""
        names = "atlas_frequency atlas_branch atlas_stable fold_frequency doubling_frequency"
        atlas = self.run(2000, names)["outputs"]
        at, of, stable, self.folds, self.doublings = (atlas["motion." + n].get("data", []) for n in names.split())
        self.branches = {}
        for point in zip(of, at, stable):
            self.branches.setdefault(int(point[0]), []).append(point[1:])

    def run(self, speed, outputs, **settings):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            file.write(self.text)
            file.flush()
            command = [self.program, "run", file.name, "--json", "--arrays", "--set", f"duty.mesh_frequency={speed!r} Hz", "--set",
                       "outputs=[" + ", ".join("motion." + o for o in outputs.split()) + "]"]
            for name, value in settings.items():
                command += ["--set", f"motion.{name}={value}"]
            done = subprocess.run(command, stdout=subprocess.PIPE)
        answer = json.loads(done.stdout)
        if answer["exit"] and "branch" not in settings:
            raise SystemExit(f"{answer['errors']}")
        answer["motion"] = next((s["quality"] for s in answer.get("stages", []) if s["stage"] == "motion"), {})
        return answer

    def stable_ends(self):
        """Returns fold, branch and side for each stable part that ends at a fold and is longer than OFF."""
        for number, points in self.branches.items():
            for end, way in ((0, 1), (len(points) - 1, -1)):
                fold = points[end][0]
                if not any(abs(fold / f - 1) < 1e-9 for f in self.folds):
                    continue
                i = end + way
                while 0 <= i < len(points) and points[i][1] > 0 and abs(points[i][0] - fold) <= 2 * OFF:
                    i += way
                if 0 <= i < len(points) and points[i][1] > 0:
                    yield fold, f"p{number // 1000}-{number % 1000}", 1 if points[i][0] > fold else -1

    def check_names(self, name):
        count = 0
        for fold, branch, side in self.stable_ends():
            inside = self.run(fold + side * OFF, "dte_rms floquet_max", branch=branch)
            good = inside["exit"] == 0 and inside["outputs"]["motion.floquet_max"]["value"] < 1
            report(good, f"{name}: {branch} {OFF} Hz inside its fold at {fold} Hz: {inside['errors'] or inside['outputs']}")
            outside = self.run(fold - side * OFF, "dte_rms", branch=branch)
            report(outside["exit"] and "runs from" in str(outside["errors"]), f"{name}: {branch} outside {fold} Hz: {outside['errors']}")
            count += 1
        return count

    def check_upper(self, name):
        """Finds the first end of `upper` with decreasing speed, and checks it on both sides."""
        end, said = None, self.run(1010, "dte_rms", branch="upper")["motion"].get("branch_end")
        speed = 1010
        while said:
            end = speed * (1 + said["value"])
            speed = end + OFF
            said = self.run(speed, "dte_rms", branch="upper")["motion"].get("branch_end")
        if not end:
            return None
        near = min(abs(f - end) for f in self.folds + self.doublings)
        report(near < 0.02, f"{name}: upper ends at {end} Hz, {near} Hz from a fold or doubling")
        rms = []
        for offset in 1, OFF, -OFF:
            answer = self.run(end + offset, "dte_rms", branch="upper")
            rms.append(answer["outputs"]["motion.dte_rms"]["value"])
            ended = offset < 0
            report(("branch_end" in answer["motion"]) == ended, f"{name}: upper at {end + offset} Hz, branch_end is {'not ' if ended else ''}said")
        if min(abs(f - end) for f in self.folds) == near:
            report(abs(rms[1] / rms[0] - 1) < 0.05 < abs(rms[2] / rms[1] - 1), f"{name}: rms about the end of upper: {rms}")
        return end

    def check_counts(self, name, speeds):
        most = 0
        for i in range(speeds):
            speed = 1013 + 2950 * i / speeds
            of_atlas = sum((a[0] <= speed) != (b[0] <= speed) and a[1] > 0 and b[1] > 0
                           for points in self.branches.values() for a, b in zip(points, points[1:]))
            known = self.run(speed, "stable_motions", known_motions="atlas")["outputs"]["motion.stable_motions"]["value"]
            report(known >= of_atlas, f"{name}: {known} stable motions at {speed} Hz, {of_atlas} in the atlas")
            most = max(most, of_atlas)
        return most


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--speeds", type=int, default=40)
    parser.add_argument("--files", type=int, default=len(FILES))
    given = parser.parse_args()
    for name, (gear, mesh, torque) in list(FILES.items())[:given.files]:
        pair = Pair(given.program, gear, mesh, torque)
        ends, upper, most = pair.check_names(name), pair.check_upper(name), pair.check_counts(name, given.speeds)
        print(f"{name}: {ends} stable ends at {len(pair.folds)} folds, upper ends at {upper} Hz, up to {most} stable motions in the atlas", flush=True)
    print(f"{checks} checks, {failures} failed")
    return failures > 0


raise SystemExit(main())
