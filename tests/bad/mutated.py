# SPDX-License-Identifier: GPL-3.0-or-later
"""Examples with typos: no command crashes, hangs, or ends with a code that is not documented.

   mutated.py FLANKFILM PLUGINS SOURCE_ROOT COUNT [SEED [SECONDS]]
"""
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

flankfilm, plugins, source = (os.path.abspath(path) for path in sys.argv[1:4])
count, seed, seconds = int(sys.argv[4]), *(int(text) for text in sys.argv[5:] + ["20", "120"][len(sys.argv) - 5:])
COMMANDS = {
    "check": ["check"],
    "explain": ["explain"],
    "plan": ["plan"],
    "run": ["run", "-o", "results"],
    "cite": ["cite"],
}
DOCUMENTED = {0, 1, 2, 3, 4}
WRECK = re.compile(r"AddressSanitizer|LeakSanitizer|runtime error:|UndefinedBehavior|crashed during|Assertion")
VALUES = ["1e400", "-1e308", "nan", ".nan", "NaN", ".inf", "-.inf", "null", "~", "''", "[]", "{}", "[[[]]]", "0x10",
          "99999999999999999999999", "1e-320", "-0", "true", "3 parsec", "3 mm mm", "1/0", "4 m/s/s/s", "10 kg^99",
          "250 N/mm um", "é", "\u202e", "\U0001f980", "a: b", "*nobody", "&it 3 mm", "!!str b", "!!binary AAAA", "|",
          "'open", '"\\x00"', "? x", "- - -", "study", "../../../../etc/passwd", "/dev/zero", "/dev/null", "%d%s%n"]


def coarse(text):
    """The same file with less to compute."""
    text = re.sub(r"cells: *\d+", "cells: 32", text)
    text = re.sub(r"steps: *\d+", "steps: 40", text)
    text = re.sub(r"points: *\d+", "points: 2", text)
    return re.sub(r"(sobol|samples|speeds|starts): *\d+", r"\1: 2", text)


def spots(text, pattern):
    return [match.span() for match in re.finditer(pattern, text, re.MULTILINE)]


def put(text, span, new):
    return text[: span[0]] + new + text[span[1]:]


def double_key(draw, text):
    line = draw.choice(text.split("\n"))
    return text.replace(line, line + "\n" + line, 1)


def top_key(draw, text):
    return text + draw.choice(["title: again\n", "x-a: !!str b\n", "format: 3\n", "outputs: [a.b]\n", "study: {}\n",
                               "pipeline: {}\n", "study: {audit: {every: 3}}\n", "include: [case.yaml]\n", "---\na: b\n"])


def value(draw, text):
    places = spots(text, r"(?<=: )[^ \n{\[][^,}\n\]]*")
    return put(text, draw.choice(places), draw.choice(VALUES)) if places else text


def unit(draw, text):
    places = spots(text, r"(?<=[0-9] )[a-zA-Z/%0-9]+")
    return put(text, draw.choice(places), draw.choice(["mmm", "m", "N mm", "K", "rpm", "Pa s", "1/", "µm", "°C"])) if places else text


def word(draw, text):
    span = draw.choice(spots(text, r"[A-Za-z_]{3,}"))
    old = text[span[0]:span[1]]
    at = draw.randrange(len(old))
    return put(text, span, draw.choice([old[:at] + old[at + 1:], old[:at] + old[at] + old[at:], old.upper(), ""]))


def cut(draw, text):
    return text[: draw.randrange(len(text))]


def flip(draw, text):
    raw = bytearray(text.encode("utf-8", "surrogateescape"))
    for _ in range(draw.choice([1, 1, 3, 20])):
        raw[draw.randrange(len(raw))] ^= 1 << draw.randrange(8)
    return raw.decode("utf-8", "surrogateescape")


def drop_line(draw, text):
    lines = text.split("\n")
    del lines[draw.randrange(len(lines))]
    return "\n".join(lines)


def swap_lines(draw, text):
    lines = text.split("\n")
    a, b = draw.randrange(len(lines)), draw.randrange(len(lines))
    lines[a], lines[b] = lines[b], lines[a]
    return "\n".join(lines)


def indent(draw, text):
    return put(text, draw.choice(spots(text, r"^ *")), draw.choice(["\t", " ", "      ", ""]))


def ends_of_lines(draw, text):
    return text.replace("\n", draw.choice(["\r\n", "\r", "\n\n", "\x85"]))


def deep(draw, text):
    depth = draw.choice([50, 1000, 100000])
    return text + "x-deep: " + draw.choice(["[", "{a: "]) * depth + "\n"


def aliases(draw, text):
    rows = ["x-0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1]"]
    rows += [f"x-{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]" for i in range(1, draw.choice([3, 12]))]
    return text + "\n".join(rows + ["pipeline: *a1\n" if draw.random() < 0.3 else ""])


def bracket(draw, text):
    places = spots(text, r"[\[\]{},:]")
    return put(text, draw.choice(places), draw.choice("[]{},:&*!|>?-%@`#"))


def model(draw, text):
    places = spots(text, r"(?<=use: )[a-z0-9/-]+")
    names = ["viscosity/auto", "ehl/dense-newton", "ehl/auto", "nobody/knows", "gear", "dynamics/coupled", "contact/table"]
    return put(text, draw.choice(places), draw.choice(names)) if places else text


def output(draw, text):
    return text + f"outputs: [{draw.choice(['film.*', '*.*', 'film', '.', 'film.h_min, film.h_min', '[]', 'nobody.x', '{a: b}'])}]\n"


def axis(draw, text):
    return text + "study: {sweep: {%s: %s}}\n" % (
        draw.choice(["film.cells", "nobody.x", "film", "outputs", "include", "study", "''", "film.use"]),
        draw.choice(["[]", "[32, 40]", "{from: 1, to: 2}", "{from: 1 m, to: 2 s, points: 3}", "{from: 1, to: 9, points: 1e9}",
                     "{a: {b: c}}", "[[1], {}]", "{from: 0, to: 1, points: 3, spacing: log}", "*x", "[1, 1, !!str 1]"]))


MUTATIONS = [double_key, top_key, value, value, value, unit, word, word, cut, flip, drop_line, swap_lines, indent, ends_of_lines,
             deep, aliases, bracket, model, output, axis]
SETS = ["film.cells=32", "film=", "=", "film.use=", "film.cells=1e99", "pipeline=", "study=", "outputs=[film.*]", "a.b.c.d=1",
        "film={use: [}", "format=1", "include=[case.yaml]", "film.cells=&a 3", "oil=*a", "x" * 5000 + "=1", "film.cells=é"]


def mutant(draw):
    """The folder of a case, and the options of its commands."""
    folder = draw.choice(["", "studies/"])
    name = draw.choice(sorted(n for n in os.listdir(f"{source}/configs/{folder}") if n.endswith(".yaml")))
    with open(f"{source}/configs/{folder}{name}", encoding="utf-8") as stream:
        text = coarse(stream.read()).replace("../", "")
    done = [draw.choice(MUTATIONS) for _ in range(draw.choice([1, 1, 1, 3]))]
    for mutate in done:
        text = mutate(draw, text) or "\n"
    sets = draw.sample(SETS, draw.choice([0] * 6 + [1, 2]))
    lost = draw.random() < 0.1
    return folder + name, [m.__name__ for m in done], text, sets, lost


def lay_out(text, lost):
    for folder in "gears", "lubricants", "surfaces", "contacts", "measured":
        if not lost:
            shutil.copytree(f"{source}/configs/{folder}", folder)
    with open("case.yaml", "w", encoding="utf-8", errors="surrogateescape", newline="") as stream:
        stream.write(text)


def wreck_of(args):
    """How the command went wrong, or None; and its code."""
    environment = dict(os.environ, FLANKFILM_PLUGIN_PATH=plugins, UBSAN_OPTIONS="print_stacktrace=1")
    environment.setdefault("ASAN_OPTIONS", "detect_leaks=1:exitcode=99:allocator_may_return_null=1")
    if args[0] not in ("check", "run"):  # which read the same and look for leaks
        environment["ASAN_OPTIONS"] += ":detect_leaks=0"
    try:
        done = subprocess.run([flankfilm, *args], env=environment, stdin=subprocess.DEVNULL, capture_output=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return "it did not end", None
    said = (done.stdout + done.stderr).decode("utf-8", "replace")
    if done.returncode not in DOCUMENTED or WRECK.search(said):
        return f"code {done.returncode}: {said[-1500:]}", done.returncode
    if done.returncode and not done.stderr and not done.stdout:
        return f"code {done.returncode} without a word", done.returncode
    return None, done.returncode


home = tempfile.mkdtemp()
wrecks, codes = 0, {}
for number in range(count):
    scene, names, changed, options, missing = mutant(random.Random(f"{seed} {number}"))
    place = f"{home}/{number}"
    os.mkdir(place)
    os.chdir(place)
    lay_out(changed, missing)
    for verb, command in COMMANDS.items():
        words = [*command, "case.yaml", *(part for one in options for part in ("--set", one))]
        if verb == "run":
            words += ["-j1"]
        fault, code = wreck_of(words)
        codes[code] = codes.get(code, 0) + 1
        if fault:
            wrecks += 1
            print(f"{place}: {' '.join(words)[:300]}: {scene} after {names}: {fault}", flush=True)
    os.chdir(home)
    if not wrecks:
        shutil.rmtree(place)
if not wrecks:
    shutil.rmtree(home)
tally = ", ".join(f"{number} with code {code}" for code, number in sorted(codes.items(), key=str))
print(f"{count} files by {len(COMMANDS)} commands: {wrecks} crashed or hung; {tally}")
sys.exit(1 if wrecks or not {0, 2} <= set(codes) else 0)
