# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the tooth force between the stations with the same motion at thirty times as many stations.

The quality line station_sampling states by how much the force, half-way between two stations, lies outside the range of both
values; dynamic_factor_tooth contains the largest. A wave with the phase step w between stations exceeds the range by w^2/8, and the
parabola through three points has an error of at most w^3/125: less than a quarter of the line's value to the power of 3/2.
With the number of stations that a doubtful line recommends, the line must be good, and with half of them doubtful; if it says that more
than a number are needed, it must be doubtful with this number.

sampling.py FLANKFILM SOURCE
"""
import bisect
import json
import re
import subprocess
import sys

program, source = sys.argv[1:3]


def run(stations, frequency):
    done = subprocess.run([program, "run", f"{source}/configs/li-kahraman-2011.yaml", "--json", "--arrays", "--set",
                           "outputs=[motion.tooth_force,motion.dynamic_factor_tooth,gears.roll_angle]", "--set", f"gears.stations={stations}", "--set",
                           "mesh.use=stiffness/potential-energy", "--set", "mesh.points=1600", "--set",
                           f"duty.mesh_frequency={frequency} Hz"], stdout=subprocess.PIPE, check=True)
    answer = json.loads(done.stdout)
    line = next(s["quality"] for s in answer["stages"] if s["stage"] == "motion")["station_sampling"]
    return (answer["outputs"]["gears.roll_angle"]["data"], answer["outputs"]["motion.tooth_force"]["data"],
            line["value"], line["verdict"], answer["outputs"]["motion.dynamic_factor_tooth"]["value"], line["text"])


def at(angles, forces, angle):
    i = min(max(bisect.bisect_right(angles, angle), 1), len(angles) - 1)
    share = (angle - angles[i - 1]) / (angles[i] - angles[i - 1])
    return forces[i - 1] + share * (forces[i] - forces[i - 1])


failed = False
for frequency, stations, verdict in ((1250, 200, "good"), (200, 100, "doubtful"), (100, 200, "doubtful"), (50, 100, "doubtful")):
    angles, forces, said, told, factor, text = run(stations, frequency)
    fine = run(30 * stations, frequency)
    middle = [(a + z) / 2 for a, z in zip(angles, angles[1:]) if z - a > 1e-9]
    spans = [sorted(pair) for pair, a, z in zip(zip(forces, forces[1:]), angles, angles[1:]) if z - a > 1e-9]
    halves = [at(fine[0], fine[1], x) for x in middle]
    found = max(max(low - half, half - high, 0) for half, (low, high) in zip(halves, spans)) / max(fine[1])
    off = abs(factor / fine[4] - 1)
    good = abs(said - found) < 0.01 * found and told == verdict and off < said ** 1.5 / 4
    failed = failed or not good
    print(f"{'ok' if good else 'FAIL'} {frequency} Hz, {stations} stations: said {said:.4g} ({told}), found {found:.4g}; "
          f"factor off by {off:.2g}, at most {said ** 1.5 / 4:.2g}")
    named = re.search(r"with (\d+) or more stations", text)
    if bool(named) != (told == "doubtful"):
        failed = print("FAIL names stations where it is good, or none where it is not") is None
    elif named:
        enough, half = (run(max(stations, int(named[1]) // part), frequency)[3] for part in (1, 2))
        good = enough == "good" and half == "doubtful"
        failed = failed or not good
        print(f"{'ok' if good else 'FAIL'} on {named[1]} stations {enough}, on half of them {half}")
# 27 times as many as these are too few for what takes more than 1000 (100 stations at 50 Hz, above)
text = run(8, 50)[5]
named = re.search(r"more than (\d+) times as many stations", text)
good = bool(named) and " or more" not in text and run(8 * int(named[1]), 50)[3] == "doubtful"
failed = failed or not good
print(f"{'ok' if good else 'FAIL'} 50 Hz, 8 stations: {text.split('; ')[-1]}")
sys.exit(failed)
