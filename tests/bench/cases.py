# SPDX-License-Identifier: GPL-3.0-or-later
"""What a cheap case of a study costs: processor time and time by the clock with one worker, files,
bytes, and instructions of all processes by callgrind, of a tenth of the cases.

    python3 cases.py FLANKFILM PLUGINS [CASES]      # CASES is 10000 by itself
"""
import glob
import os
import re
import resource
import subprocess
import sys
import tempfile
import time

SCENES = {
    "an oil, three scalars": """
pipeline:
  oil: {{use: lubricant/grade, grade: ISO VG 220}}
outputs: [oil.eta0, oil.alpha, oil.rho0]
study: {{sweep: {{oil.temperature: {{from: 40 degC, to: 120 degC, points: {}}}}}}}
""",
    "a film by formula of a measured oil, two scalars": """
include: [lubricants/mil-l-23699.yaml]
pipeline:
  oil:   {{temperature: 100 degC}}
  discs: {{use: contact/constant, radius: 12.8 mm, entrainment_speed: 4 m/s, slide_roll_ratio: 0.1,
          load_per_width: 177 N/mm}}
  film:  {{use: ehl/film-formula}}
outputs: [discs.moes_M, film.h_min]
study: {{sweep: {{discs.load_per_width: {{from: 100 N/mm, to: 300 N/mm, points: {}}}}}}}
""",
    "a gear pair, one series of 101": """
include: [gears/unity-50.yaml]
outputs: [gears.roll_angle, gears.contact_ratio]
study: {{sweep: {{gears.face_width: {{from: 10 mm, to: 30 mm, points: {}}}}}}}
""",
}


def run(program, count, directory, before=()):
    with open("scene.yaml", "w", encoding="utf-8") as file:
        file.write("format: 2" + SCENES[directory].format(count))
    folder = f"{directory} {count}"
    begin, used = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([*before, program, "run", "scene.yaml", "-j", "1", "-o", folder],
                          capture_output=True, text=True, check=True)
    now = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert f"{count} of {count} cases done" in done.stdout, done.stdout
    cpu = now.ru_utime + now.ru_stime - used.ru_utime - used.ru_stime
    return cpu, time.monotonic() - begin, folder


def instructions(program, count, scene):
    """Of all processes, without what a study of ten cases takes."""
    sums = []
    for cases in (10, count):
        run(program, cases, scene, ("valgrind", "--tool=callgrind", "--callgrind-out-file=out.%p"))
        sums.append(0)
        for out in glob.glob("out.*"):
            with open(out, encoding="utf-8") as file:
                sums[-1] += int(re.search(r"^totals: (\d+)", file.read(), re.M).group(1))
            os.remove(out)
    return (sums[1] - sums[0]) / (count - 10)


program, os.environ["FLANKFILM_PLUGIN_PATH"] = map(os.path.abspath, sys.argv[1:3])
count = int(sys.argv[3]) if len(sys.argv) > 3 else 10000
with tempfile.TemporaryDirectory() as lab:
    os.chdir(lab)
    for scene in SCENES:
        cpu, wall, folder = run(program, count, scene)
        sizes = [os.path.getsize(os.path.join(at, f)) for at, _, files in os.walk(folder) for f in files]
        print(f"{scene}: {1e3 * cpu / count:.3f} ms of CPU, {1e3 * wall / count:.3f} ms, {len(sizes)} files, "
              f"{sum(sizes) / count:.0f} bytes, {instructions(program, max(100, count // 10), scene) / 1e6:.2f} M "
              "instructions a case", flush=True)
