#!/usr/bin/python3
"""Shipped files, changed at random: what `check` calls ok `run` does not refuse for its input, and
neither crashes. Changes: a key, a stage or an include goes, is emptied or doubled, a model is
swapped for another of its kind, a number moves out of its range, a word or a unit is another one.

changed-files.py FLANKFILM SOURCE_ROOT [--count N] [--seed S] [--keep DIR]
A seed gives the same files. With --keep what fails stays in DIR."""
import argparse
import os
import random
import re
import subprocess
import sys
import tempfile

import yaml

FILES = ["own-gear.yaml", "mesh-losses.yaml", "fzg-a-scuffing.yaml", "fzg-cgf-micropitting.yaml", "li-kahraman-2011.yaml",
         "gearbox-stage.yaml", "idle.yaml", "line-contact.yaml", "oil-measured.yaml", "one-oil.yaml", "profile-relief.yaml", "rattle.yaml",
         "rough-flanks.yaml", "table-contact.yaml", "thermal.yaml", "mixed-film.yaml", "two-way.yaml",
         "studies/film-map.yaml", "studies/speed-sweep.yaml", "studies/oils-over-temperature.yaml", "studies/ratings.yaml"]
# so that a film, where it is reached, ends soon: a run that takes longer has passed its input
SECONDS = 4


def resolved(path):
    """The file with what it includes, as a tree; the files that it names by absolute paths."""
    tree = yaml.safe_load(open(path)) or {}
    name_files(tree, os.path.dirname(path))
    whole = {}
    for other in tree.pop("include", []) or []:
        merge(whole, resolved(other))
    merge(whole, tree)
    return whole


def name_files(tree, folder):
    for key, value in tree.items() if isinstance(tree, dict) else enumerate(tree):
        if isinstance(value, (dict, list)):
            name_files(value, folder)
        elif isinstance(value, str) and os.path.isfile(os.path.join(folder, value)):
            tree[key] = os.path.normpath(os.path.join(folder, value))


def merge(into, tree):
    for key, value in tree.items():
        if isinstance(value, dict) and isinstance(into.get(key), dict):
            merge(into[key], value)
        else:
            into[key] = value


def other_number(value, dice):
    """The number with its unit behind it, moved."""
    text = str(value)
    found = re.match(r"\s*([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)(.*)$", text, re.S)
    if not found:
        return dice.choice(["auto", "none", "true", "0", "-1", "nonsense"])
    number, unit = float(found.group(1)), found.group(2)
    moved = dice.choice([-number, 0, number * 1e3, number * 1e-3, number * 2, number / 2, number * 1.2, number * 0.8,
                         number * 5, number * 0.2, number + 1, number * 1e9, 3, 1])
    if re.fullmatch(r"\s*[-+]?[0-9]+\s*", found.group(1)):
        moved = int(moved) if abs(moved) < 1e15 else moved
    return "%r%s" % (moved, dice.choice([unit] * 8 + ["", " mm"]))


def change(tree, others, models, dice):
    """Changes the tree once, and says how."""
    stages = tree["pipeline"]
    kind = dice.choice(["key", "key", "key", "stage", "model", "number", "number", "empty", "wire", "output", "taken", "taken"])
    name = dice.choice(list(stages))
    stage = stages[name]
    if kind == "stage":
        del stages[name]
        if not stages:
            stages["empty"] = {"use": "gear/involute-spur"}
        return "stage %s goes" % name
    if kind == "model" and stage.get("use"):
        stage["use"] = dice.choice([m for m in models if m.split("/")[0] == stage["use"].split("/")[0]] or models)
        return "%s uses %s" % (name, stage["use"])
    if kind == "output":
        tree["outputs"] = [dice.choice(sorted({o for t in others for o in t.get("outputs", [])} | {name + ".*"}))]
        return "outputs %s" % tree["outputs"]
    if kind == "taken":
        alike = [t["pipeline"][n] for t in others for n in t["pipeline"] if t["pipeline"][n].get("use") == stage.get("use")]
        items = [item for other in alike for item in other.items()] or list(stage.items())
        key, value = dice.choice(items)
        stage[key] = value
        return "%s.%s is that of another file, %s" % (name, key, value)
    keys = [k for k in stage if k != "use"] or list(stage)
    if not keys:
        return "%s is empty" % name
    key = dice.choice(keys)
    if kind == "wire":
        key, stage[key] = key, dice.choice(list(stages) + ["none"])
        return "%s.%s is %s" % (name, key, stage[key])
    if kind == "key":
        del stage[key]
        return "%s.%s goes" % (name, key)
    if kind == "empty":
        stage[key] = None
        return "%s.%s is empty" % (name, key)
    value = stage[key]
    if isinstance(value, list) and value:
        k = dice.randrange(len(value))
        value[k] = other_number(value[k], dice)
    elif not isinstance(value, dict):
        stage[key] = other_number(value, dice)
    return "%s.%s is %s" % (name, key, stage[key])


def call(words, seconds):
    """The exit code and what was printed; None: it did not end in time."""
    try:
        done = subprocess.run(words, capture_output=True, text=True, errors="replace", timeout=seconds)
    except subprocess.TimeoutExpired:
        return None, ""
    return done.returncode, done.stdout + done.stderr


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("flankfilm")
    parser.add_argument("source")
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=45)
    parser.add_argument("--keep")
    parser.add_argument("--seconds", type=float, default=SECONDS)
    options = parser.parse_args()
    dice = random.Random(options.seed)
    models = call([options.flankfilm, "models"], 60)[1]
    models = sorted(set(re.findall(r"^\s*([a-z]+/[a-z0-9-]+)", models, re.M)))
    scratch = options.keep or tempfile.mkdtemp()
    os.makedirs(scratch, exist_ok=True)
    trees = {name: resolved(os.path.join(os.path.realpath(options.source), "configs", name)) for name in FILES}
    accepted = refused = bad = 0
    for i in range(options.count):
        name = dice.choice(FILES)
        tree = yaml.safe_load(yaml.safe_dump(trees[name]))
        said = [change(tree, list(trees.values()), models, dice) for _ in range(dice.choice([1, 1, 2]))]
        path = os.path.join(scratch, "case-%d.yaml" % i)
        with open(path, "w") as out:
            yaml.safe_dump(tree, out, sort_keys=False, width=1000)
        check, why = call([options.flankfilm, "check", path], 120)
        fault = None
        if check == 0:
            accepted += 1
            words = [options.flankfilm, "run", path, "-o", os.path.join(scratch, "results-%d" % i)]
            run, what = call(words + (["-j", "1"] if "study" in tree else []), options.seconds)
            if run is not None and run not in (0, 1, 4):
                fault = "check ok, run ends with %s: %s" % (run, what[-600:])
        elif check == 2:
            refused += 1
        elif check != 1:
            fault = "check ends with %s: %s" % (check, why[-600:])
        if fault:
            bad += 1
            print("%s, %s: %s\n%s\n" % (name, "; ".join(said), path, fault))
        elif not options.keep:
            os.remove(path)
    print("seed %d: %d files, %d accepted, %d refused, %d bad" % (options.seed, options.count, accepted, refused, bad))
    if not options.keep:
        subprocess.run(["rm", "-rf", scratch])
    sys.exit(bad > 0)


main()
