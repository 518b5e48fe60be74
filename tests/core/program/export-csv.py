# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of export --to csv hold what the JSON holds, to the last bit, units in their heads."""
import csv
import os

import lab


class Csv(lab.Lab):
    def table(self, name):
        with open(name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_run(self):
        self.call("export", "run", "--to", "csv", "-o", "out")
        outputs = self.outputs("run")
        scalars = self.table("out/scalars.csv")
        self.assertEqual(len(scalars), 1)
        self.assertEqual(float(scalars[0]["sum.sum [m]"]), outputs["sum.sum"]["value"])
        series = self.table("out/wave-t.csv")
        self.assertEqual([float(row["wave.height [m]"]) for row in series],
                         outputs["wave.height"]["data"])
        field = self.table("out/wave-t-x.csv")
        self.assertEqual([float(row["wave.field [m]"]) for row in field],
                         outputs["wave.field"]["data"])
        self.assertEqual(float(field[-1]["wave.x [m]"]), outputs["wave.x"]["data"][-1])
        self.assertEqual(float(field[-1]["wave.time [s]"]), outputs["wave.time"]["data"][-1])

    def test_study(self):
        self.call("export", "study", "--to", "csv")
        rows = self.table("study/results-csv/scalars.csv")
        series = self.table("study/results-csv/wave-t.csv")
        self.assertEqual([len(rows), len(self.records())], [6, 6])
        for row, record in zip(rows, self.records()):
            self.assertEqual(row["wave.end"], record["set"]["wave.end"])
            self.assertEqual(f"{1e3 * float(row['wave.amplitude [m]']):.6g} mm",
                             record["set"]["wave.amplitude"])
            self.assertEqual(row["status"], record["status"])
            self.assertEqual(row["command"], record.get("command", ""))
            own = [part for part in series if part["case"] == row["case"]]
            if record["status"] == "ok":
                self.assertEqual(float(row["wave.total [m]"]), record["outputs"]["wave.total"][1])
                self.assertEqual([float(part["wave.height [m]"]) for part in own],
                                 self.arrays(record)["wave.height"]["data"])
            else:
                self.assertEqual(row["wave.total [m]"], "")
                self.assertEqual(own, [])

    def test_again(self):
        self.call("export", "study", "--to", "csv", "-o", "again")
        self.call("export", "run", "--to", "csv", "-o", "again")
        self.assertFalse(os.path.exists("again/wave-point.csv"))
        self.assertEqual(len(self.table("again/scalars.csv")), 1)

    def test_disk_full(self):
        self.call("export", "run", "--to", "csv", "-o", "full")
        before = {name: os.stat("full/" + name).st_mtime_ns for name in os.listdir("full")
                  if name.endswith(".csv")}
        self.assertIn("scalars.csv", before)
        said = self.call("export", "study", "--to", "csv", "-o", "full", code=1, limit=2)
        self.assertIn("could not be written", said)
        for name, time in before.items():
            self.assertEqual(os.stat("full/" + name).st_mtime_ns, time)
        self.assertFalse([name for name in os.listdir("full") if name.endswith(".part")])


class Errors(lab.Lab):
    def test_no_directory(self):
        said = self.call("export", "nowhere", "--to", "csv", code=2)
        self.assertIn('"nowhere" cannot be opened: No such file or directory', said)

    def test_no_results(self):
        os.mkdir("bare")
        self.assertIn("contains no results", self.call("export", "bare", "--to", "csv", code=2))
        self.assertEqual(os.listdir("bare"), [])

    def test_no_writer(self):
        said = self.call("export", "run", "--to", "cvs", code=2)
        self.assertIn('--to cvs: unknown format; did you mean "csv"?', said)
        said = self.call("export", "run", "--to", "toy/wave", code=2)
        self.assertIn('--to toy/wave: unknown format', said)
        self.assertIn('results can be written as csv or netcdf', said)
        self.assertIn("--to", self.call("export", "run", code=2))

    def test_foreign_directory(self):
        os.mkdir("foreign")
        with open("foreign/note", "w", encoding="utf-8"):
            pass
        self.call("export", "run", "--to", "csv", "-o", "foreign", code=2)
        self.assertEqual(os.listdir("foreign"), ["note"])

    def test_directory_of_results(self):
        for directory in "run", "study":
            before = sorted(os.listdir(directory))
            said = self.call("export", "run", "--to", "csv", "-o", directory, code=2)
            self.assertIn(f'"{directory}" contains the results of a run or a study', said)
            self.assertEqual(sorted(os.listdir(directory)), before)

    def test_directory_of_tables(self):
        """A run leaves them alone; another export replaces them."""
        self.call("export", "run", "--to", "csv", "-o", "tables")
        before = sorted(os.listdir("tables"))
        said = self.call("run", "run.yaml", "-o", "tables", code=2)
        self.assertIn('"tables" is a table directory of flankfilm', said)
        self.assertEqual(sorted(os.listdir("tables")), before)
        self.call("export", "run", "--to", "csv", "-o", "tables")

    def test_broken_json(self):
        os.mkdir("broken")
        with open("broken/result.json", "w", encoding="utf-8") as file:
            file.write('{"outputs":{"wave.height":{"unit":"m","dims":["t"],"shape":[3],"data":[1,')
        self.assertIn("cannot be read", self.call("export", "broken", "--to", "csv", code=2))
        with open("broken/result.json", "w", encoding="utf-8") as file:
            file.write('{"stages":[],"outputs":{"wave.height":{"unit":"m","dims":["t"],'
                       '"shape":[3],"data":[1,2]}}}')
        self.assertIn("numbers of wave.height", self.call("export", "broken", "--to", "csv", code=2))

    def test_unfinished_study(self):
        os.mkdir("half")
        for name in (".flankfilm-study", "study.json", "journal.jsonl"):
            with open("study/" + name, encoding="utf-8") as source:
                with open("half/" + name, "w", encoding="utf-8") as copy:
                    copy.writelines(source.readlines()[:2])
        self.assertIn("half/arrays.1.log, cannot be read: No such file",
                      self.call("export", "half", "--to", "csv", "-o", "half-out", code=2))
        os.symlink(os.path.abspath("study/arrays.1.log"), "half/arrays.1.log")
        self.call("export", "half", "--to", "csv", "-o", "half-out")
        with open("half-out/scalars.csv", encoding="utf-8") as file:
            self.assertEqual(file.read().count("not run"), 4)


lab.main()
