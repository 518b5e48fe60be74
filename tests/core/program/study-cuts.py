# SPDX-License-Identifier: GPL-3.0-or-later
"""Power cuts: tails of half of a study's files are cut by up to 5000 bytes and blocks of half of them become zeros. Of the
rows those alone are lost whose bytes were; each runs again, and the table is that of a calm run.

    python3 study-cuts.py FLANKFILM PLUGINS [CASES CUTS sqlite]

With `sqlite` the same is done to a file of SQLite of such rows, one commit each (WAL, synchronous=NORMAL): the gate of
docs/architecture.md. Its writer ends without closing the file, as at a power cut, or closes it.
"""
import os
import random
import re
import shutil
import sqlite3
import struct
import subprocess
import sys
import tempfile
import time

STUDY = """
format: 2
pipeline:
  oil: {{use: lubricant/grade, grade: ISO VG 220}}
outputs: [oil.eta0, oil.alpha, oil.rho0]
study:
  sweep:
    oil.density_15: {{from: 850 kg/m3, to: 1000 kg/m3, points: {}}}
    oil.temperature: {{from: 40 degC, to: 120 degC, points: 25}}
"""
BLOCK = 4096


def damage(seed, folder, names):
    """{name: [(from, to)]} of the bytes that are cut off or zeroed; the first cut takes the start of all files"""
    rng = random.Random(seed)
    hit = {}
    for name in names:
        path, hit[name] = os.path.join(folder, name), []
        if rng.random() < 0.5:
            size = os.path.getsize(path)
            left = max(0, size - rng.randint(1, 5000))
            os.truncate(path, left)
            hit[name].append((left, size))
        if rng.random() < 0.5 or seed == 0:
            at = rng.randrange(max(1, os.path.getsize(path))) // BLOCK * BLOCK if seed else 0
            with open(path, "r+b") as file:
                file.seek(at)
                file.write(bytes(min(BLOCK, os.path.getsize(path) - at)))
            hit[name].append((at, at + BLOCK))
    return hit


def overlap(begin, end, hit):
    return any(begin < to and start < end for start, to in hit)


def tell(name, cuts, total):
    more = [max(0, lost - hit) for lost, hit in cuts]
    print(f"{name}: {sum(one > 0 for one in more)} of {len(cuts)} cuts lose rows whose bytes stand, {sum(more)} rows in all, "
          f"at most {max(more)}; {sum(lost for lost, _ in cuts)} lost and {sum(hit for _, hit in cuts)} hit; "
          f"all lost {sum(lost == total for lost, _ in cuts)} times")
    return sum(more)


def cut_journal(run, count, cuts):
    found = []
    calm = run("calm")
    assert f"{count} of {count} cases done" in calm, calm
    with open("calm/table.csv", "rb") as file:
        table = file.read()
    for seed in range(cuts):
        shutil.copytree("calm", "cut")
        with open("cut/journal.jsonl", "rb") as file:
            lines = file.read().splitlines(keepends=True)
        hit, at, rows = damage(seed, "cut", ["journal.jsonl", "study.json", "table.csv"])["journal.jsonl"], 0, 0
        for line in lines:
            rows += overlap(at, at + len(line), hit)
            at += len(line)
        said = run("cut")
        done = re.search(r"cases done(?:, (\d+) of them earlier)?", said)
        found.append((count - int(done[1] or 0), rows))
        with open("cut/table.csv", "rb") as file:
            assert file.read() == table, f"another table after cut {seed}: {said}"
        shutil.rmtree("cut")
    return tell("journal", found, count)


def write_sqlite(count, closes):
    db = sqlite3.connect("rows/s.db", isolation_level=None)
    db.executescript("PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL;"
                     "CREATE TABLE record(key INTEGER, number INTEGER, status TEXT, own TEXT, eta0 REAL, alpha REAL, rho0 REAL);"
                     "CREATE INDEX by_key ON record(key)")
    rng, begin = random.Random(1), time.process_time()
    for i in range(count):
        db.execute("INSERT INTO record VALUES(?,?,?,?,?,?,?)",
                   (rng.getrandbits(63), i, "ok", f'["850.07503751875936 kg/m3","{40 + i % 25 * 3.2} degC"]', 0.1 + 1e-7 * i, 2e-8, 850.0))
    print(f"  {1e3 * (time.process_time() - begin) / count:.3f} ms of CPU a row with its commit", flush=True)
    if closes:
        db.close()
    os._exit(0)


def cut_sqlite(count, cuts, closes):
    shutil.rmtree("rows", ignore_errors=True)
    os.mkdir("rows")
    writer = os.fork()
    if writer == 0:
        write_sqlite(count, closes)
    os.waitpid(writer, 0)
    names, found = [name for name in sorted(os.listdir("rows")) if not name.endswith("-shm")], []
    places = []
    for name in names:
        with open(f"rows/{name}", "rb") as file:
            whole = file.read()
        known = {0.1 + 1e-7 * i: i for i in range(count)}
        for found_at in re.finditer(re.escape(struct.pack(">d", 0.1)[:2]), whole):
            at = found_at.start()
            i = known.get(struct.unpack(">d", whole[at:at + 8])[0]) if at + 8 <= len(whole) else None
            if i is not None:
                places.append((i, name, at - 80, at + 40))
    for seed in range(cuts):
        shutil.copytree("rows", "cut", ignore=shutil.ignore_patterns("*-shm"))
        hit, got = damage(seed, "cut", names), set()
        rows = {i for i, name, begin, end in places if overlap(begin, end, hit[name])}
        try:
            for number, eta0 in sqlite3.connect("cut/s.db").execute("SELECT number, eta0 FROM record"):
                if number is not None and eta0 == 0.1 + 1e-7 * number:
                    got.add(number)
        except sqlite3.DatabaseError:
            pass
        found.append((count - len(got), len(rows)))
        shutil.rmtree("cut")
    tell("SQLite, " + ("closed" if closes else "running"), found, count)


def main(program, plugins, count=500, cuts=6, also=""):
    program, environment = os.path.abspath(program), {**os.environ, "FLANKFILM_PLUGIN_PATH": os.path.abspath(plugins)}
    count, cuts = int(count) // 25 * 25, int(cuts)
    with tempfile.TemporaryDirectory() as lab:
        os.chdir(lab)
        with open("study.yaml", "w", encoding="utf-8") as file:
            file.write(STUDY.format(count // 25))
        more = cut_journal(lambda folder: subprocess.run([program, "run", "study.yaml", "-j", "1", "-o", folder], env=environment,
                                                         check=True, capture_output=True, text=True).stdout, count, cuts)
        for closes in (False, True) if also else ():
            cut_sqlite(count, cuts, closes)
        os.chdir("/")
    return more > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
