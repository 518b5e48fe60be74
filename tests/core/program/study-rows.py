# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases that a table lists, in a file or as rows of standard input that are answered one by one."""
import csv
import json
import os
import signal
import subprocess

import lab

PIPELINE = """
format: 2
pipeline:
  wave: {use: toy/wave, amplitude: 2 mm}
outputs: [wave.total, wave.height]
"""
SWEEP = PIPELINE + """
study:
  zip:
    wave.amplitude: [1 mm, 0.002 m, 3 mm]
    wave.count: [4, 5, 6]
"""
TABLE = '# by hand\n\nwave.amplitude [mm] ; x-who; wave.count\n1;Ada;4\n"0.002 m";"a;""b""";5\n3;;6\n'


class Rows(lab.Lab):
    def write(self, name, text):
        with open(name, "w", encoding="utf-8", newline="") as file:
            file.write(text)

    def table(self, name):
        with open(f"{name}/table.csv", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def listed(self, name, text, code=0, words=()):
        self.write(name + ".csv", text)
        self.write(name + ".yaml", PIPELINE + f"study: {{cases: {name}.csv}}\n")
        return self.call("run", name + ".yaml", "-o", name, *words, code=code)

    def start(self, name, *words):
        self.write("rows.yaml", PIPELINE + "study: {cases: \"-\"}\n")
        return subprocess.Popen([self.program, "run", "rows.yaml", "-o", name, *words], text=True,
                                stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE)

    def feed(self, name, text, code=0, words=()):
        """The answers in the order of the rows, and what the program says."""
        process = self.start(name, *words)
        out, said = process.communicate(text)
        self.assertEqual(process.returncode, code, out + said)
        return sorted(map(json.loads, out.splitlines()), key=lambda a: a["case"]), said

    def test_a_table_is_a_sweep(self):
        """The same cases by their keys, whichever way they are listed."""
        self.write("sweep.yaml", SWEEP)
        self.call("run", "sweep.yaml", "-o", "sweep")
        self.listed("listed", "\ufeff" + TABLE.replace("\n", "\r\n"))
        answers, _ = self.feed("fed", TABLE)
        keys = [row["key"] for row in self.table("sweep")]
        self.assertEqual([row["key"] for row in self.table("listed")], keys)
        self.assertEqual([answer["key"] for answer in answers], keys)
        self.assertEqual(self.table("fed"), self.table("listed"))
        self.assertEqual([float(row["wave.total [m]"]) for row in self.table("listed")],
                         [answer["outputs"]["wave.total"] for answer in answers])

    def test_parts_make_a_whole(self):
        for part in "2/2", "1/2":
            self.listed("parts", TABLE, words=("--shard", part))
        self.assertEqual([row["status"] for row in self.table("parts")], ["ok"] * 3)

    def test_an_empty_field_leaves_the_file(self):
        self.listed("empty", "wave.amplitude, wave.count\n,4\n2 mm,4\n")
        first, second = self.table("empty")
        self.assertEqual(first["key"], second["key"])

    def test_a_separator_in_quotes_is_none(self):
        self.listed("quoted", '"x-a;b", wave.count\n"c;d", 4\n')
        self.assertEqual([row["wave.count"] for row in self.table("quoted")], ["4"])

    def test_tabs_and_quotes_within_quotes(self):
        """A field that is empty leads a line; a quote within quotes is written twice."""
        self.listed("tabs", 'wave.amplitude [mm]\t"wave.count"\t"x-""own"""\n\t4\t\n"2 mm"\t5\t"a\tb"\n')
        self.assertEqual([(row["wave.amplitude"], row["wave.count"]) for row in self.table("tabs")],
                         [("", "4"), ("2 mm", "5")])

    def test_the_head_of_a_table_is_quoted(self):
        """The name of an axis is any text."""
        for count in "4", "5":
            self.write(f"of-{count}.yaml", f"pipeline: {{wave: {{count: {count}}}}}\n")
        self.write("named.yaml", PIPELINE + 'study: {sweep: {\'own, "files"\': {include: [of-4.yaml, of-5.yaml]}}}\n')
        self.call("run", "named.yaml", "-o", "named")
        self.assertEqual([row['own, "files"'] for row in self.table("named")], ["of-4", "of-5"])
        self.assertIn("--all is for single cases", self.call("run", "named.yaml", "--all", code=2))

    def test_what_is_wrong_has_its_place(self):
        for text, place, words in (
                ("wave.amplitude\n", "", "has no case"),
                ("", "", "has no case"),
                ("wave.amplitude, wave.amplitude\n1 mm, 2 mm\n", ":1:17:", "has two columns"),
                ("wave.amplitud\n1 mm\n", ":1:1:", "did you mean \"amplitude\"?"),
                ("wave.amplitude [mn]\n1\n", ":1:1:", "is not known"),
                ("wave.amplitude [mm\n1\n", ":1:1:", "a unit in brackets"),
                ("wave.amplitude,\n1 mm,\n", ":1:16:", "a column needs a name"),
                ("x-who\nAda\n", ":1:1:", "no column names a path"),
                ("wave.amplitude, wave.count\n1 mm, 4\n2 mm\n", ":3:1:", "has 1 fields"),
                ("wave.amplitude, wave.count\n1 mm, 4, 5\n", ":2:10:", "has 3 fields"),
                ("wave.amplitude\n\"1 mm\n", ":2:1:", "begins with a quote, but does not end"),
                ("wave.amplitude\n\"1\" mm\n", ":2:1:", "begins with a quote, but does not end"),
                ("wave.amplitude\n1 mn\n", ":2:1:", "mn"),
                ("wave.count; wave.amplitude\n4; 1 mn\n", ":2:4:", "mn"),
                ("wave.amplitude\n1 mm\0\n", "", "a zero byte")):
            said = self.listed("wrong", text, code=2)
            self.assertIn(words, said)
            self.assertIn(f"wrong.csv{place}" if place else "wrong.csv", said)
        self.write("both.yaml", SWEEP + "  cases: wrong.csv\n")
        self.assertIn("has either a list of cases or a sweep", self.call("check", "both.yaml", code=2))

    def test_check_tries_the_rows(self):
        self.write("tried.csv", "wave.amplitude\n1 mm\n2 mm\nmany\n")
        self.write("tried.yaml", PIPELINE + "study: {cases: tried.csv}\n")
        self.assertIn("tried.csv:4:1", self.call("check", "tried.yaml", code=2))
        answers, _ = self.feed("tried", "wave.amplitude\n1 mm\n2 mm\nmany\n", code=4)
        self.assertIn("many", answers[2]["reason"])

    def test_each_row_is_answered_before_the_next(self):
        """With more workers than rows; a row that is no case is answered, too."""
        process = self.start("asked", "-j", "3")
        process.stdin.write("wave.amplitude [mm], wave.count\n")
        for number, row in enumerate(["1, 4", "many, 4", "1", "2, 5", "1, 4"], 1):
            process.stdin.write(row + "\n")
            process.stdin.flush()
            answer = json.loads(process.stdout.readline())
            self.assertEqual((answer["case"], answer["status"] == "ok"),
                             (number, row not in ("many, 4", "1")))
        out, said = process.communicate()
        self.assertEqual((process.returncode, out), (4, ""))
        self.assertIn("2 failed", said)

    def test_what_was_done_is_answered_from_the_journal(self):
        """After the program was killed; the rows that it had answered are not run again."""
        process = self.start("killed", "-j", "2")
        process.stdin.write("wave.amplitude [mm]\n1\n2\n")
        process.stdin.flush()
        done = [json.loads(process.stdout.readline())["key"] for _ in range(2)]
        process.send_signal(signal.SIGKILL)
        process.communicate()
        self.assertIn("lists no case", self.call("report", "killed", code=2))
        answers, _ = self.feed("killed", "wave.amplitude [mm]\n3\n2\n1\n")
        self.call("report", "killed", "-o", "killed.html")
        self.assertEqual([answer["before"] for answer in answers], [False, True, True])
        self.assertEqual({answer["key"] for answer in answers[1:]}, set(done))
        self.assertEqual([row["case"] for row in self.table("killed")], ["1", "2", "3"])

    def test_the_last_object_with_json(self):
        process = self.start("json", "--json")
        out, said = process.communicate("wave.count\n4\n5")
        lines = [json.loads(line) for line in out.splitlines()]
        self.assertEqual((len(lines), lines[-1]["done"], said), (3, 2, ""))

    def test_what_cannot_be(self):
        self.assertIn("ended before its first line", self.feed("none", "", code=2)[1])
        self.assertIn("longer than 1 MiB", self.feed("long", "wave.count\n" + "4" * 3000000, code=2)[1])
        self.assertIn("cannot be distributed",
                      self.feed("spread", TABLE, code=2, words=("--shard", "1/2"))[1])
        answers, _ = self.feed("zero", "wave.count\n4\0\n", code=4)
        self.assertEqual(answers[0]["status"], "invalid")

    def test_a_pipe_is_no_table(self):
        os.mkfifo("pipe.csv")
        for study in "cases: pipe.csv", "uncertainty: {inputs: {wave.amplitude: {samples: pipe.csv}}, outputs: [wave.total]}":
            self.write("piped.yaml", PIPELINE + f"study: {{{study}}}\n")
            self.assertIn("pipe.csv: it is not a regular file", self.call("check", "piped.yaml", code=2))

    def test_a_dash_of_the_command_line(self):
        self.listed("dash", "wave.count\n4\n")
        for words in "study.cases=-", "study={cases: -}":
            self.assertIn("ok (1 stage)", self.call("check", "dash.yaml", "--set", words))
        self.assertIn("expected the name of a file",
                      self.call("check", "dash.yaml", "--set", "study.cases=[a, b]", code=2))

    def test_others_do_not_read_the_rows(self):
        self.write("rows.yaml", PIPELINE + "study: {cases: \"-\"}\n")
        for verb in "check", "plan", "explain":
            reader, writer = os.pipe()
            try:
                done = subprocess.run([self.program, verb, "rows.yaml"], stdin=reader, timeout=20,
                                      capture_output=True, check=False)
            finally:
                os.close(writer)
                os.close(reader)
            self.assertEqual(done.returncode, 0, done)


lab.main()
