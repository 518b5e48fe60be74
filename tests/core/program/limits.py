# SPDX-License-Identifier: GPL-3.0-or-later
"""Limits of a file are judged with the error bars, doubts that it accepts are none, and both are told
by terminal, JSON, page and tables.

toy/verge answers 1.01 m and says that it is off by 1 %; at 2.2 m/s its line `residual` is doubtful."""
import base64
import csv
import hashlib
import json
import os

import lab

RUN = """
format: 2
pipeline:
  verge: {use: toy/verge}
outputs: [verge.swing]
limits: {%s}
"""
STUDY = """
format: 2
pipeline:
  verge: {use: toy/verge}
outputs: [verge.swing]
limits: {verge.answer: "> 1005 mm", verge.swing: "< 0.5"}
study:
  sweep: {verge.cells: [100, 10], verge.speed: [2.2 m/s, 0.4 m/s]}
"""
BEGINS = "<!DOCTYPE html><!-- flankfilm -->"
STANDINGS = [  # of 1.01 m +- 0.0101 m, and of the swing, which is 0 and has no bar
    ('verge.answer: "> 0.9 m"', "met"), ('verge.answer: ">0.9999 m"', "met within its bar"),
    ('verge.answer: "> 99.9 cm"', "met"), ('verge.answer: ">= 1.01 m"', "met within its bar"),
    ('verge.answer: "> 1.01 m"', "missed"), ('verge.answer: "> 1.015 m"', "missed"),
    ('verge.answer: "< 1.015 m"', "met within its bar"), ('verge.answer: "< 1.03 m"', "met"),
    ('verge.answer: "< 1 m"', "missed"), ('verge.swing: "< 1e-3"', "met"),
    ('verge.swing: "<= 0"', "met"), ('verge.swing: "< 0"', "missed"), ('verge.answers: "> 0.99 m"', "met"),
]
REFUSED = [
    ('limits={verge.anwser: "> 1 m"}', 9, 'limits: verge (toy/verge) has no output "anwser"; did you mean "answer"?'),
    ('limits={verge: "> 1 m"}', 9, 'limits: "verge" is a stage; write verge.OUTPUT'),
    ('limits={verg.answer: "> 1 m"}', 9, 'limits: there is no stage "verg"; did you mean "verge"?'),
    ('limits={verge.answer: "1 m"}', 23, 'limits.verge.answer: expected "> NUMBER UNIT"'),
    ('limits={verge.answer: ["> 1 m", {}]}', 33, 'limits.verge.answer: expected "> NUMBER UNIT"'),
    ('limits={verge.answer: "> 1 K"}', 23, "limits.verge.answer: \"1 K\" is a temperature"),
    ("limits={verge.answer: []}", 23, 'limits.verge.answer: expected "> NUMBER UNIT"'),
    ("limits=[verge.answer]", 8, "limits: expected a map such as"),
    ("accept={verge.residual: }", 25, "accept.verge.residual: expected the reason"),
    ("accept={verg.residual: x}", 9, 'accept: there is no stage "verg"'),
    ("accept=all", 8, "accept: expected a map such as"),
]


class Limits(lab.Lab):
    def write(self, name, text):
        with open(name + ".yaml", "w", encoding="utf-8") as file:
            file.write(text)
        return name + ".yaml"

    def answer(self, *words, code=0):
        return json.loads(self.call("run", *words, "--json", code=code).splitlines()[0])

    def test_standings(self):
        limits = {}
        for limit, _ in STANDINGS:
            output, asked = limit.split(": ")
            limits.setdefault(output, []).append(asked)
        text = ", ".join(f"{output}: [{', '.join(asked)}]" for output, asked in limits.items())
        found = {f"{one['output']}: \"{one['asked']}\"": one["standing"]
                 for one in self.answer(self.write("all", RUN % text))["limits"]}
        self.assertEqual(found, dict(STANDINGS))

    def test_error_not_known(self):
        """An error that is not known is no error of 0, and stops nothing."""
        file = self.write("coarse", RUN % 'verge.answer: ["< 3 m", "< 1 m"], verge.swing: "< 1"')
        answer = self.answer(file, "--set", "verge.cells=1")
        self.assertEqual([(one["standing"], one["bar"]) for one in answer["limits"]],
                         [("met within its bar", None), ("missed", None), ("met within its bar", None)])
        self.assertIsNone(answer["stages"][0]["quality"]["answer_error"]["value"])
        sweep = "study={sweep: {verge.cells: [1, 100]}}"
        self.call("run", file, "--set", sweep, "--set", "outputs=[verge.swing, verge.known_error]", "-o", "coarse")
        with open("coarse/table.csv", encoding="utf-8") as table:
            self.assertEqual([row["verge.known_error [1]"] for row in csv.DictReader(table)], ["", "0.0001"])
        self.assertIn("+0.9999 +- not known: less than the errors", self.call("compare", "coarse:2", "coarse:1"))

    def test_strict(self):
        for limit, standing in STANDINGS[0], STANDINGS[1], STANDINGS[4]:
            with self.subTest(limit=limit):
                self.answer(self.write("one", RUN % limit), "--strict", code=int(standing != "met"))

    def test_lists_and_series(self):
        file = self.write("list", RUN % 'verge.answer: ["> 1 m", "< 1 m"], verge.answers: "< 0.5 m"')
        answer = self.answer(file)
        self.assertEqual([limit["standing"] for limit in answer["limits"]],
                         ["met within its bar", "missed", "missed"])
        self.assertEqual([limit["value"] for limit in answer["limits"]], [1.01, 1.01, 1])
        self.assertIn("verge.answer", answer["outputs"])  # a limit asks for its output

    def test_measured_bar(self):
        """A bar that twins have measured goes before what the stage estimates; that of a toy without tunable
        settings is 0."""
        file = self.write("measured", RUN % 'verge.swing: "< 0.5", verge.answer: "> 1 m"' + "accuracy: measured\n")
        self.assertEqual([limit["standing"] for limit in self.answer(file)["limits"]], ["met", "met"])

    def test_accept(self):
        file = self.write("doubt", RUN % "")
        doubtful = self.answer(file, "--set", "verge.speed=2.2 m/s", "--strict", code=1)
        self.assertEqual((doubtful["verdict"], doubtful["reasons"]), ("doubtful", ["residual"]))
        words = ("--set", "verge.speed=2.2 m/s", "--set", "accept={verge.residual: seen on the rig}")
        accepted = self.answer(file, *words, "--strict")
        line = accepted["stages"][0]["quality"]["residual"]
        self.assertEqual((accepted["verdict"], line["verdict"], line["accepted"]), ("good", "good", "seen on the rig"))
        self.assertIn("verge.residual = 2.2, limit 2: seen on the rig", self.call("run", file, *words, "-o", "doubt"))
        self.call("report", "doubt")
        with open("doubt/report.html", encoding="utf-8") as page:
            self.assertIn("Doubts that the file accepts: verge.residual (seen on the rig)", page.read())
        self.assertIn('accept: verge has no line "residuum" in this run; did you mean "residual"?',
                      self.call("run", file, "--set", "accept={verge.residuum: x}", "--replace", "-o", "doubt"))

    def test_range_alone_is_no_failure(self):
        """Numbers and the range of a model are two verdicts; --strict is about the numbers."""
        file = self.write("range", RUN % "")
        answer = self.answer(file, "--set", "verge.load=60 N", "--strict")
        self.assertEqual([answer[key] for key in ("verdict", "reasons", "range")], ["good", [], ["reach"]])
        self.assertEqual(answer["stages"][0]["quality"]["reach"]["of"], "range")
        sweep = "study={zip: {verge.speed: [1 m/s, 2.2 m/s], verge.load: [60 N, 1 N]}}"
        said = self.call("run", file, "--set", sweep, "--set", "accept={verge.residuum: x, verge.residual: seen}", "-o",
                         "range", "--strict", code=4)
        self.assertIn('accept: verge has no line "residuum" in this run; did you mean "residual"?', said)
        self.assertIn("2 of 2 cases done: 2 good; outside the range of a model 1 (reach 1); accepted 1 (residual 1)\n", said)
        self.assertIn("--strict: a warning counts as a failure", said)
        with open("range/table.csv", encoding="utf-8") as table:
            self.assertEqual([(row["verdict"], row["range"]) for row in csv.DictReader(table)],
                             [("good", "reach"), ("good", "")])
        self.call("report", "range")
        with open("range/report.html", encoding="utf-8") as page:
            text = page.read()
        self.assertIn("<th>outside its range</th>", text)
        self.assertIn('<span class="badge range">range</span>', text)
        for tag, directive in ("script", "script-src"), ("style", "style-src-elem"):
            body = text.split(f"<{tag}>")[1].split(f"</{tag}>")[0].encode()
            named = base64.b64encode(hashlib.sha256(body).digest()).decode()
            self.assertIn(f"{directive} 'sha256-{named}'", text)
        self.assertNotIn(self.directory, text)  # no path of a disk
        self.template("range")

    def template(self, results):
        os.mkdir("lab")
        self.assertIn("the folder has none of layout.html", self.call("report", results, "--template", "lab", code=2))
        with open("lab/page.css", "w", encoding="utf-8") as file:
            file.write("h1{color:teal}\n")
        for layout, code in (BEGINS + "{{title}}{{page}}", 0), (BEGINS + "{{titel}}{{page}}", 2), ("{{page}}", 2):
            with open("lab/layout.html", "w", encoding="utf-8") as file:
                file.write(layout)
            said = self.call("report", results, "--template", "lab", "-o", "lab.html", code=code)
        self.assertIn('does not begin with "<!DOCTYPE html>"', said)
        with open("lab.html", encoding="utf-8") as file:
            text = file.read()
        self.assertTrue(text.startswith(BEGINS + "flankfilm<section"))
        self.assertNotIn("{{", text)

    def test_compare(self):
        """Of 1.01 +- 0.0101 m and 1.0001 +- 0.0001 m the difference is -0.0099 +- 0.0102 m."""
        file = self.write("designs", STUDY)
        self.call("run", file, "-o", "designs")
        said = self.call("compare", "designs:3", "designs:1", "designs:2", "-o", "side")
        self.call("compare", "designs:3", "designs:1", "designs:2", "-o", "side")  # over its own files
        self.assertIn("-0.0099 +- 0.01", said)
        self.assertIn("less than the errors", said)
        with open("side.csv", encoding="utf-8") as table:
            row = next(row for row in csv.DictReader(table) if row["output of flankfilm"] == "verge.answer")
        self.assertEqual([float(row[name]) for name in ("designs:3", "error of designs:3", "designs:1")],
                         [1.01, 0.0101, 1.0001])
        with open("side.html", encoding="utf-8") as page:
            self.assertIn("less than the errors", page.read())
        self.assertIn("designs: name one of its cases, designs:1 to designs:4",
                      self.call("compare", "designs", "designs:1", code=2))
        self.assertIn("compare needs A B...", self.call("compare", "designs:1", code=2))

    def test_bad_is_not_accepted(self):
        file = self.write("bad", "format: 2\npipeline: {wave: {use: toy/wave, amplitude: 2 mm, end: bad}}\n"
                                 "outputs: [wave.total]\naccept: {wave.residual: never mind}\n")
        self.assertIn("residual", self.call("run", file, "-o", "bad", code=1))

    def test_run_is_told(self):
        file = self.write("told", RUN % 'verge.answer: "< 1 m", verge.swing: "< 1"')
        said = self.call("run", file, "-o", "told").splitlines()
        self.assertEqual(said[1:3], ["of 2 limits 1 missed, 1 met",
                                     "  verge.answer: missed, required is < 1 m, the answer is 1.01 +- 0.01 m"])
        self.call("report", "told")
        with open("told/report.html", encoding="utf-8") as page:
            text = page.read()
        self.assertLess(text.index('<span class="badge bad">missed'), text.index('class="judgement"'))
        self.call("export", "told", "--to", "csv", "-o", "told-csv")
        with open("told-csv/scalars.csv", encoding="utf-8") as table:
            self.assertEqual(next(csv.DictReader(table))["limits"], "missed: verge.answer < 1 m")

    def test_study(self):
        file = self.write("cases", STUDY)
        said = self.call("run", file, "-o", "cases", "-j", "2").splitlines()[-1]
        self.assertIn("4 of 4 cases done: 2 good, 2 doubtful (residual 2); limits: 1 met within its bar, 3 missed", said)
        with open("cases/table.csv", encoding="utf-8") as table:
            self.assertEqual([row["limits"] for row in csv.DictReader(table)],
                             ["missed: verge.answer > 1005 mm", "missed: verge.answer > 1005 mm, verge.swing < 0.5",
                              "met within its bar: verge.answer > 1005 mm", "missed: verge.swing < 0.5"])

    def test_study_is_judged_anew(self):
        """A case that is kept was judged by the limits of its time."""
        file = self.write("anew", STUDY)
        self.call("run", file, "-o", "anew")
        said = self.call("run", file, "-o", "anew", "--set", 'limits={verge.answer: "> 0.5 m", verge.swing: "< 2"}',
                         "--set", "accept={verge.residual: seen}", "--strict").splitlines()[-1]
        self.assertIn("4 of 4 cases done: 4 good; accepted 2 (residual 2); limits: 4 met", said)
        said = self.call("run", file, "-o", "anew", "--set", 'limits={verge.answer: ">500 mm", verge.swing: "< 2.0"}',
                         "--set", "accept={verge.residual: seen}").splitlines()[-1]
        self.assertIn("4 of 4 cases done, 4 of them earlier", said)  # the same limits in other words
        said = self.call("run", file, "-o", "anew", "--strict", code=4)
        self.assertIn("4 of 4 cases done, 4 of them earlier: 2 good, 2 doubtful (residual 2); "
                      "limits: 1 met within its bar, 3 missed", said)
        answer = self.answer(file, "-o", "anew")
        self.assertEqual(answer["limits"], {"met": 0, "met within its bar": 1, "missed": 3})

    def test_limit_of_a_case(self):
        """A limit that cannot be read in a case makes that case invalid."""
        for name, bound in ("one", "> 1 m"), ("two", "> 2 kg"):
            self.write(name, f'format: 2\nlimits: {{verge.answer: "{bound}"}}\n')
        file = self.write("own", "format: 2\npipeline: {verge: {use: toy/verge}}\noutputs: [verge.swing]\n"
                                 "study: {sweep: {include: [one.yaml, two.yaml]}}\n")
        self.call("run", file, "-o", "own", code=4)
        with open("own/table.csv", encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
        self.assertEqual([row["status"] for row in rows], ["ok", "invalid"])
        self.assertIn('limits.verge.answer: "2 kg" is', rows[1]["reason"])

    def test_refused(self):
        file = self.write("refused", RUN % "")
        for setting, column, words in REFUSED:
            with self.subTest(setting=setting):
                said = self.call("check", file, "--set", setting, code=2)
                self.assertIn(f"--set:1:{column}: error: {words}", said)


lab.main()
