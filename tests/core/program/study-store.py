"""The end of a study is told from its rows on the disk: whatever happens to its files while it runs
is one sentence and an exit code, and the same command then gives what a calm run gives, to the byte.

study-store.py FLANKFILM STUB TOYS...      STUB is preloaded; "none" under a sanitizer
"""
import contextlib
import errno
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

flankfilm, stub = (str(pathlib.Path(a).resolve()) if a != "none" else a for a in sys.argv[1:3])
lab = pathlib.Path(tempfile.mkdtemp())
plugins = lab / "plugins" / "toy"
plugins.mkdir(parents=True)
for toy in sys.argv[3:]:
    (plugins / toy.split("cli-toy-")[1]).symlink_to(pathlib.Path(toy).resolve())
environment = {**os.environ, "FLANKFILM_PLUGIN_PATH": str(plugins.parent)}
cases = 12
failed = 0


def write(name, wave, sweep, outputs="[wave.total, wave.height]"):
    (lab / f"{name}.yaml").write_text(
        f"format: 2\npipeline: {{wave: {{use: toy/wave, amplitude: 2 mm, {wave}}}}}\n"
        f"outputs: {outputs}\nstudy: {{sweep: {{{sweep}}}}}\n"
    )


def start(study, folder, jobs=1, **system):
    """Begins a run; `system` is told to the stub."""
    extra = {"LD_PRELOAD": stub, **{k: str(v) for k, v in system.items()}} if system else {}
    return subprocess.Popen(
        [flankfilm, "run", f"{study}.yaml", f"-j{jobs}", "-o", folder],
        cwd=lab, env={**environment, **extra}, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )


def expect(what, run, code, words):
    global failed
    out, err = run.communicate(timeout=60)
    lines = [line for line in err.splitlines() if line.startswith("error: ")]
    if run.returncode != code or words not in out + err or (code in (1, 2) and len(lines) != 1):
        failed += 1
        print(f"FAIL {what}: code {run.returncode}, expected {code} and {words!r}\n{out}{err}")


def rows(folder):
    journal = lab / folder / "journal.jsonl"
    return journal.read_bytes().count(b"\n") if journal.exists() else 0


def wait_for(folder, count=1):
    end = time.monotonic() + 30
    while rows(folder) < count and time.monotonic() < end:
        time.sleep(0.002)


@contextlib.contextmanager
def paused(run):
    """The process that writes the store waits meanwhile, however long that takes."""
    writer = children(run.pid)[0]
    os.kill(writer, signal.SIGSTOP)
    try:
        yield
    finally:
        os.kill(writer, signal.SIGCONT)


def check_calm(what, folder):
    """The same command goes on, and the table is that of the calm run."""
    expect(f"{what}, again", start("slow", folder), 0, f"{cases} of {cases} cases done")
    if (lab / folder / "table.csv").read_bytes() != (lab / "calm" / "table.csv").read_bytes():
        global failed
        failed += 1
        print(f"FAIL {what}: another table")


def empty(journal):
    os.truncate(journal, 0)


def cut(journal):
    os.truncate(journal, journal.stat().st_size // 2)


def replace(journal):
    shutil.copy(journal, journal.parent / "other")
    os.replace(journal.parent / "other", journal)


def link(journal):
    journal.rename(lab / "elsewhere")
    journal.symlink_to(lab / "elsewhere")


def append(journal):
    with open(journal, "ab") as out:
        out.write(b"{}\n")


def test_changed():
    for how, words in (
        (empty, "was emptied"), (cut, "was cut short"), (os.remove, "was removed"),
        (replace, "was replaced"), (link, "was replaced"), (append, "was written to by another"),
    ):
        name = how.__name__
        run = start("slow", name)
        wait_for(name)
        with paused(run):
            how(lab / name / "journal.jsonl")
        expect(name, run, 1, f'journal.jsonl" {words}')
        if how is link:
            (lab / name / "journal.jsonl").unlink()
        check_calm(name, name)
    # while the last cases run, its arrays are removed
    run = start("slow", "logs")
    wait_for("logs", cases - 3)
    with paused(run):
        (lab / "logs" / "arrays.1.log").unlink()
    expect("arrays removed", run, 1, "logs")
    check_calm("arrays removed", "logs")


def test_written_over():
    """Another plugin is copied over one that runs: what was done before stays, and nothing is taken from a mixture."""
    own = lab / "own" / "toy"
    own.mkdir(parents=True)
    for toy in plugins.iterdir():
        shutil.copy(toy, own)
    before = environment["FLANKFILM_PLUGIN_PATH"]
    environment["FLANKFILM_PLUGIN_PATH"] = str(own.parent)
    run = start("slow", "over")
    wait_for("over", 2)
    with paused(run):
        (own / "wave.so").write_bytes((own / "walk.so").read_bytes())
    expect("overwritten", run, 3, "wave.so was overwritten while the study ran")
    if not 2 <= rows("over") < cases:
        raise SystemExit(f"FAIL {rows('over')} rows of a plugin that was written over")
    (own / "wave.so").write_bytes((plugins / "wave.so").read_bytes())
    check_calm("overwritten", "over")
    # a model that the files of a later case put into a stage; a file that is touched alone does no harm
    shutil.copy(own / "guess.so", own / "brief.so")
    run = start("swap", "swap")
    wait_for("swap", 1)
    os.utime(own / "wave.so")
    wait_for("swap", cases // 2 + 2)
    with paused(run):
        (own / "brief.so").write_bytes((own / "walk.so").read_bytes())
    expect("a model of a later case", run, 3, "brief.so was overwritten while the study ran")
    done = rows("swap")
    if not cases // 2 + 2 <= done < cases:
        raise SystemExit(f"FAIL {done} rows beside a model that was written over")
    (own / "brief.so").write_bytes((own / "guess.so").read_bytes())
    expect("once more", start("swap", "swap"), 0, f"{cases} of {cases} cases done, {done} of them earlier")
    environment["FLANKFILM_PLUGIN_PATH"] = before


def test_lost_start():
    """What all rows have in common is said again: those rows alone run again that have lost bytes of their own."""
    journal = lab / "many" / "journal.jsonl"
    expect("many", start("many", "many"), 0, "300 of 300")
    calm = (lab / "many" / "table.csv").read_bytes()
    lines = journal.read_bytes().splitlines(keepends=True)
    with open(journal, "r+b") as out:
        out.write(bytes(len(lines[0]) - 1))
        out.seek(sum(map(len, lines[:10])) - 1)  # the end of the tenth line: the next one is behind it
        out.write(bytes(1))
    expect("its start is lost", start("many", "many"), 0, "300 of 300 cases done, 298 of them earlier")
    if (lab / "many" / "table.csv").read_bytes() != calm:
        raise SystemExit("FAIL another table after a lost start")


def test_not_a_file():
    for name, make in (
        ("symlink", lambda j: j.symlink_to(lab / "slow.yaml")),
        ("pipe", os.mkfifo),
        ("folder", os.mkdir),
    ):
        place = lab / f"is-{name}"
        place.mkdir()
        (place / ".flankfilm-study").touch()
        make(place / "journal.jsonl")
        expect(name, start("slow", place.name), 2, 'journal.jsonl" is not a regular file')
    if (lab / "slow.yaml").read_text()[:9] != "format: 2":
        raise SystemExit("FAIL the link was followed")


def children(pid):
    try:
        return [int(child) for child in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except OSError:
        return []


def descendants(pid):
    """Of the process that is started, below the one that leads the run: its workers."""
    below = [worker for child in children(pid) for worker in descendants(child)]
    return below or children(pid)


def descriptors(pid):
    for fd in pathlib.Path(f"/proc/{pid}/fd").glob("*"):
        try:
            yield os.readlink(fd)
        except OSError:
            pass


def test_descriptors():
    """No worker holds the store, and what a plugin writes into descriptors fails its case alone."""
    run = start("long", "held", 2)
    wait_for("held", 2)
    run.terminate()
    run.communicate()
    run = start("long", "held", 2)  # which has read the rows of the one before
    wait_for("held", rows("held") + 2)
    held = {of for worker in descendants(run.pid) for of in descriptors(worker)}
    expect("two workers", run, 0, f"{cases} of {cases}")
    held = {os.path.relpath(h, lab / "held") for h in held}
    store = [h for h in held if h == "." or h.startswith(("journal", "arrays"))]
    if store or not held:
        raise SystemExit(f"FAIL workers hold {store}")
    for count, name in ((1, "one"), (2, "two")):
        run = start("scribble", name, count)
        expect(f"scribbled by {count}", run, 4, "3 of 3 cases done: 2 good, 1 failed")
    tables = [(lab / name / "table.csv").read_text() for name in ("one", "two")]
    if tables[0] != tables[1] or "written into a file that is not its own" not in tables[0]:
        raise SystemExit(f"FAIL another table\n{tables}")


def test_system():
    """A system that interrupts, does by halves, cannot lock or cannot write."""
    for name in ("INTERRUPT", "SHORT"):
        expect(name, start("quick", name, **{name: 1}), 0, f"{cases} of {cases} cases done")
        with open(lab / name / "journal.jsonl", "ab") as out:
            out.write(b"half of a line")
        again = start("quick", name, **{name: 1})
        expect(f"{name}, again", again, 0, f"{cases} of {cases} cases done, {cases} of them earlier")
    if (lab / "INTERRUPT" / "table.csv").read_bytes() != (lab / "SHORT" / "table.csv").read_bytes():
        raise SystemExit("FAIL another table")
    refused = start("quick", "sync", REFUSE_fdatasync=errno.EIO)
    expect("a failing disk", refused, 1, "could not be written: Input/output error")
    # a torn tail that cannot be dropped; locks of fcntl, which the store does without
    with open(lab / "SHORT" / "journal.jsonl", "ab") as out:
        out.write(b"half of a line")
    refused = start("quick", "SHORT", REFUSE_ftruncate=errno.EIO)
    expect("a tail that stays", refused, 2, "cannot be used: Input/output error")
    again = start("quick", "SHORT", REFUSE_fcntl=errno.ENOLCK)
    expect("without locks of fcntl", again, 0, f"{cases} of {cases} cases done, {cases} of them earlier")
    for cause in (errno.ENOLCK, errno.EOPNOTSUPP):
        folder = f"lock-{cause}"
        run = start("slow", folder, REFUSE_flock=cause)
        wait_for(folder)
        with paused(run):
            second = start("slow", folder, REFUSE_flock=cause)
            expect("a second run", second, 2, "another run is using the result directory")
        expect("without locks", run, 0, f"{cases} of {cases} cases done")
        if (lab / folder / "journal.jsonl.lock").exists() or rows(folder) != cases:
            raise SystemExit("FAIL a lock is left, or cases were done twice")
    run = start("slow", "killed", REFUSE_flock=errno.ENOLCK)
    wait_for("killed")
    lock = (lab / "killed" / "journal.jsonl.lock").read_text()
    os.kill(int(lock.split()[0]), signal.SIGKILL)
    run.communicate()
    again = start("slow", "killed", REFUSE_flock=errno.ENOLCK)
    expect("a lock left behind", again, 0, f"{cases} of {cases} cases done")


try:
    points = f"wave.amplitude: {{from: 1 mm, to: 2 mm, points: {cases}}}"
    write("slow", "work: 25 ms", points)
    write("long", "work: 60 ms", points)
    write("quick", "count: 5", points)
    write("many", "count: 5", points.replace(str(cases), "300"))
    for model in "guess", "brief":
        (lab / f"{model}.yaml").write_text(f"format: 2\npipeline: {{guess: {{use: toy/{model}}}}}\n")
    files = ["guess.yaml"] * (cases // 2) + ["brief.yaml"] * (cases // 2)
    (lab / "swap.yaml").write_text(
        "format: 2\npipeline: {wave: {use: toy/wave, work: 25 ms}, guess: {use: toy/guess}}\n"
        f"outputs: [wave.total, guess.value]\nstudy: {{zip: {{include: [{', '.join(files)}], "
        f"wave.amplitude: [{', '.join(f'{1 + i / 20} mm' for i in range(cases))}]}}}}\n"
    )
    write("scribble", "count: 3", "wave.end: [good, scribble, good]", "[wave.total, wave.field]")
    expect("calm", start("slow", "calm"), 0, f"{cases} of {cases} cases done")
    test_changed()
    test_written_over()
    test_lost_start()
    test_not_a_file()
    test_descriptors()
    if stub != "none":
        test_system()
finally:
    shutil.rmtree(lab)
sys.exit(failed > 0)
