# SPDX-License-Identifier: GPL-3.0-or-later
"""What the rows of a load spectrum make together, against sums of the table; rows in a file and in the study itself."""
import csv
import json

import lab

PIPELINE = """
format: 2
pipeline:
  wave: {use: toy/wave, amplitude: 2 mm}
outputs: [wave.total, wave.height]
"""
ROWS = [(3, 4, 5), (2, 5, 1), (1, 4, 14)]  # mm, count, h
TABLE = "time [h]; wave.amplitude [mm]; wave.count\n" + "".join(f"{t};{a};{n}\n" for a, n, t in ROWS)
LIST = "\n".join(f"    - {{time: {t} h, wave.amplitude: {a} mm, wave.count: {n}}}" for a, n, t in ROWS)


class Spectrum(lab.Lab):
    def listed(self, name, cases, below="", code=0, words=()):
        self.write(name + ".yaml", PIPELINE + f"study:\n  cases:{cases}\n{below}\n")
        return self.call("run", name + ".yaml", "-o", name, *words, code=code)

    def table(self, name):
        with open(f"{name}/table.csv", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def refused(self, cases, sentence, below=""):
        said = self.listed("bad", cases, below, code=2)
        self.assertIn(sentence, said)

    def test_the_sums_are_those_of_the_table(self):
        self.write("rows.csv", TABLE)
        totals = [float(row["wave.total [m]"])
                  for row in (self.listed("file", " rows.csv"), self.table("file"))[1]]
        limit = sorted(totals)[1] * 1000 + 1e-6
        said = self.listed("summed", " rows.csv", f"  below: {{wave.total: {limit} mm}}")
        sums, hours = self.read("summed/spectrum.json"), [t for _, _, t in ROWS]
        of, mean = sums["outputs"]["wave.total"], sum(map(float.__mul__, totals, map(float, hours))) / 20
        self.assertAlmostEqual(of["mean"], mean, delta=1e-12 * abs(mean))
        self.assertEqual((of["lowest"], of["lowest_row"]), (min(totals), totals.index(min(totals)) + 1))
        self.assertEqual((of["highest"], of["highest_row"]), (max(totals), totals.index(max(totals)) + 1))
        self.assertEqual(of["values"], totals)
        self.assertEqual((sums["rows"], sums["time"], sums["unit"], sums["missing"]), (3, 72000, "s", 0))
        under = [t for t, total in zip(hours, totals) if total < limit / 1000]
        self.assertEqual(sums["below"][0]["rows"], len(under))
        self.assertAlmostEqual(sums["below"][0]["share"], sum(under) / 20)
        self.assertEqual(len(under), 2)
        self.assertIn("Over the spectrum: 3 rows, 20 h", said)

    def test_a_list_is_a_table(self):
        """The same cases by their keys, and the same sums, as shares too."""
        self.write("rows.csv", TABLE)
        self.listed("table", " rows.csv")
        self.listed("list", "\n" + LIST)
        shares = LIST.replace("5 h", "25 %").replace("14 h", "0.7").replace("1 h", "5 %")
        self.listed("shares", "\n" + shares)
        self.assertEqual(*([row["key"] for row in self.table(name)] for name in ("table", "list")))
        told = [self.read(f"{name}/spectrum.json") for name in ("table", "list", "shares")]
        self.assertEqual(told[0]["outputs"], told[1]["outputs"])
        self.assertEqual(told[2]["unit"], "1")
        self.assertAlmostEqual(told[2]["outputs"]["wave.total"]["mean"], told[0]["outputs"]["wave.total"]["mean"])

    def test_a_row_that_leaves_a_path_out_keeps_the_file(self):
        self.listed("kept", "\n    - {wave.count: 4}\n    - {wave.amplitude: 2 mm, wave.count: 4}")
        first, second = self.table("kept")
        self.assertEqual(first["key"], second["key"])

    def test_series_have_extremes_of_all_rows(self):
        self.listed("list", "\n" + LIST)
        of = self.read("list/spectrum.json")["outputs"]["wave.height"]
        self.assertIsNone(of["mean"])
        self.assertEqual(of["highest_row"], 1)

    def test_a_row_that_fails_is_in_no_sum(self):
        said = self.listed("fails", "\n" + LIST.replace("wave.count: 5", "wave.count: 5, wave.end: fail"), code=4)
        sums = self.read("fails/spectrum.json")
        totals = sums["outputs"]["wave.total"]["values"]
        self.assertIsNone(totals[1])
        self.assertAlmostEqual(sums["outputs"]["wave.total"]["mean"], (5 * totals[0] + 14 * totals[2]) / 19)
        self.assertAlmostEqual(sums["missing"], 0.05)
        self.assertIn("rows with 5 % of the time gave no results", said)

    def test_a_class_of_no_time_is_no_row(self):
        """In a table and in a list, as a time and as a share."""
        self.write("rows.csv", TABLE)
        self.write("empty.csv", TABLE.replace("\n1;", "\n0;7;9\n1;") + "0;8;9\n")
        self.listed("full", " rows.csv")
        empty = LIST.replace("    - {time: 1 h", "    - {time: 0 h, wave.count: 9}\n    - {time: 1 h")
        for name, cases, count in (("table", " empty.csv", 2), ("list", "\n" + empty, 1)):
            said = self.listed(name, cases)
            self.assertIn(f"{count} of {3 + count} classes take no time", said)
            sums = self.read(f"{name}/spectrum.json")
            self.assertEqual((sums["rows"], sums["empty"], sums["time"]), (3, count, 72000))
            self.assertEqual(sums["outputs"], self.read("full/spectrum.json")["outputs"])

    def test_a_row_beyond_the_limits_is_told_and_not_failed(self):
        """The first one, too; what cannot be read, or fails, still fails."""
        idle = "\n    - {time: 80 h, wave.count: 0}\n" + LIST
        for again in range(2):
            said = self.listed("idle", idle)
        self.assertIn("for 80 % of the time, in 1 of 4 rows, nothing can be computed", " ".join(said.split()))
        self.assertIn("row 1: wave.count: 0 is too small", " ".join(said.split()))
        sums = self.read("idle/spectrum.json")
        self.assertEqual((sums["refused"]["rows"], sums["refused"]["row"]), (1, 1))
        self.assertAlmostEqual(sums["refused"]["share"], 0.8)
        totals = [float(row["wave.total [m]"]) for row in self.table("idle")[1:]]
        self.assertAlmostEqual(sums["outputs"]["wave.total"]["mean"],
                               sum(t * total for (_, _, t), total in zip(ROWS, totals)) / 20)
        row = self.table("idle")[0]
        self.assertEqual((row["status"], row["verdict"], float(row["time [s]"])), ("refused", "refused", 288000))
        self.assertIn("too small", row["reason"])
        self.call("check", "idle.yaml")
        self.listed("many", idle.replace("wave.count: 5", "wave.count: many"), code=4)
        self.assertEqual(self.read("many/spectrum.json")["refused"]["rows"], 1)
        self.listed("swept", idle.replace("time: ", "x-time: "), code=2)

    def test_shares_are_held_to_their_digits(self):
        rows = "\n    - {time: A, wave.count: 4}\n    - {time: B, wave.count: 5}\n    - {time: C, wave.count: 6}"
        def of(a, b, c):
            return rows.replace("A", a).replace("B", b).replace("C", c)
        said = self.listed("rounded", of("33.3 %", "33.3 %", "0.333"))
        self.assertIn("the shares of the time sum to 99.9 %", said)
        sums = self.read("rounded/spectrum.json")
        self.assertAlmostEqual(sums["time"], 1)
        self.assertAlmostEqual(sums["stated"], 0.999)
        self.assertAlmostEqual(sums["outputs"]["wave.total"]["mean"], sum(sums["outputs"]["wave.total"]["values"]) / 3)
        self.listed("above", of("33.4 %", "33.4 %", "33.3 %"))
        self.assertNotIn("sum to", self.listed("exact", of("50 %", "2.5e1 %", "25 %")))
        self.refused(of("33.30 %", "33.30 %", "33.30 %"), "the shares of the time sum to 99.9 %")
        self.refused(of("33 %", "33 %", "32 %"), "the shares of the time sum to 98 %")

    def test_json_and_a_second_run_say_the_same(self):
        self.listed("again", "\n" + LIST)
        said = json.loads(self.call("run", "again.yaml", "-o", "again", "--json"))
        self.assertEqual(said["spectrum"], self.read("again/spectrum.json"))
        with open("again/spectrum.csv", encoding="utf-8") as file:
            told = {row["output"]: float(row["mean"]) for row in csv.DictReader(file) if row["mean"]}
        self.assertEqual(told, {name: of["mean"] for name, of in said["spectrum"]["outputs"].items() if of["mean"] is not None})
        self.assertEqual(said["before"], 3)
        self.listed("again", "\n    - {wave.count: 4}")
        self.assertNotIn("spectrum", self.call("run", "again.yaml", "-o", "again"))
        with self.assertRaises(FileNotFoundError):
            self.read("again/spectrum.json")

    def test_the_page_has_the_sums(self):
        self.listed("paged", "\n" + LIST)
        self.call("report", "paged", "-o", "paged.html")
        with open("paged.html", encoding="utf-8") as file:
            self.assertIn("mean over time", file.read())

    def test_what_is_wrong_has_its_place(self):
        self.write("rows.csv", TABLE.replace("[h]", "[%]"))
        self.refused(" rows.csv", "the shares of the time sum to 20 %, not to 100 %")
        self.write("rows.csv", TABLE.replace("\n5;", "\n5 m;"))
        self.refused(" rows.csv", "rows.csv:2:1: error: time: expected a share such as 12 %, or a time such as 300 h")
        self.write("rows.csv", TABLE.replace("\n5;", "\n-5;"))
        self.refused(" rows.csv", "rows.csv:2:1: error: time: expected")
        self.write("rows.csv", "time [h]; wave.count\n0;4\n0;5\n")
        self.refused(" rows.csv", "rows.csv have the time 0")
        self.refused("\n    - {time: 0 h, wave.count: 4}", "all rows have the time 0")
        self.write("rows.csv", TABLE.replace("\n1;", "\n1 %;"))
        self.refused(" rows.csv", "rows.csv:3:1: error: time: shares and times are mixed")
        self.write("rows.csv", TABLE.replace("time [h]", "time [h]; time [s]").replace(";", ";1;", 0))
        self.refused(" rows.csv", "time has two columns")
        self.refused("\n    - {time: 1 h, wave.count: 4}\n    - {wave.count: 5}", "either all rows have a time or none")
        self.refused("\n    - {time: 1 h}", "expected a map from paths to values")
        self.refused("\n    - {wave.count: 4}\n    - 5", "expected a map from paths to values")
        self.refused("\n    - {wave.cont: 4}", "wave.cont")
        self.refused("\n    - {wave.count: 4}", "the cases have no time", "  below: {wave.total: 1 mm}")
        self.refused("\n" + LIST, "wave.totl is not a scalar that the cases give", "  below: {wave.totl: 1 mm}")
        self.refused("\n" + LIST, "wave.height is not a scalar that the cases give", "  below: {wave.height: 1 mm}")
        self.refused("\n" + LIST, "below: wave.total", "  below: {wave.total: 1 N}")
        self.refused("\n" + LIST, "expected a map from scalars to limits", "  below: 1 mm")
        self.write("bad.yaml", PIPELINE + "study: {sweep: {wave.count: [4, 5]}, below: {wave.total: 1 mm}}\n")
        self.assertIn('it needs cases with a column "time"', self.call("run", "bad.yaml", code=2))
        self.write("bad.yaml", PIPELINE + "study:\n  cases:\n    - {wave.count: 4}\n    - {wave.count: many}\n")
        self.assertIn("bad.yaml:9:20: error", self.call("check", "bad.yaml", code=2))


if __name__ == "__main__":
    lab.main()
