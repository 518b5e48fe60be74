# SPDX-License-Identifier: GPL-3.0-or-later
"""Each case of a study has its verdict and its reasons in the table, the journal, the JSON, the last
line and the page, and a bad case counts as failed."""
import csv
import json
import re

import lab
import records

# Of seven cases 1 and 2 are good, 3 to 5 doubtful, twice for "residual" and once for "law", one is
# bad and one fails.
STUDY = """
format: 2
pipeline:
  verge: {use: toy/verge}
  wave: {use: toy/wave, amplitude: 2 mm}
outputs: [verge.answer, wave.total]
study:
  zip:
    verge.speed: [1 m/s, 1.5 m/s, 2.5 m/s, 2.2 m/s, 0.1 m/s, 1 m/s, 4 m/s]
    wave.end: [good, good, good, doubtful, good, bad, good]
"""
COUNTS = {"good": 2, "doubtful": 3, "bad": 1, "refused": 0, "failed": 1}
VERDICTS = ["good", "good", "doubtful", "doubtful", "doubtful", "bad", "failed"]
REASONS = [[], [], ["residual"], ["residual"], ["law"], ["residual"], []]
WORDS = "2 good, 3 doubtful (residual 2, law 1), 1 bad (residual 1), 1 failed"


def checksum(data):
    """FNV-1a of 64 bits."""
    value = 0xCBF29CE484222325
    for byte in data:
        value = (value ^ byte) * 0x100000001B3 % 2**64
    return f"{value:016x}"


class Verdicts(lab.Lab):
    def write(self, name, text):
        with open(name, "w", encoding="utf-8") as file:
            file.write(text)

    def run_study(self, name, *words):
        self.write(name + ".yaml", STUDY)
        return self.call("run", name + ".yaml", "-o", name, *words, code=4)

    def check_json(self, answer):
        self.assertEqual(answer["verdict"], "failed")
        self.assertEqual(answer["counts"], COUNTS)
        self.assertEqual(answer["reasons"], [
            {"reason": "residual", "verdict": "doubtful", "cases": 2},
            {"reason": "law", "verdict": "doubtful", "cases": 1},
            {"reason": "residual", "verdict": "bad", "cases": 1}])
        self.assertEqual([case["case"] for case in answer["judged"]], list(range(1, 8)))
        self.assertEqual([case["verdict"] for case in answer["judged"]], VERDICTS)
        self.assertEqual([case["reasons"] for case in answer["judged"]], REASONS)

    def test_warnings_are_reasons(self):
        """What a single run is warned of, in each case whose value it concerns."""
        self.write("warned.yaml", STUDY.replace("  zip:", "  sweep:").split("    verge.speed")[0] +
                   "    wave.amplitude: [2 mm, 7 mm, 6 mm]\n")
        said = self.call("run", "warned.yaml", "-o", "warned")
        self.assertIn("3 of 3 cases done: 3 good (wave.amplitude outside its calibrated range 2)", said)
        with open("warned/table.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["reasons"] for row in rows], ["", *["wave.amplitude outside its calibrated range"] * 2])
        with open("warned/journal.jsonl", encoding="utf-8") as file:
            journal = file.read()
        for value in "7 mm", "6 mm":
            self.assertIn(f"wave.amplitude: {value} is outside the calibrated range", journal)
        self.call("report", "warned")
        with open("warned/report.html", encoding="utf-8") as file:
            self.assertIn("wave.amplitude outside its calibrated range 2", file.read())

    def test_terminal(self):
        for workers in "1", "3":
            said = self.run_study("told-" + workers, "-j", workers)
            self.assertEqual(said.splitlines()[-1],
                             f"7 of 7 cases done: {WORDS}; the column \"reason\" of the table says why")
        self.assertIn(f"7 of 7 cases done, 7 of them earlier: {WORDS}", self.run_study("told-1"))

    def test_files(self):
        self.run_study("kept", "-j", "2")
        with open("kept/table.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["verdict"] for row in rows], VERDICTS)
        self.assertEqual([row["reasons"] for row in rows], [", ".join(r) for r in REASONS])
        found = {record["case"]: record for record in records.read("kept/journal.jsonl")}
        self.assertEqual([found[i + 1]["verdict"] for i in range(7)], VERDICTS)
        self.assertEqual([found[i + 1]["reasons"] for i in range(7)], REASONS)
        with open("kept/journal.jsonl", encoding="utf-8") as file:
            lines = file.read().splitlines()
        said = [line["form"] for line in map(json.loads, lines) if "is" in line]
        self.assertLessEqual(len(said), 2 * len(set(said)))  # by each of two workers
        self.assertEqual(sum('"residual"' in line for line in lines),
                         sum('"residual"' in line and '"is"' in line for line in lines))
        self.check_json(self.read("kept/study.json"))
        self.check_json(json.loads(self.run_study("kept", "--json")))

    def test_page(self):
        self.run_study("shown")
        self.call("report", "shown")
        with open("shown/report.html", encoding="utf-8") as file:
            page = file.read()
        self.assertIn('<h2>Verdict</h2>\n<p class="judgement"><span class="badge bad">failed</span> '
                      'Of 7 cases, 2 are good, 3 doubtful, 1 bad and 1 failed: ', page)
        self.assertIn(f'<p class="note">{WORDS}</p>', page)
        reasons = re.findall(r'<li><b>(\d) of 7 cases</b> (\w+): (\w+): ', page)
        self.assertEqual(reasons[0][1], "bad")  # the worst first
        self.assertEqual(sorted({r[1] for r in reasons}), ["bad", "doubtful"])
        cells = re.findall(r'<td><span class="badge \w+">(\w+)</span></td><td>([^<]*)</td>', page)
        self.assertEqual(cells, [(v, ", ".join(r)) for v, r in zip(VERDICTS, REASONS)])

    def test_worst_first(self):
        """Of two lines the one further beyond its limit comes first, whatever their order."""
        self.write("two.yaml", STUDY.replace("0.1 m/s", "0.002 m/s").replace(
            "good, bad, good]", "doubtful, bad, good]"))
        self.call("run", "two.yaml", code=4)
        case = self.read("results/two/study.json")["judged"][4]
        self.assertEqual(case["reasons"], ["residual", "law"])
        self.write("two.yaml", STUDY.replace("0.1 m/s", "1e-9 m/s").replace(
            "good, bad, good]", "doubtful, bad, good]"))
        self.call("run", "two.yaml", code=4)
        case = self.read("results/two/study.json")["judged"][4]
        self.assertEqual(case["reasons"], ["law", "residual"])

    def test_old_journal(self):
        """Records that say all in each line."""
        self.run_study("old")
        lines = records.read("old/journal.jsonl")
        with open("old/journal.jsonl", "w", encoding="utf-8") as file:
            for line in lines:
                del line["sum"]
                body = json.dumps(line, separators=(",", ":"))[:-1]
                file.write(f'{body},"sum":"{checksum(body.encode())}"}}\n')
        self.assertIn(f"7 of 7 cases done, 7 of them earlier: {WORDS}", self.run_study("old"))
        self.check_json(self.read("old/study.json"))

    def test_refused(self):
        """A case that a model refuses as it is made is known as one that failed."""
        self.write("refused.yaml", "format: 2\npipeline:\n  gears: {use: gear/involute-spur, teeth: [20, 50], "
                   "module: 3 mm, face_width: 20 mm, backlash: 0.14 mm}\n"
                   "outputs: [gears.contact_ratio]\n"
                   "study: {sweep: {gears.pressure_angle: [20 deg, 21 deg, 44 deg, 45 deg]}}\n")
        self.call("run", "refused.yaml", "-o", "refused", "-j", "1", code=4)
        self.assertIn("2 done, 2 failed, 0 to run", self.call("plan", "refused.yaml", "-o", "refused"))
        said = self.call("run", "refused.yaml", "-o", "refused", code=4)
        self.assertIn("4 of 4 cases done, 4 of them earlier: 2 good, 2 failed", said)

    def test_other_studies(self):
        studies = {
            "sample": "sample: {sobol: 4}, sweep: {verge.speed: {from: 2.1 m/s, to: 2.9 m/s}}",
            "stability": "stability: {axes: {verge.speed: [1 m/s, 2.5 m/s]}, outputs: [verge.answer], "
                         "refine: [verge.cells]}",
            "tradeoff": "tradeoff: {outputs: [verge.answer], accuracy: 1 %, repeats: 1, "
                        "reference: {verge.cells: 100, refine: [verge.cells]}, "
                        "candidates: [{verge.speed: 2.5 m/s}, {verge.cells: 10}]}",
        }
        for name, study in studies.items():
            self.write(name + ".yaml", STUDY[:STUDY.index("study:")] + f"study: {{{study}}}\n")
            said = self.call("run", name + ".yaml")
            self.assertRegex(said, r"\n\d+ .*cases done: .*doubtful \(residual ")
            with open(f"results/{name}/table.csv", newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            self.assertIn(("doubtful", "residual"), [(r["verdict"], r["reasons"]) for r in rows])
            counts = self.read(f"results/{name}/study.json")["counts"]
            self.assertEqual(sum(counts.values()), len(rows))
            self.assertEqual(counts["doubtful"], sum(r["verdict"] == "doubtful" for r in rows))

    def test_exports(self):
        self.run_study("out")
        self.call("export", "out", "--to", "csv", "-o", "tables")
        with open("tables/scalars.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["verdict"] for row in rows], VERDICTS)
        self.assertEqual([row["reasons"] for row in rows], [", ".join(r) for r in REASONS])


lab.main()
