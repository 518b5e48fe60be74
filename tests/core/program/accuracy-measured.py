# SPDX-License-Identifier: GPL-3.0-or-later
"""`accuracy: measured`, on a model whose numerical error is known."""
import csv
import os

import lab

FILE = """
format: 2
accuracy: measured
pipeline:
  first: {use: toy/order, before: none, cells: 64}
  last: {use: toy/order, before: first, cells: 128}
outputs: [last.value, last.wave]
"""
SAFETY = 1.25  # Roache's, as the estimate has it


def error_of(cells, tolerance=1e-4, order=2, strength=10):
    return strength * cells ** -order + tolerance


class Measured(lab.Lab):
    def ask(self, *sets, text=FILE, code=0):
        return self.answer(text, sets, code)

    def error(self, answer, output="last.value"):
        return answer["outputs"][output]["error"]

    def test_the_error_is_the_known_one(self):
        """Of a chain of two stages, where both errors fall to a quarter from level to level."""
        bar = self.error(self.ask())
        exact = error_of(64) + error_of(128)
        self.assertAlmostEqual(bar["value"] / (SAFETY * exact), 1, places=6)
        self.assertAlmostEqual(bar["order"], 2, places=6)

    def test_each_setting_has_its_part(self):
        parts = self.error(self.ask())["parts"]
        self.assertEqual(list(parts), ["first.cells", "last.cells", "first.tolerance", "last.tolerance"])
        for name, error in (("first.cells", 10 / 64 ** 2), ("last.cells", 10 / 128 ** 2), ("last.tolerance", 1e-4)):
            self.assertAlmostEqual(parts[name] / (SAFETY * error / 2.00344), 1, places=2)

    def test_errors_that_cancel_are_counted(self):
        """Of equal size and of two signs: the answer is right by chance."""
        bar = self.error(self.ask("last.cells=64", "last.gain=-1"))["value"]
        self.assertGreaterEqual(bar, 2 * 10 / 64 ** 2)

    def test_orders(self):
        for order in (0.5, 1, 1.5):
            text = FILE.replace("cells: 128", f"cells: 128, order: {order}, tolerance: 1e-6 %").replace(
                "cells: 64", "strength: 0, tolerance: 1e-6 %")
            bar = self.error(self.ask(text=text))
            self.assertAlmostEqual(bar["value"] / (SAFETY * error_of(128, 0, order)), 1, places=3)
            self.assertAlmostEqual(bar["order"], order, places=3)

    def test_series(self):
        """Each instant has its bar; points of another grid are interpolated between."""
        for steps in ("auto", "401"):
            answer = self.ask(f"last.steps={steps}")
            wave, bar = answer["outputs"]["last.wave"], self.error(answer, "last.wave")
            count = wave["shape"][0]
            self.assertEqual(len(bar["data"]), count)
            exact = error_of(64) + error_of(128)
            for k, error in enumerate(bar["data"]):
                shape = wave["data"][k] / answer["outputs"]["last.value"]["value"]
                self.assertGreater(error, exact * shape)
            self.assertLess(bar["data"][count // 4], 2 * exact * 3)
            self.assertEqual("last.steps" in bar["parts"], steps != "auto")

    def test_no_bar_is_below_what_the_stage_estimates_there(self):
        """Number by number; what it says without a line of quality is of the model."""
        wave, plain = self.ask()["outputs"]["last.wave"]["data"], self.error(self.ask(), "last.wave")["data"]
        seen = self.error(self.ask("last.seen=0.2"), "last.wave")["data"]
        middle = len(wave) // 2
        self.assertEqual(seen[:middle], plain[:middle])
        for bar, value in zip(seen[middle:], wave[middle:]):
            self.assertAlmostEqual(bar / (0.2 * value), 1, places=9)
        self.assertEqual(self.error(self.ask("last.scatter=0.2"), "last.wave")["data"], plain)

    def test_an_estimate_of_an_error_has_none(self):
        answer = self.ask(text=FILE.replace("last.wave", "last.wave, last.wave_error"))
        self.assertNotIn("error", answer["outputs"]["last.wave_error"])
        text = FILE.replace("last.wave", "last.wave, last.wave_error").replace("measured", "{last.wave_error: 1 %}")
        self.assertIn("it is an error estimate", str(self.ask(text=text, code=2)["errors"]))

    def test_where_no_twin_can_be_had_the_stage_keeps_what_it_estimates(self):
        answer = self.ask("last.seen=0.2", "last.least=128", "last.most=128")
        self.assertIn("wave_seen_error", answer["stages"][-1]["quality"])

    def test_parts_are_of_what_twins_tell(self):
        parts = {name: self.error(self.ask(f"last.seen={seen}"), "last.wave")["parts"] for name, seen in (("plain", 0), ("seen", 0.2))}
        self.assertEqual(parts["seen"], parts["plain"])

    def test_a_series_of_one_point_has_the_bar_of_its_extreme(self):
        """The value is the largest and the least of the wave at 0.75 s."""
        answer = self.ask("last.steady=true", "last.seen=0.2")
        for name in ("last.value", "last.wave"):
            self.assertAlmostEqual(self.error(answer, name)["relative"], 0.2, places=9)

    def test_an_extreme_is_off_by_what_its_series_is_off_there(self):
        """The value is the least of the wave, where that has the error of its steps, too."""
        answer = self.ask("last.steps=401")
        wave = answer["outputs"]["last.wave"]["data"]
        bar = self.error(answer, "last.wave")["data"][wave.index(min(wave))]
        self.assertGreater(bar, 1.001 * SAFETY * (error_of(64) + error_of(128)))
        self.assertAlmostEqual(self.error(answer)["value"] / bar, 1, places=9)

    def test_a_finer_twin_where_a_coarser_one_fails(self):
        for least in (40, 100):  # two levels coarser, and one
            answer = self.ask(f"last.least={least}")
            self.assertIn("cells are too few", answer["accuracy"]["failure"])
            bar, exact = self.error(answer)["value"], error_of(64) + error_of(128)
            self.assertGreaterEqual(bar, exact)
            self.assertLess(bar, 4 * exact)

    def test_no_twin_at_all(self):
        """Then the error is not known, and the answer is doubtful."""
        text = FILE.replace("before: first, ", "before: first, least: 128, ").replace("[last.value, last.wave]", "[last.value]")
        answer = self.ask("last.cells=1000000", "last.least=1000000", text=text)
        self.assertIsNone(self.error(answer)["relative"])
        self.assertNotIn("value", self.error(answer))
        self.assertEqual(answer["verdict"], "doubtful")

    def test_the_guess_of_the_model_goes(self):
        """Two numbers for one error would contradict each other."""
        lines = next(s for s in self.ask()["stages"] if s["stage"] == "last")["quality"]
        self.assertEqual(sorted(lines), ["balance", "value_error", "wave_error"])
        self.assertEqual(lines["value_error"]["verdict"], "good")
        plain = next(s for s in self.ask("accuracy=")["stages"] if s["stage"] == "last")["quality"]
        self.assertEqual(list(plain), ["value_guess_error", "balance"])

    def test_a_large_error_is_doubtful(self):
        self.assertEqual(self.ask("last.cells=8")["verdict"], "doubtful")
        self.ask("last.cells=8", code=0)
        self.call("run", "order.yaml", "--set", "last.cells=8", "--strict", code=1)

    def test_the_answer_is_the_same(self):
        self.assertEqual(self.ask()["outputs"]["last.value"]["value"], self.ask("accuracy=")["outputs"]["last.value"]["value"])

    def test_files(self):
        self.write("order.yaml", FILE)
        self.call("run", "order.yaml", "-o", "order", "--set", "last.steps=10001")
        entry = self.read("order/result.json")["outputs"]["last.value"]
        # the least of the wave, whose bar there is the largest nearby
        self.assertAlmostEqual(entry["error"]["value"] / (SAFETY * (error_of(64) + error_of(128))), 1, places=4)
        self.call("run", "order.yaml", "-o", "order")
        entry = self.read("order/result.json")["outputs"]["last.wave"]
        self.assertEqual(entry["error"]["file"], "last.wave_error_bar.npy")
        self.assertEqual(len(self.numbers("order/last.wave_error_bar.npy", entry["shape"])), entry["shape"][0])
        self.call("report", "order")
        with open("order/report.html", encoding="utf-8") as file:
            self.assertTrue('"bar":"' in file.read())

    def test_a_study_has_a_bar_for_each_case(self):
        self.write("study.yaml", FILE + "study: {sweep: {last.cells: [32, 128]}}\n")
        self.call("run", "study.yaml", "-o", "study")
        with open("study/table.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        for row, cells in zip(rows, (32, 128)):
            exact = SAFETY * (error_of(64) + error_of(cells))
            self.assertAlmostEqual(float(row["last.value_error_bar [m]"]) / exact, 1, places=5)
        said = self.call("run", "study.yaml", "-o", "study")
        self.assertIn("2 of them earlier", said)
        self.assertNotIn("before", self.call("run", "study.yaml", "-o", "study", "--set", "accuracy="))

    def test_words_that_are_wrong(self):
        self.write("order.yaml", FILE)
        said = self.call("check", "order.yaml", "--set", "accuracy=mesured", code=2)
        self.assertIn('did you mean "measured"?', said)
        self.write("order.yaml", FILE.replace("use: toy/order, before", "use: toy/auto, before"))
        self.call("check", "order.yaml", code=2)


lab.main()
