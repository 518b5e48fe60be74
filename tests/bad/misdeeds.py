# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever a plugin does, the program ends with a sentence that names it, and never as if all was well.

   misdeeds.py FLANKFILM BAD_PLUGINS [watched]
"""
import json
import os
import subprocess
import sys
import tempfile

flankfilm, plugins = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
FILES = {"law": plugins + "/viscosity/misdeed.so", "stage": plugins + "/misdeed/stage.so"}
STAGES = {"law": "viscosity", "stage": "point"}
PLACES = {
    "law": ["constructor", "entry", "create", "set", "ready", "service", "eval", "destroy"],
    "stage": ["constructor", "entry", "create", "set", "wire", "ready", "evaluate", "destroy"],
}
# what is done: what the sentence says of it
ENDS = {
    "crash": "crashed during {}: segmentation fault",
    "null-call": "crashed during {}: segmentation fault",
    "abort": "crashed during {}: abort",
    "complain": "crashed during {}: abort",
    "divide": "crashed during {}: arithmetic fault",
    "overflow": "crashed during {}: segmentation fault",
    "trap": "crashed during {}: a floating-point trap that it switched on",
    "exit": "ended the program during {}: it called exit()",
    "quick-exit": "ended the program during {}: it called exit()",
    "_exit": "ended the program during {}: it called _exit()",
    "_Exit": "ended the program during {}: it called _Exit()",
    "exit-group": "ended the program during {}: it called syscall()",
    "execl": "ended the program during {}: it called execl()",
    "execvp": "ended the program during {}: it called execvp()",
    "thread-exit": "ended the program during {}: it called exit()",
    "fork": "broke the rules during {}: it called fork()",
}
# of these it cannot be told any more which of those that take part did them
VAGUE = ["trap", "thread-exit"]

# what verify says of a change, whichever function makes it
CHANGES = {
    "rounding": "changed the rounding mode",
    "flush": "switched the processor to flush small numbers to zero",
    "locale": "changed the locale",
    "folder": "changed the working directory",
    "umask": "changed the mask of new files",
    "handler": "changed a signal handler",
    "mask": "changed which signals are blocked",
    "stack": "changed the stack of the signal handlers",
    "close": "closed or replaced the standard output",
    "redirect": "closed or replaced the standard error output",
    "limit": "changed a resource limit",
    "variable": "changed the environment variables",
    "clear": "changed the environment variables",
    "timer": "set a timer that sends a signal",
    "child": "started another process",
    "fork": "started another process",
    "thread": "left a thread behind",
    "print": 'printed "here I am"',
    "write": 'printed "here I am"',
}
# those that a run finds, too, and sets back
SET_BACK = ["rounding", "flush", "locale", "folder"]

CASE = """format: 2
pipeline:
  viscosity: {use: viscosity/misdeed}
  point: {use: misdeed/stage}
outputs: [point.ln_eta]
"""
FILM = """format: 2
pipeline:
  viscosity: {use: viscosity/misdeed}
  density: {use: density/incompressible, rho0: 850 kg/m3}
  discs: {use: contact/constant, radius: 12.8 mm, entrainment_speed: 4 m/s, slide_roll_ratio: 0.1, load_per_width: 177 N/mm}
"""
CHAIN = """format: 2
pipeline:
  viscosity: {use: viscosity/misdeed}
  early: {use: misdeed/stage, pressure: 0.4 GPa}
  point: {use: misdeed/stage, first: early}
outputs: [early.ln_eta, point.series]
"""
# what a stage writes where it must not: who is blamed, and for what
WRITES = {
    "before 1": ("early", 'wrote before the array of its output "series" during evaluate'),
    "before 100": ("early", 'wrote before the array of its output "series" during evaluate'),
    "behind 1": ("early", 'wrote behind the array of its output "series" during evaluate'),
    "behind 128": ("early", 'wrote behind the array of its output "series" during evaluate'),
    "input 3": ("point", 'changed its input "first.series"'),
    "input -1": ("point", 'wrote before the array of its input "first.series"'),
    "input 40": ("point", 'wrote behind the array of its input "first.series"'),
}
SWEEP = "study: {sweep: {viscosity.alpha: [10 1/GPa, 20 1/GPa]}}\n"
STUDY = CASE + SWEEP

watched = sys.argv[3:] == ["watched"]  # by a sanitizer, whose own ends of a thread and of a process differ
if watched:
    del ENDS["thread-exit"]
failures = []
tried = 0


def run(misdeed, *args):
    environment = dict(os.environ, FLANKFILM_MISDEED=misdeed, FLANKFILM_PLUGIN_PATH=plugins)
    return subprocess.run([flankfilm, *args], env=environment, capture_output=True, text=True, timeout=60)


def hold(what, good, said):
    global tried
    tried += 1
    if not good:
        failures.append(f"{what}: {said}")


def sentence(role, place, what):
    """The words that must stand in the message."""
    phase = {"constructor": "load", "entry": "load", "eval": "evaluate of point"}.get(place, place)
    who = "" if phase == "load" else STAGES[role] + ": "
    words = ENDS[what].format(phase)
    if what not in VAGUE:
        return [f"{who}the plugin {FILES[role]} {words}"]
    return [FILES[role], words.replace(" of point", "")]


def ends_in_json(role, place, what):
    misdeed = f"{role} {place} {what}"
    done = run(misdeed, "run", "case.yaml", "--json")
    said = sentence(role, place, what)
    try:
        answer = json.loads(done.stdout)  # one object
        message = answer["errors"][0]["message"]
        good = answer["exit"] == 3
    except (ValueError, IndexError):
        message, good = "", False
    good = good and done.returncode == 3 and all(words in message for words in said)
    hold(misdeed, good and done.stderr.endswith(f"error: {message}\n"), f"{done.returncode}: {done.stdout} {done.stderr}")


def ends_in_words(role, place, what):
    misdeed = f"{role} {place} {what}"
    done = run(misdeed, "run", "case.yaml", "-o", "words")
    good = done.returncode == 3 and all(words in done.stderr for words in sentence(role, place, what))
    hold(misdeed + " in words", good, f"{done.returncode}: {done.stderr}")


def ends_in_a_study(role, place, what):
    misdeed = f"{role} {place} {what}"
    directory = misdeed.replace(" ", "-")
    done = run(misdeed, "run", "study.yaml", "-j1", "-o", directory)
    with open(directory + "/table.csv", encoding="utf-8") as stream:
        table = stream.read()
    good = done.returncode == 4 and "2 failed" in done.stdout
    good = good and all(table.count(words) == 2 for words in sentence(role, place, what))
    hold(misdeed + " in a study", good, f"{done.returncode}: {done.stdout} {done.stderr} {table}")


def writes_outside(what, stage, says):
    """One sentence, in a study a failed case; of the other stages the results are kept."""
    done = run(f"stage evaluate {what}", "run", "chain.yaml", "--json")
    answer = json.loads(done.stdout)
    message = answer["errors"][0]["message"]
    good = done.returncode == 3 and len(answer["errors"]) == 1 and answer["exit"] == 3
    good = good and message.startswith(f"{stage}: the plugin {FILES['stage']}, or one that serves it (") and message.endswith(says)
    good = good and ("ln_eta" in str(answer["outputs"])) == (stage == "point")
    hold(what, good, done.stdout + done.stderr)
    done = run(f"stage evaluate {what}", "run", "chains.yaml", "-j1", "-o", what.replace(" ", ""))
    with open(what.replace(" ", "") + "/table.csv", encoding="utf-8") as stream:
        table = stream.read()
    hold(what + " in a study", done.returncode == 4 and table.count(says.replace('"', '""')) == 2, done.stdout + done.stderr + table)


def is_set_back(role, place, what):
    """A warning names the plugin, and the results are where they are said to be."""
    misdeed = f"{role} {place} {what}"
    directory = misdeed.replace(" ", "-")
    done = run(misdeed, "run", "case.yaml", "-o", directory)
    good = done.returncode == 0 and FILES[role] in done.stderr and CHANGES[what] in done.stderr
    good = good and os.path.exists(directory + "/result.json")
    hold(misdeed, good, f"{done.returncode}: {done.stdout} {done.stderr}")


def is_verified(role, place, what, says):
    misdeed = f"{role} {place} {what}"
    done = run(misdeed, "verify", FILES[role])
    lines = [line for line in done.stdout.split("\n") if line.startswith("# faulty: ") and says in line]
    hold("verify of " + misdeed, done.returncode == 3 and lines, done.stdout)


def is_kept_from_the_answer(role, place, what):
    """What a plugin prints does not stand in the object of --json."""
    misdeed = f"{role} {place} {what}"
    done = run(misdeed, "run", "case.yaml", "--json")
    try:
        good = json.loads(done.stdout)["status"] == "ok"
    except ValueError:
        good = False
    hold(misdeed, good and done.returncode == 0 and done.stderr == "here I am\n", done.stdout + done.stderr)


def fails_film(what, film, code, says):
    """What a law answers wrongly is the law's, with the pressure, whatever film asks."""
    with open("film.yaml", "w", encoding="utf-8") as stream:
        stream.write(FILM + f"  film: {{use: ehl/{film}}}\noutputs: [film.h_min, film.friction_coefficient]\n")
    done = run(f"law eval {what}", "run", "film.yaml", "-o", "film")
    good = done.returncode == code and FILES["law"] in done.stderr and says in done.stderr
    hold(f"{what} in {film}", good, f"{done.returncode}: {done.stdout} {done.stderr}")


os.chdir(tempfile.mkdtemp())
for name, text in ("case.yaml", CASE), ("study.yaml", STUDY), ("chain.yaml", CHAIN), ("chains.yaml", CHAIN + SWEEP):
    with open(name, "w", encoding="utf-8") as stream:
        stream.write(text)
hold("nothing", run("", "run", "case.yaml", "--json").returncode == 0, "it fails")
for role, places in PLACES.items():
    for place in places:
        for what in ENDS:
            ends_in_json(role, place, what)
        ends_in_words(role, place, "_exit")
for role, place in ("law", "eval"), ("stage", "evaluate"):
    for what in ENDS:
        ends_in_a_study(role, place, what)
for what, (stage, says) in WRITES.items():
    writes_outside(what, stage, says)
for role, places in PLACES.items():
    for place in places:
        is_kept_from_the_answer(role, place, "print")
        is_kept_from_the_answer(role, place, "write")
    for place in places[:-1]:  # at the end of a run nobody looks any more
        for what in SET_BACK:
            is_set_back(role, place, what)
for film in "finite-volume, cells: 96", "control-volume, cells: 96", "film-formula", "inlet-analysis":
    fails_film("infinity", film, 3, "it gave ln_eta inf at 0.3")
    fails_film("no-number", film, 3, "nan at 0.3")
    fails_film("status -77", film, 3, "it gave the status -77")
    fails_film("status 99", film, 3, "it gave the status 99")
    fails_film("status 2", film, 1, "the law found no ln_eta")
done = run("law eval status -77", "run", "case.yaml")
hold("-77 in a stage", done.returncode == 3 and FILES["law"] in done.stderr and "unknown status -77" in done.stderr, done.stderr)
done = run("", "run", "case.yaml", "--plugin-path", "nowhere")
hold("no such folder", done.returncode == 2 and "there is no directory nowhere" in done.stderr, done.stderr)
done = run("", "run", "case.yaml", "--set", "viscosity.use=viscosity/quixotic-zz")
hold("no such model", done.returncode == 2 and 'no model "viscosity/quixotic-zz"' in done.stderr and "viscosity/misdeed" in done.stderr, done.stderr)

hold("verify of nothing", run("", "verify", FILES["law"]).returncode == 0, "it fails")
for what, says in CHANGES.items():
    is_verified("law", "eval", what, says)
for role, places in PLACES.items():
    for place in places:
        is_verified(role, place, "folder", CHANGES["folder"])
is_verified("law", "eval", "limit", "changed a resource limit while calling eval")
is_verified("law", "constructor", "_exit", "ended the program during load: it called _exit(), while loading")
is_verified("law", "eval", "execl", "ended the program while calling eval")
if not watched:
    is_verified("law", "destructor", "crash", "crashed while running its destructors")

# destructors of an object do not run in the program: all is written by then
hold("destructor", run("law destructor crash", "run", "case.yaml", "--json").returncode == 0, "it fails")

print(*failures, sep="\n")
print(f"{len(failures)} of {tried} misdeeds did not end as they must")
sys.exit(1 if failures or tried < 100 else 0)
