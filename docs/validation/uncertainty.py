# SPDX-License-Identifier: GPL-3.0-or-later
"""What `study: uncertainty` says of three gear pairs against brute force: plain samples with doubled cells and steps, and
some with the finer model throughout. What was computed stays in DIRECTORY, and is taken over by the next call.

    python3 docs/validation/uncertainty.py PROGRAM SOURCE DIRECTORY [SAMPLES PAIRS WORKERS] > docs/validation/uncertainty.md
"""
import csv
import json
import math
import os
import re
import statistics
import subprocess
import sys

PAIR = """include: [%(configs)s/lubricants/gear-oil-mineral.yaml]
pipeline:
  gears:  {use: gear/involute-spur, teeth: [23, 67], module: 4 mm, face_width: 40 mm, profile_shift: [0.35, -0.1],
           centre_distance: 181.1 mm, tip_relief: 25 um, roughness_rq: [0.4 um, 0.6 um]}
  oil:    {grade: ISO VG 320}
  duty:   {use: operating/steady, torque: 1100 N m, speed: 1450 rpm, oil_temperature: 70 degC}
  mesh:   {use: stiffness/load-distribution}
  motion: {use: dynamics/shooting, damping_ratio: 0.05}
  tooth:  {use: contact/tooth-pair, load: motion}
  film:   {use: ehl/finite-volume}
"""
LADDER = """    ladder: {inlet: {film.use: ehl/inlet-analysis, mesh.elements_per_tooth: 50, mesh.points: 30}}
    pilot: 16
"""
# name, pipeline, inputs and condition, ladder
SCENES = (
    ("seed", "the pair of Li & Kahraman 2011", "include: [%(configs)s/studies/uncertainty.yaml]\n",
     """    inputs:
      duty.torque: {normal: [250 N m, 10 %%]}
      duty.mesh_frequency: {lognormal: [1250 Hz, 5 %%]}
      duty.oil_temperature: {normal: [100 degC, 3 K]}
    conditions: ["film.h_min_lowest < 0.125 um"]
""", True),
    ("pair", "a 23/67 pair of module 4 with 25 um of tip relief", PAIR, """    inputs:
      duty.torque: {normal: [1100 N m, 10 %%]}
      duty.speed: {lognormal: [1450 rpm, 3 %%]}
      duty.oil_temperature: {normal: [70 degC, 3 K]}
      gears.tip_relief: 25 um +- 7 um
    conditions: ["film.h_min_lowest < 0.5 um"]
""", True),
    ("stage", "the gearbox stage of configs/gearbox-stage.yaml", "include: [%(configs)s/gearbox-stage.yaml]\n", """    inputs:
      duty.torque: {normal: [220 N m, 10 %%]}
      duty.oil_temperature: {normal: [80 degC, 3 K]}
      gears.centre_distance: 119.664 mm +- 20 um
      gears.tip_relief: 15 um +- 7 um
    conditions: ["film.h_min_lowest < 0.22 um"]
""", False),
)
HEAT = ("film.thermal=full",)
DOUBLED = ("film.cells=1024", "film.time_tolerance=1.75e-3")  # the error of a step falls with its square


def run(program, directory, name, text, sets=(), workers=1):
    """Runs a study, or what is missing of it, and returns its result and its samples."""
    with open(f"{directory}/{name}.yaml", "w", encoding="utf-8") as file:
        file.write("format: 2\n" + text)
    words = [word for one in sets for word in ("--set", one)]
    done = subprocess.run([program, "run", f"{name}.yaml", "-o", name, "-j", str(workers), *words], cwd=directory,
                          capture_output=True, text=True, check=False)
    if done.returncode not in (0, 4):
        sys.exit(f"{name}: {done.stderr[-2000:]}")
    with open(f"{directory}/{name}/uncertainty.json", encoding="utf-8") as file:
        result = json.load(file)
    with open(f"{directory}/{name}/table.csv", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if re.match(r"sample \d", row["sample"])]
    return result, rows


def values(rows):
    return [float(row["film.h_min_lowest [m]"] or "nan") for row in rows]


def solve(a, b):
    """Solves a x = b by elimination."""
    n = len(b)
    a = [row[:] + [b[i]] for i, row in enumerate(a)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(a[i][k]))
        a[k], a[pivot] = a[pivot], a[k]
        for i in range(k + 1, n):
            f = a[i][k] / a[k][k]
            a[i] = [x - f * y for x, y in zip(a[i], a[k])]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (a[k][n] - sum(a[k][j] * x[j] for j in range(k + 1, n))) / a[k][k]
    return x


def known_mean(y, rows, inputs):
    """The mean, corrected by the squares and products of the inputs, whose means over the samples are not quite their true
    ones: normal ones are (mean, spread), uniform ones (middle, half the width)."""
    columns = []
    for name, (kind, middle, spread) in inputs.items():
        z = [float(row[name].split()[0]) for row in rows]
        z = [(math.log(v / middle) if kind == "lognormal" else v - middle) / spread for v in z]
        columns.append((z, 1 / 3 if kind == "uniform" else 1))
    x = [[1.0] for _ in y]
    for i, (a, square) in enumerate(columns):
        for j, (b, _) in enumerate(columns[:i + 1]):
            for row, p, q in zip(x, a, b):
                row.append(p * q - (square if i == j else 0))
        for row, p in zip(x, a):
            row.append(p)
    n = len(x[0])
    scale = statistics.mean(y)
    normal = [[sum(row[i] * row[j] for row in x) for j in range(n)] for i in range(n)]
    beta = solve(normal, [sum(row[i] * v / scale for row, v in zip(x, y)) for i in range(n)])
    rest = sum((v / scale - sum(c * b for c, b in zip(row, beta))) ** 2 for row, v in zip(x, y))
    return beta[0] * scale, scale * math.sqrt(rest / (len(y) - n) / len(y))


def inputs_of(result):
    """The inputs of a study, in the units of the file: name -> (kind, middle, spread)."""
    found = {}
    for one in result["inputs"]:
        text = one["distribution"]
        if "+-" in text:
            middle, spread = re.match(r"([\d.]+) \w+ \+- ([\d.]+) (\w+)", text).groups()[:2]
            found[one["name"]] = ("uniform", float(middle), float(spread) * (1e-3 if " mm" in text else 1))
        else:
            kind, middle, spread, unit = re.match(r"(\w+): \[([\d.]+)[^,]*, ([\d.]+) (\S+?)\]", text).groups()
            spread = float(spread) / 100 if unit == "%" else float(spread)
            if kind == "lognormal":
                spread = math.sqrt(math.log(1 + spread * spread))
            elif unit == "%":
                spread *= float(middle)
            found[one["name"]] = (kind, float(middle), spread)
    return found


def row(what, said, found, error, good):
    print(f"| {what} | {said} | {found} | {error} | {'yes' if good else '**no**'} |")
    return good


def interval(e, scale=1e9):
    low, high = (e[key] for key in ("low", "high"))
    return f"{e['value'] * scale:.4g} ({'?' if low is None else f'{low * scale:.4g}'} to {'?' if high is None else f'{high * scale:.4g}'})"


def within(e, value, room):
    return (e["low"] is None or value >= e["low"] - room) and (e["high"] is None or value <= e["high"] + room)


def percent(value):
    return f"{100 * value:+.2f} %"


def judge(said, plain, finer, base):
    """Prints the table of one pair; returns how many lines hold, and of how many."""
    of, limits = said["outputs"]["film.h_min_lowest"], said["outputs"]["film.h_min_lowest"]["limits"]
    y, n = sorted(v for v in values(plain) if math.isfinite(v)), len(plain)
    good = [r for r in plain if r["film.h_min_lowest [m]"]]
    mean, error = known_mean(values(good), good, inputs_of(said))
    spread, room = statistics.stdev(y), limits["numerical"] * mean
    lines = [row("mean (nm)", interval(of["mean"]), f"{mean * 1e9:.4g}; plain {statistics.mean(y) * 1e9:.4g}",
                 f"{error * 1e9:.2g}; plain {spread / math.sqrt(n) * 1e9:.2g}", within(of["mean"], mean, room))]
    kurtosis = statistics.mean((v - statistics.mean(y)) ** 4 for v in y) / spread ** 4
    lines.append(row("standard deviation (nm)", interval(of["deviation"]), f"{spread * 1e9:.3g}",
                     f"{spread * math.sqrt((kurtosis - 1) / 4 / n) * 1e9:.2g}", within(of["deviation"], spread, 0)))
    for one in of["percentiles"]:
        p = one["share"]
        found = statistics.quantiles(y, n=1000, method="inclusive")[round(1000 * p) - 1]
        half = math.sqrt(p * (1 - p) / n)
        ends = [y[min(n - 1, max(0, int((p + s * half) * n)))] for s in (-1, 1)]
        lines.append(row(f"{100 * p:g} % are below (nm)", interval(one), f"{found * 1e9:.4g}",
                         f"{(ends[1] - ends[0]) / 2 * 1e9:.2g}", within(one, found, room)))
    for text, one in said["conditions"].items():
        limit = float(text.split()[-2]) * 1e-6
        found = sum(v < limit for v in y) / n
        lines.append(row(f"{text} (%)", interval(one, 100), f"{100 * found:.3g}",
                         f"{100 * math.sqrt(found * (1 - found) / n):.2g}", within(one, found, 0)))
    pairs = [b / a - 1 for a, b in zip(values(base), values(plain)) if math.isfinite(b / a)]
    moved = statistics.mean(pairs)
    lines.append(row("doubled cells and steps move the mean by", f"±{100 * limits['numerical']:.2g} % numerical", percent(moved),
                     f"{100 * statistics.stdev(pairs) / math.sqrt(len(pairs)):.1g} %", abs(moved) <= limits["numerical"]))
    pairs = [b / a - 1 for a, b in zip(values(plain), values(finer)) if math.isfinite(b / a)]
    moved, model = statistics.mean(pairs), limits["model"]
    own = statistics.stdev(pairs) / math.sqrt(len(pairs))
    lines.append(row("heat in the film moves the mean by", f"±{100 * model:.2g} % model", percent(moved), f"{100 * own:.1g} %",
                     abs(moved) <= model))
    whole = mean * (1 + moved)
    lines.append(row("all of it: the mean (nm)", f"{of['mean']['value'] * 1e9:.4g} ±{100 * (model + limits['numerical']):.2g} %",
                     f"{whole * 1e9:.4g}", f"{math.hypot(error, own * mean) * 1e9:.2g}",
                     within(of["mean"], whole, room + model * mean)))
    return sum(lines), len(lines)


def main():
    program, source, directory = (os.path.abspath(word) for word in sys.argv[1:4])
    samples, pairs, workers = (int(word) for word in sys.argv[4:7]) if len(sys.argv) > 4 else (10000, 100, 1)
    os.makedirs(directory, exist_ok=True)
    print(__doc__.split("\n\n", maxsplit=1)[0].join(("# What limits me, against brute force\n\n", "\n")))
    held = [0, 0]
    for name, title, pipeline, inputs, ladder in SCENES:
        names = {"configs": source + "/configs"}
        pipeline = (pipeline.split("study:", maxsplit=1)[0]) % names
        if name == "seed":  # without the study of its file, whose ladder would be merged
            with open(source + "/configs/studies/uncertainty.yaml", encoding="utf-8") as file:
                text = file.read()
            pipeline = re.sub(r"\.\./", names["configs"] + "/", text[text.index("include:"):text.index("outputs:")])
        begin = pipeline + "outputs: [film.h_min_lowest]\nstudy:\n  uncertainty:\n    outputs: [film.h_min_lowest]\n" + inputs % ()
        said, _ = run(program, directory, name, begin + "    samples: 400\n" * ladder + "    models: {heat: {film.thermal: full}}\n" +
                      LADDER * ladder)
        brute = begin + "    seed: 77\n"
        plain = run(program, directory, name + "-plain", brute + f"    samples: {samples}\n", DOUBLED, workers)[1]
        finer = run(program, directory, name + "-finer", brute + f"    samples: {pairs}\n", DOUBLED + HEAT, workers)[1]
        base = run(program, directory, name + "-base", brute + f"    samples: {2 * pairs}\n", (), workers)[1]
        print(f"\n## {name}: {title}\n\n    {said['outputs']['film.h_min_lowest']['limits']['sentence']}\n")
        if "gain" in said:
            gain, levels = said["gain"], said["levels"]
            print(f"Known as from {gain['plain']:.0f} plain samples, {gain['found']:.3g} times cheaper than they would be, "
                  f"{gain['predicted']:.3g} promised: {levels[0]['samples']} samples of the file's model, {levels[1]['samples']} by inlet at "
                  f"{100 * levels[1]['seconds'] / levels[0]['seconds']:.2g} % of the cost, correlation {levels[1]['correlation']:.4f}.\n")
        print(f"| of {len(plain)} samples | said | brute force | its standard error | held |\n| --- | --- | --- | --- | --- |")
        held = [a + b for a, b in zip(held, judge(said, plain, finer, base))]
        sys.stdout.flush()
    print(f"\n{held[0]} of {held[1]} lines hold.")


if __name__ == "__main__":
    main()
