# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever a plugin does, the program ends with a sentence that names it, and never as if all was well.

   misdeeds.py FLANKFILM BAD_PLUGINS [all | watched]

Without `all` each misdeed is tried once by a law and once by a stage, in places and by commands that
take turns; with it in every place by every command. `watched`: by a sanitizer, which has ends and an
allocator of its own; there law and stage take turns.
"""
import collections
import concurrent.futures
import json
import os
import subprocess
import sys
import tempfile

flankfilm, plugins = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
everything, watched = "all" in sys.argv[3:], "watched" in sys.argv[3:]
FILES = {"law": plugins + "/viscosity/misdeed.so", "stage": plugins + "/misdeed/stage.so"}
STAGES = {"law": "viscosity", "stage": "point"}
PLACES = {
    "law": ["constructor", "create", "ready", "eval", "destroy"],
    "stage": ["constructor", "create", "wire", "evaluate", "destroy"],
}
MORE_PLACES = {"law": ["entry", "set", "service"], "stage": ["entry", "set", "ready"]}
COMMANDS = ["run", "json", "study", "verify"]


# what ends a run: what the sentence says of it
TOLD = {
    "crash": "crashed during {}: segmentation fault",
    "read-null": "crashed during {}: segmentation fault",
    "null-call": "crashed during {}: segmentation fault",
    "wild": "crashed during {}: segmentation fault",
    "constant": "crashed during {}: segmentation fault",
    "bus": "crashed during {}: bus error",
    "illegal": "crashed during {}: illegal processor instruction",
    "divide": "crashed during {}: arithmetic fault",
    "trap": "crashed during {}: a floating-point trap that it switched on",
    "abort": "crashed during {}: abort",
    "complain": "crashed during {}: abort",
    "assert": "crashed during {}: abort",
    "free-twice": "crashed during {}: abort",
    "free-inside": "crashed during {}: ",  # free may read far from what it is given
    "overflow": "crashed during {}: segmentation fault",
    "thread-crash": "crashed during {}: segmentation fault",
    "thread-abort": "crashed during {}: abort",
    "bare-overflow": "crashed during {}: segmentation fault",
    # what is left of the stack says nothing any more
    "smash": "crashed during {}: segmentation fault",
    "stale-jump": "crashed during {}: segmentation fault",
    "unload": "crashed during {}: segmentation fault",
    **dict.fromkeys(["exit", "quick-exit"], "ended the program during {}: it called exit()"),
    "thread-exit": "ended the program during {}: it called pthread_exit()",
    # no handler sees these: the leading process knows who was running
    **dict.fromkeys(["_exit", "_Exit", "exit-group", "exit-thread", "execl", "execvp", "execve", "raw-exec", "raw-execat"],
                    "ended the program during {}: exit code 0"),
    "raise": "ended the program during {}: signal 15 (Terminated)",
    "kill": "ended the program during {}: signal 9 (Killed), sent by its own code or by a system that is short of memory",
    "stop": "ended the program during {}: signal 19 (Stopped (signal))",
    "killpg": "ended the program during {}: signal 10 (User defined signal 1)",
    "thread-kill": "ended the program during {}: signal 12 (User defined signal 2)",
    "fork": "broke the rules during {}: it called fork()",
}
# a law is known by the address of the fault, or by the calls that led to these ends; a stage, and what has no address
# of its own, together with those that serve it
BY_ADDRESS = ["smash", "stale-jump", "crash", "read-null", "null-call", "wild", "constant", "bus", "illegal", "divide", "overflow"]
BY_CALLS = ["abort", "complain", "assert", "free-twice", "free-inside", "exit", "quick-exit", "fork"]
# tried by each command
STACK = ["smash", "stale-jump", "unload", "raw-exec", "stop"]
# what a run sets back and warns of
SET_BACK = {
    "rounding": "changed the rounding mode",
    "flush": "switched the processor to flush small numbers to zero",
    "locale": "changed the locale",
    "folder": "changed the working directory",
}
# what is kept from the answer
PRINTED = {"print": 'printed "here I am"', "write": 'printed "here I am"'}
# what a run does not see and does not suffer from: `verify` tells it
HIDDEN = {
    "thread": "left a thread behind",
    **dict.fromkeys(["vfork", "child", "popen", "spawn"], "started another process"),
    "umask": "changed the permission mask of new files",
    **dict.fromkeys(["handler", "action"], "changed a signal handler"),
    **dict.fromkeys(["mask", "process-mask"], "changed which signals are blocked"),
    "stack": "changed the stack of the signal handlers",
    **dict.fromkeys(["limit", "stack-limit"], "changed a resource limit"),
    **dict.fromkeys(["nice", "priority"], "changed the priority of the process"),
    **dict.fromkeys(["variable", "put-variable", "unset-variable", "clear"], "changed the environment variables"),
    "close": "closed or replaced the standard output",
    "close-input": "closed or replaced the standard input",
    "redirect": "closed or replaced the standard error output",
    **dict.fromkeys(["timer", "interval", "new-timer"], "set a timer that sends a signal"),
}
# what a sanitizer, its allocator or its layout of the stack ends in another way
OWN_WAY = ["stale-jump", "free-twice", "free-inside", "thread-exit", "stack", "bare-overflow"]

CASE = """format: 2
pipeline:
  viscosity: {use: viscosity/misdeed}
  point: {use: misdeed/stage}
outputs: [point.ln_eta]
"""
CHAIN = """format: 2
pipeline:
  viscosity: {use: viscosity/misdeed}
  early: {use: misdeed/stage, pressure: 0.4 GPa}
  point: {use: misdeed/stage, first: early}
outputs: [early.ln_eta, point.series]
"""
SWEEP = "study: {sweep: {viscosity.alpha: [10 1/GPa, 20 1/GPa]}}\n"
LIMITED = "study: {sweep: {viscosity.alpha: [10 1/GPa, 20 1/GPa]}, time_limit: 5 s, memory_limit: 200}\n"
FILM = """format: 2
pipeline:
  viscosity: {use: viscosity/misdeed}
  density: {use: density/incompressible, rho0: 850 kg/m3}
  discs: {use: contact/constant, radius: 12.8 mm, entrainment_speed: 4 m/s, slide_roll_ratio: 0.1, load_per_width: 177 N/mm}
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

failures = []
counts = collections.Counter()


def run(misdeed, *args):
    limit = {"FLANKFILM_VERIFY_LIMIT": "2"} if misdeed.endswith(" stop") else {}  # s for each of its tests
    # what a plugin leaves behind that does such things proves nothing
    sanitizer = {"ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":detect_leaks=0"}
    environment = dict(os.environ, **limit, **sanitizer, FLANKFILM_MISDEED=misdeed, FLANKFILM_PLUGIN_PATH=plugins)
    return subprocess.run([flankfilm, *args], env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120)


def hold(what, good, said, column="other"):
    counts[column] += 1
    if not good:
        failures.append(f"{what}: {said}")


def read(path):
    if not os.path.exists(path):
        return ""
    with open(path, encoding="utf-8") as stream:
        return stream.read()


def answer(done):
    """The one object on stdout; {} when it is something else."""
    try:
        return json.loads(done.stdout)
    except ValueError:
        return {}


def sentence(role, place, what):
    """What must stand in the message."""
    phase = {"constructor": "load", "entry": "load", "eval": "evaluate"}.get(place, place)
    if phase == "load":
        who = f"the plugin {FILES[role]}"
    elif place == "eval" and what in BY_ADDRESS + BY_CALLS:
        who, phase = f"viscosity: the plugin {FILES[role]}", "evaluate of point"
    elif role == "stage" and place not in ["create", "set"] and what not in ["exit", "quick-exit", "fork"] or place == "eval":
        who = f"point: the plugin {FILES['stage']}, or one that serves it (viscosity: the plugin {FILES['law']}),"
    else:
        who = f"{STAGES[role]}: the plugin {FILES[role]}"
    return f"{who} {TOLD[what].format(phase)}"


def all_in(words, text):
    return all(word in text for word in words)


def values(table):
    """The columns of a study's table that hold numbers of the case."""
    rows = [line.split(",")[:5] for line in table.splitlines()]
    return rows[:1] + [row[:4] + [round(float(row[4] or "nan"), 12)] for row in rows[1:] if len(row) == 5]


def is_told(role, place, what, command, done, directory):
    said = sentence(role, place, what)
    unclear = "one that serves it" in said and "crashed" in TOLD[what] and what != "trap"
    tried = f"; viscosity: the plugin {FILES['law']} fails flankfilm verify --only guards" if role == "law" else "; flankfilm verify shows for each whether"
    words = [said] + [tried] * unclear
    if command == "json":
        message = (answer(done).get("errors") or [{"message": ""}])[0]["message"]
        return done.returncode == 3 and answer(done)["exit"] == 3 and all_in(words, message) and done.stderr.endswith(f"error: {message}\n")
    if command == "study" and done.returncode == 4:
        table = read(directory + "/table.csv")
        return "2 failed" in done.stdout and table.count(said) == 2
    if command == "verify":  # which calls laws past the engine, and sees what has come of it
        lines = [line for line in done.stdout.split("\n") if line.startswith("# faulty: ")]
        came = ["crashed while", "ended the program", "started another process", "hung while", said.split(": ")[-1]]
        return done.returncode == 3 and any(word in line for word in came for line in lines)
    return done.returncode == 3 and all_in(words, done.stderr)


def is_right(what, command, done, directory):
    """The answer is that of a run without a misdeed, where it is said to be."""
    if what == "close" and done.returncode != 0:  # nothing can be written then; who did it, nobody knows
        return done.returncode == 1 and "the output could not be written" in done.stderr
    if command == "json":
        return done.returncode == 0 and answer(done).get("outputs") == answers["json"]
    if command == "study":
        return done.returncode == 0 and values(read(directory + "/table.csv")) == answers["study"]
    return done.returncode == 0 and os.path.exists(directory + "/result.json")


def attempt(role, place, what, command):
    """One misdeed by one command."""
    misdeed = f"{role} {place} {what}"
    directory = f"{misdeed} {command}".replace(" ", "-")
    arguments = {
        "run": ["run", "case.yaml", "-o", directory],
        "json": ["run", "case.yaml", "--json"],
        "study": ["run", "study.yaml", "-j1", "-o", directory],
        "verify": ["verify", FILES[role]],
    }[command]
    try:
        done = run(misdeed, *arguments)
    except subprocess.TimeoutExpired:
        return hold(f"{misdeed} by {command}", False, "it hangs", command)
    changes = {**SET_BACK, **PRINTED, **HIDDEN}
    if what in TOLD:
        good = is_told(role, place, what, command, done, directory)
        if what == "raise" and command == "study":  # workers leave this signal to the process that leads them
            good = good or is_right(what, command, done, directory)
    elif command == "verify":
        said = [line for line in done.stdout.split("\n") if line.startswith("# faulty: ")]
        good = done.returncode == 3 and any(changes[what] in line for line in said)
    else:
        good = is_right(what, command, done, directory)
        if what in SET_BACK and command in ("run", "json") and place != "destroy":  # nobody looks any more
            good = good and all_in([FILES[role], SET_BACK[what]], done.stderr + done.stdout)
    said = f"{done.returncode}: {done.stdout[-1500:]} {done.stderr} {read(directory + '/table.csv') if command == 'study' else ''}"
    return hold(f"{misdeed} by {command}", good, said, command)


def writes_outside(what, stage, says):
    """One sentence, in a study a failed case; of the other stages the results are kept."""
    done = run(f"stage evaluate {what}", "run", "chain.yaml", "--json")
    got = answer(done)
    message = got["errors"][0]["message"]
    good = done.returncode == 3 and len(got["errors"]) == 1 and got["exit"] == 3
    good = good and message.startswith(f"{stage}: the plugin {FILES['stage']}, or one that serves it (") and message.endswith(says)
    good = good and ("ln_eta" in str(got["outputs"])) == (stage == "point")
    hold(what, good, done.stdout + done.stderr)
    done = run(f"stage evaluate {what}", "run", "chains.yaml", "-j1", "-o", what.replace(" ", ""))
    table = read(what.replace(" ", "") + "/table.csv")
    hold(what + " in a study", done.returncode == 4 and table.count(says.replace('"', '""')) == 2, done.stdout + done.stderr + table)
    done = run(f"stage evaluate {what}", "verify", FILES["stage"])
    array = says[says.index("of its") if "of its" in says else says.index("its") :].removesuffix(" during evaluate")  # of another length
    hold(what + " by verify", done.returncode == 3 and f"# faulty: stage: the plugin {FILES['stage']} " in done.stdout and array in done.stdout, done.stdout)


def fails_film(what, film, code, says):
    """What a law answers wrongly is the law's, with the pressure, whatever film asks."""
    file = f"film-{film[:5]}.yaml"
    with open(file, "w", encoding="utf-8") as stream:
        stream.write(FILM + f"  film: {{use: ehl/{film}}}\noutputs: [film.h_min, film.friction_coefficient]\n")
    done = run(f"law eval {what}", "run", file, "-o", f"film-{film[:5]}")
    good = done.returncode == code and FILES["law"] in done.stderr and says in done.stderr
    hold(f"{what} in {film}", good, f"{done.returncode}: {done.stdout} {done.stderr}")


def never_ends(role, place, what, says):
    """A case that takes all time or memory fails alone."""
    directory = f"{role}-{what}"
    done = run(f"{role} {place} {what}", "run", "limited.yaml", "-j1", "-o", directory)
    table = read(directory + "/table.csv")
    hold(directory, done.returncode == 4 and table.count(says) >= 2, f"{done.returncode}: {done.stdout} {done.stderr} {table}")


def refuses_places():
    done = run("law eval status -77", "run", "case.yaml")
    hold("-77 in a stage", done.returncode == 3 and all_in([FILES["law"], "unknown status -77"], done.stderr), done.stderr)
    os.makedirs("near/viscosity")
    os.symlink(FILES["law"], "near/viscosity/misdeed.so")
    done = run("law constructor folder", "run", "case.yaml", "--plugin-path", "near")
    hold("a folder, by a relative path", done.returncode == 0 and "changed the working directory" in done.stderr, done.stderr)
    done = run("", "run", "case.yaml", "--plugin-path", "nowhere")
    hold("no such folder", done.returncode == 2 and "no directory nowhere" in done.stderr, done.stderr)
    done = run("", "run", "case.yaml", "--set", "viscosity.use=viscosity/quixotic-zz")
    hold("no such model", done.returncode == 2 and all_in(['no model "viscosity/quixotic-zz"', "viscosity/misdeed"], done.stderr), done.stderr)


def trials():
    """Arguments of attempt."""
    kinds = [what for what in {**TOLD, **SET_BACK, **PRINTED, **HIDDEN} if not (watched and what in OWN_WAY)]
    for role, places in PLACES.items():
        for i, what in enumerate(kinds):
            if watched and i % 2 == (role == "law"):
                continue
            if everything:
                for place in places + (MORE_PLACES[role] if what in TOLD else []):
                    for command in COMMANDS if place in places else ["json"]:
                        yield role, place, what, command
            elif role == "law" and what in STACK:
                yield from ((role, "eval", what, command) for command in COMMANDS[: 4 if what == "smash" else 3])
            else:  # verify takes the time of ten others
                place = places[(i + (role == "law")) % len(places)]
                yield role, place, what, "verify" if i % 9 == 0 or what in HIDDEN and i % 3 == 0 else COMMANDS[i % 3]


os.chdir(tempfile.mkdtemp())
for name, text in {"case": CASE, "study": CASE + SWEEP, "chain": CHAIN, "chains": CHAIN + SWEEP, "limited": CASE + LIMITED}.items():
    with open(name + ".yaml", "w", encoding="utf-8") as stream:
        stream.write(text)
run("", "run", "study.yaml", "-j1", "-o", "right")
answers = {"json": answer(run("", "run", "case.yaml", "--json")).get("outputs"), "study": values(read("right/table.csv"))}
hold("nothing", answers["json"] and len(answers["study"]) == 3, str(answers))
with concurrent.futures.ThreadPoolExecutor(2) as pool:
    list(pool.map(lambda arguments: attempt(*arguments), trials()))
for what, (stage, says) in WRITES.items():
    if everything or what in ("before 1", "behind 128", "input 3"):
        writes_outside(what, stage, says)
for film in ["finite-volume, cells: 96", "control-volume, cells: 96", "film-formula", "inlet-analysis"]:
    fails_film("infinity", film, 3, "it gave ln_eta inf at 0.3")
    if everything or film == "film-formula":
        fails_film("no-number", film, 3, "nan at 0.3")
        fails_film("status -77", film, 3, "it gave the status -77")
        fails_film("status 99", film, 3, "it gave the status 99")
        fails_film("status 2", film, 1, "the law found no ln_eta")
if not watched:  # a sanitizer's heap lies elsewhere
    fails_film("past 4000", "inlet-analysis", 3, f"; viscosity: the plugin {FILES['law']} fails flankfilm verify --only guards")
fails_film("slope 1e30", "finite-volume, cells: 96", 3, "ln_eta does not agree with its slope, which is 1.5e+31 1/GPa at 0.3")
# a table that is none is its maker's fault, before who calls it runs
for table, says in {"null": 'gave a table without its function 1 for its service "viscosity"', "short": "gave a table that claims to have 8 bytes",
                    "wild": "crashed during service: segmentation fault"}.items():
    done = run(f"law table {table}", "run", "case.yaml")
    hold("table", done.returncode == 3 and says in done.stderr and "misdeed.so" in done.stderr and
         "stage.so" not in done.stderr, f"{table} {done.stderr}")
refuses_places()
for role in PLACES:
    hold("verify of nothing", run("", "verify", FILES[role]).returncode == 0, "it fails")
    if everything:
        never_ends(role, PLACES[role][3], "loop", "time limit")
        never_ends(role, PLACES[role][3], "hoard", "crashed during")
    # destructors of an object do not run in the program: all is written by then
    hold("destructor", run(f"{role} destructor crash", "run", "case.yaml", "--json").returncode == 0, "it fails")
if not watched:
    done = run("law destructor crash", "verify", FILES["law"])
    hold("destructor by verify", done.returncode == 3 and "crashed while running its destructors" in done.stdout, done.stdout)

print(*failures, sep="\n")
print(", ".join(f"{counts[column]} by {column}" for column in [*COMMANDS, "other"]))
print(f"{len(failures)} of {sum(counts.values())} misdeeds did not end as they must")
sys.exit(1 if failures or sum(counts.values()) < (80 if watched else 150) else 0)
