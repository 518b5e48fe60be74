# SPDX-License-Identifier: GPL-3.0-or-later
"""A result directory never mixes inputs, replaces nothing unawares, and holds no page that is older
than its data; --strict counts a doubt as a failure."""
import json
import os
import shutil
import signal
import subprocess
import time

import lab

PAIR = """
format: 2
pipeline:
  wave: {use: toy/wave, amplitude: 2 mm}
  sum: {use: toy/sum, wave: wave}
outputs: [sum.sum, wave.height]
"""
SWEEP = PAIR + "study: {sweep: {wave.count: [2, 3, 4]}}\n"


class Directory(lab.Lab):
    def setUp(self):
        self.before = os.getcwd()
        os.mkdir(self.id())
        os.chdir(self.id())

    def tearDown(self):
        os.chdir(self.before)

    def write(self, name, text):
        with open(name, "w", encoding="utf-8") as file:
            file.write(text)

    def names(self, directory):
        return sorted(os.listdir(directory))

    def test_variants_stand_side_by_side(self):
        self.write("pair.yaml", PAIR)
        self.call("run", "pair.yaml")
        with open("results/pair/result.json", "rb") as file:
            before = file.read()
        said = self.call("run", "pair.yaml", "--set", "wave.amplitude=3 mm", "--set", "sum.use=toy/sum")
        self.assertIn("results in results/pair,wave.amplitude=3mm,sum.use=toy-sum\n", said)
        with open("results/pair/result.json", "rb") as file:
            self.assertEqual(file.read(), before)
        long = [word for i in range(20) for word in ("--set", f"title=a title of some length {i}")]
        said = self.call("run", "pair.yaml", *long)
        other = self.call("run", "pair.yaml", *long, "--set", "title=b")
        names = [text.split("results in ")[1].splitlines()[0] for text in (said, other)]
        self.assertNotEqual(*names)
        for name in names:
            self.assertLess(len(name), 200)
            self.assertTrue(os.path.exists(name + "/result.json"))

    def test_same_file_is_replaced_with_a_sentence(self):
        self.write("pair.yaml", PAIR)
        self.call("run", "pair.yaml")
        self.write("results/pair/note.txt", "mine")
        self.write("results/pair/mine.part", "mine")
        self.assertNotIn("replaced", self.call("run", "pair.yaml"))
        self.write("pair.yaml", PAIR.replace("wave.height", "wave.field"))
        self.assertIn("replaced (other outputs, or ", self.call("run", "pair.yaml"))
        self.assertIn("wave.field.npy", self.names("results/pair"))
        self.write("pair.yaml", PAIR.replace("2 mm", "5 mm"))
        self.assertIn("replaced (wave.amplitude: 2 mm -> 5 mm)\n", self.call("run", "pair.yaml"))
        self.assertNotIn("wave.field.npy", self.names("results/pair"))
        for mine in "note.txt", "mine.part":
            self.assertIn(mine, self.names("results/pair"))
        answer = json.loads(self.call("run", "pair.yaml", "-o", "results/pair", "--json", "--set", "wave.count=3"))
        self.assertIn("wave.count: 8 -> 3", answer["warnings"][-1]["message"])

    def test_other_file_is_refused(self):
        os.mkdir("a")
        os.mkdir("b")
        self.write("a/pair.yaml", PAIR)
        self.write("b/pair.yaml", PAIR.replace("2 mm", "5 mm"))
        self.call("run", "a/pair.yaml")
        with open("results/pair/result.json", "rb") as file:
            before = file.read()
        said = self.call("run", "b/pair.yaml", code=2)
        self.assertIn("holds the results of another file, " + os.path.realpath("a/pair.yaml"), said)
        self.assertIn("--replace", said)
        with open("results/pair/result.json", "rb") as file:
            self.assertEqual(file.read(), before)
        self.assertIn("(the results belong to ", self.call("run", "b/pair.yaml", "--replace"))
        self.assertIn("0.005", str(self.read("results/pair/result.json")["stages"]))
        shutil.move("b", "moved")  # a file that is not there any more is taken for this one
        self.write("moved/pair.yaml", PAIR)
        self.assertIn("wave.amplitude: 5 mm -> 2 mm", self.call("run", "moved/pair.yaml"))

    def test_no_page_is_older_than_its_data(self):
        for name, text in (("pair", PAIR), ("sweep", SWEEP)):
            self.write(name + ".yaml", text)
            self.call("run", name + ".yaml")
            self.write(f"results/{name}/own.html", "mine")
            self.call("report", f"results/{name}")
            self.call("report", f"results/{name}", "-o", f"results/{name}/page.html")
            self.call("report", f"results/{name}", "-o", name + ".html")
            self.call("export", f"results/{name}", "--to", "csv")
            self.call("export", f"results/{name}", "--to", "csv", "-o", f"results/{name}/kept")
            self.write(f"results/{name}/kept/own.csv", "mine")
            self.write(f"results/{name}/page.html", "my words")
            said = self.call("run", name + ".yaml")
            self.assertIn("report.html, results-csv", said)
            left = self.names(f"results/{name}")
            self.assertNotIn("report.html", left)
            self.assertNotIn("results-csv", left)
            self.assertNotIn(".flankfilm-made", left)
            for mine in "own.html", "page.html", "kept":
                self.assertIn(mine, left)
            self.assertEqual(self.names(f"results/{name}/kept"), ["own.csv"])
            self.assertTrue(os.path.exists(name + ".html"))

    def start(self, *words):
        return subprocess.Popen([self.program, *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def test_killed_run(self):
        """What was there stays whole until the new results are."""
        self.write("pair.yaml", PAIR)
        self.call("run", "pair.yaml")
        with open("results/pair/result.json", "rb") as file:
            before = file.read()
        self.write("pair.yaml", PAIR.replace("2 mm", "5 mm, work: 20 s"))
        for number in signal.SIGKILL, signal.SIGINT:
            process = self.start("run", "pair.yaml")
            time.sleep(0.5)
            process.send_signal(number)
            process.wait()
            with open("results/pair/result.json", "rb") as file:
                self.assertEqual(file.read(), before)
        os.remove("results/pair/result.json")  # as between its removal and the last rename
        self.assertIn("has not ended, or was interrupted", self.call("report", "results/pair", code=2))
        self.write("pair.yaml", PAIR)
        self.call("run", "pair.yaml")
        self.call("report", "results/pair")

    def test_result_json_comes_last(self):
        """strace sees the old result.json go before any new file gets its name."""
        if not shutil.which("strace"):
            self.skipTest("needs strace")
        self.write("pair.yaml", PAIR)
        self.call("run", "pair.yaml")
        done = subprocess.run(["strace", "-f", "-e", "trace=renameat,unlinkat,read", self.program, "run", "pair.yaml"],
                              capture_output=True, text=True, check=False)
        calls = [line for line in done.stderr.splitlines() if '"' in line and '"/' not in line]
        gone = next(i for i, line in enumerate(calls) if "unlinkat" in line and '"result.json"' in line)
        back = next(i for i, line in enumerate(calls) if "renameat" in line and '"result.json"' in line)
        data = [i for i, line in enumerate(calls) if "renameat" in line and ".npy" in line]
        read = [line for line in calls if "read(" in line and 'format' in line and 'key' in line]
        self.assertTrue(len(read) == 1 and read[0].endswith("= 36"), read)  # not read back: its inputs are the same
        self.assertTrue(data and gone < min(data) and max(data) < back, calls)

    def test_unfinished_study_shows_its_own_cases(self):
        """The table of an earlier input is gone, and its records are not taken for those of now."""
        self.write("sweep.yaml", SWEEP)
        self.call("run", "sweep.yaml")
        self.write("sweep.yaml", SWEEP.replace("2 mm", "4 mm").replace(
            "wave.count: [2, 3, 4]", "wave.count: [2, 3, 4], wave.work: [0 s, 20 s]"))
        process = self.start("run", "sweep.yaml", "-j", "1")
        time.sleep(1)
        process.kill()
        process.wait()
        self.assertFalse(os.path.exists("results/sweep/table.csv"))
        self.call("export", "results/sweep", "--to", "csv", "-o", "tables")
        with open("tables/scalars.csv", encoding="utf-8") as file:
            rows = file.read().splitlines()[1:]
        self.assertEqual(len(rows), 6)
        self.assertIn(",ok,", rows[0])
        self.assertEqual([",not run," in row for row in rows[1:]], [True] * 5)
        self.assertIn("Of 6 cases, 1 are good, 0 doubtful, 0 bad and 0 failed; 5 not run: ", self.page("results/sweep"))

    def test_unfinished_study_of_the_same_cases(self):
        """What they were before the file changed is not what they are: the sweep alone does not tell."""
        self.write("sweep.yaml", SWEEP)
        self.call("run", "sweep.yaml")
        self.write("sweep.yaml", SWEEP.replace("2 mm", "4 mm, work: 20 s"))
        process = self.start("run", "sweep.yaml", "-j", "1")
        time.sleep(0.5)
        process.kill()
        process.wait()
        self.assertIn("Of 3 cases, 0 are good, 0 doubtful, 0 bad and 0 failed; 3 not run: ", self.page("results/sweep"))

    def page(self, directory):
        self.call("report", directory)
        with open(directory + "/report.html", encoding="utf-8") as file:
            return file.read()

    def test_study_of_another_file(self):
        os.mkdir("a")
        self.write("a/sweep.yaml", SWEEP)
        self.write("sweep.yaml", SWEEP.replace("2 mm", "5 mm"))
        self.call("run", "a/sweep.yaml")
        self.assertIn("another file", self.call("run", "sweep.yaml", code=2))
        self.assertTrue(os.path.exists("results/sweep/table.csv"))
        said = self.call("run", "sweep.yaml", "--replace")
        self.assertIn("its cases stay in the journal", said)
        shutil.copytree("a", "copy")
        self.assertIn("3 of them earlier", self.call("run", "copy/sweep.yaml", "--replace"))
        self.call("run", "sweep.yaml", "--set", "study=", "-o", "results/sweep", code=2)

    def test_strict(self):
        self.write("pair.yaml", PAIR)
        self.write("sweep.yaml", SWEEP)
        self.call("run", "pair.yaml", "--strict")
        self.call("run", "sweep.yaml", "--strict")
        self.call("check", "pair.yaml", "--strict")
        doubtful = ["--set", "wave.end=doubtful"]
        self.call("run", "pair.yaml", *doubtful)
        self.call("run", "sweep.yaml", *doubtful)
        self.assertIn("--strict: a doubtful answer", self.call("run", "pair.yaml", *doubtful, "--strict", code=1))
        self.call("run", "sweep.yaml", *doubtful, "--strict", code=4)
        answer = json.loads(self.call("run", "pair.yaml", *doubtful, "--strict", "--json", code=1))
        self.assertEqual([answer[key] for key in ("exit", "status", "verdict", "reasons")],
                         [1, "ok", "doubtful", ["residual"]])
        warning = answer["warnings"][0]
        self.assertEqual([warning["file"], warning["line"], warning["column"]], ["pair.yaml", 4, 3])
        self.assertIn("residual is 0.001, limit 1e-06: what is left over", warning["message"])
        answer = json.loads(self.call("run", "sweep.yaml", *doubtful, "--strict", "--json", code=4))
        self.assertEqual([answer["exit"], answer["verdict"]], [4, "doubtful"])
        self.call("run", "pair.yaml", "--set", "wave.end=noisy")
        self.call("run", "pair.yaml", "--set", "wave.end=noisy", "--strict", code=1)
        self.write("odd.yaml", SWEEP.replace("[2, 3, 4]", "{from: 2, to: 4, points: 3, follow: up}"))
        self.call("check", "odd.yaml")
        self.assertIn("a warning counts as an error", self.call("check", "odd.yaml", "--strict", code=2))
        answer = json.loads(self.call("check", "odd.yaml", "--strict", "--json", code=2))
        self.assertIn("follow", answer["warnings"][0]["message"])
        for key in "file", "line", "column":
            self.assertIn(key, answer["warnings"][0])


lab.main()
