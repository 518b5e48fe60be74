# SPDX-License-Identifier: GPL-3.0-or-later
"""Uncertain inputs of waves whose total is their amplitude times a number: what is drawn, what is made of it, and that it
is the same on any number of workers, resumed or not."""
import csv
import math
import statistics

import lab

PIPELINE = """
format: 2
pipeline:
  wave: {use: toy/wave, amplitude: 2 mm}
  other: {use: toy/wave, amplitude: 2 mm}
outputs: [wave.total, other.total]
study:
  uncertainty:
    outputs: [wave.total, other.total]
"""
TWO = """    inputs: {wave.amplitude: {normal: [2 mm, 5 %]}, other.amplitude: {normal: [2 mm, 0.2 mm]}}
"""


def amplitude(row, stage="wave"):
    number, unit = row[stage + ".amplitude"].split()
    return float(number) * {"mm": 1, "cm": 10}[unit]


def freedom(values):
    """2 sigma^4 / var(s^2) of values with their kurtosis, if it is above that of normal ones."""
    n, squares = len(values), [(one - statistics.mean(values)) ** 2 for one in values]
    excess = n * sum(one * one for one in squares) / sum(squares) ** 2 - 3
    return 1 / (1 / (n - 1) + max(excess, 0) / (2 * n))


def student(n):
    """The quantile 0.975 for n > 20 to 1e-5 (Abramowitz & Stegun 26.7.5)."""
    z = 1.959963984540054
    return z + (z**3 + z) / (4 * n) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * n**2) + (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / (384 * n**3)


class Uncertainty(lab.Lab):
    def study(self, name, text, code=0, words=()):
        self.write(name + ".yaml", PIPELINE + text)
        return self.call("run", name + ".yaml", "-o", name, *words, code=code)

    def rows(self, name, start):
        with open(f"{name}/table.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return [row for row in rows if row["sample"].startswith(start)]

    def file(self, name):
        with open(f"{name}/uncertainty.csv", encoding="utf-8") as file:
            return file.read()

    def test_statistics_are_those_of_the_table(self):
        self.study("plain", TWO + """    samples: 60
    aim: distribution
    conditions: ["wave.total < 0 mm", "wave.total > 0 mm"]
    models: {longer: {wave.count: 12, other.count: 12}, broken: {wave.end: fail}}
""", code=4)
        found, totals = self.read("plain/uncertainty.json"), [
            float(row["wave.total [m]"]) for row in self.rows("plain", "sample")]
        of = found["outputs"]["wave.total"]
        self.assertEqual(len(totals), 60)
        error = statistics.stdev(totals) / math.sqrt(60)
        self.assertAlmostEqual(of["mean"]["value"], statistics.mean(totals), delta=1e-9 * abs(totals[0]))
        self.assertAlmostEqual(of["mean"]["error"], error, delta=1e-6 * error)
        self.assertAlmostEqual(of["deviation"]["value"], statistics.stdev(totals), delta=1e-6 * error)
        self.assertAlmostEqual(of["mean"]["high"] - of["mean"]["value"], student(freedom(totals)) * error, delta=1e-4 * error)
        self.assertAlmostEqual(of["percentiles"][1]["value"], statistics.median(totals), delta=1e-9 * abs(totals[0]))
        self.assertEqual([one["low"] is None or one["low"] < one["value"] for one in of["percentiles"]], [True] * 3)
        below, above = (found["conditions"]["wave.total " + sign] for sign in ("< 0 mm", "> 0 mm"))
        self.assertEqual(below["value"] + above["value"], 1)
        self.assertAlmostEqual(below["low"], 1 - above["high"])
        # the amplitude spreads by 5 %, the other by 10 %; 95 % lie within 1.96 of that
        limits = [found["outputs"][name]["limits"] for name in ("wave.total", "other.total")]
        self.assertAlmostEqual(limits[0]["input"] / 1.96, 0.05, delta=0.015)
        self.assertAlmostEqual(limits[1]["input"] / 1.96, 0.10, delta=0.03)
        nominal, longer = (float(self.rows("plain", "medians" + word)[0]["wave.total [m]"]) for word in ("", ", longer"))
        self.assertAlmostEqual(limits[0]["models"]["longer"], longer / nominal - 1, delta=1e-6)
        self.assertIn("broken", limits[0]["not_compared"])

    def limits(self, name):
        """The bars of an output, and the sentence, without the numbers."""
        of = next(iter(self.read(f"{name}/uncertainty.json")["outputs"].values()))
        low, high = (1.96 * of["deviation"][end] / of["mean"]["value"] for end in ("low", "high"))
        return of["limits"], low, high, of["limits"]["sentence"].split(": ")[-1]

    def test_the_sentence_does_not_choose_where_the_samples_leave_it_open(self):
        """Six points of the wave make 5.8 % more than eight, 95 % of the amplitudes are within 5 %; which is more takes many samples."""
        text = TWO.replace("[2 mm, 5 %]", "[2 mm, 2.55 %]") + "    models: {fewer: {wave.count: 6}}\n    aim: distribution\n    samples: "
        for samples, is_open in ((20, True), (1000, False)):
            self.study("open", f"{text}{samples}\n")
            limits, low, high, said = self.limits("open")
            self.assertEqual(low < limits["model"] < high, is_open)
            self.assertEqual(said, "finer cells would change nothing" + (
                "; the inputs and the choice of the model may matter equally" if is_open else ", the choice of the model matters"))

    def test_cells_that_may_matter_as_much_as_the_inputs(self):
        """The cells of the stage make 0.1 m of 1.1 m, and so does the spread of its strength; of a model, too, or much less."""
        text = """
format: 2
pipeline: {last: {use: toy/order, tolerance: 1e-4 %, strength: 400, cells: 64}}
outputs: [last.value]
study:
  uncertainty:
    outputs: [last.value]
    inputs: {last.strength: {normal: [400, 61 %]}}
    samples: 20
    aim: distribution
"""
        alike = "the inputs, and cells and steps, may matter equally"
        for tolerance, sentence in (("", alike), ("1 %", alike), ("40 %", "finer cells would change nothing, the choice of the model matters"),
                                    ("10 %", "the inputs, the choice of the model, and cells and steps may matter equally")):
            with self.subTest(tolerance):
                name = "cells" + tolerance.rstrip(" %")
                self.write(name + ".yaml", text + (f"    models: {{loose: {{last.tolerance: {tolerance}}}}}\n" if tolerance else ""))
                self.call("run", name + ".yaml", "-o", name)
                self.assertEqual(self.limits(name)[-1], sentence)

    def test_the_inputs_are_control_variates_of_the_mean(self):
        """The total is linear in its amplitude, so that any samples tell its mean to rounding; a test of the whole path:
        the numbers that regress it are those that made it."""
        self.study("regressed", TWO + "    samples: 40\n")
        mean = self.read("regressed/uncertainty.json")["outputs"]["wave.total"]["mean"]
        nominal = float(self.rows("regressed", "medians")[0]["wave.total [m]"])
        self.assertAlmostEqual(mean["value"] / nominal, 1, delta=1e-6)
        self.assertLess(mean["error"], 1e-6 * abs(nominal))

    def test_draws(self):
        self.write("measured.csv", "# of a batch\nx-when;wave.amplitude [mm]\n1;1.5\n2;1.25\n3;1.75\n")
        both = "[wave.amplitude, other.amplitude]"
        self.study("one", f"    inputs: {{both: {{lognormal: [2 mm, 20 %], sets: {both}}}}}\n    samples: 40\n")
        rows = self.rows("one", "sample")
        self.assertEqual([row["wave.total [m]"] for row in rows], [row["other.total [m]"] for row in rows])
        logs = [math.log(amplitude(row) / 2) for row in rows]
        spread = math.sqrt(math.log(1.04))
        self.assertLess(abs(statistics.mean(logs)), 3 * spread / math.sqrt(40))
        self.assertLess(abs(statistics.stdev(logs) / spread - 1), 3 / math.sqrt(80))
        self.study("two", """    inputs: {wave.amplitude: {samples: measured.csv}, other.amplitude: {uniform: [1 mm, 0.2 cm]}}
    correlations: [[wave.amplitude, other.amplitude, 0.9]]
    samples: 40
""")
        rows = self.rows("two", "sample")
        pairs = [(amplitude(row), amplitude(row, "other")) for row in rows]
        self.assertEqual({a for a, _ in pairs}, {1.25, 1.5, 1.75})
        self.assertTrue(all(1 <= b <= 2 for _, b in pairs))
        self.assertGreater(statistics.correlation(*zip(*pairs)), 0.6)
        self.study("toleranced", """    inputs: {wave.amplitude: {samples: measured.csv}, other.amplitude: 1.5 mm +- 0.05 cm}
    correlations: [[wave.amplitude, other.amplitude, 0.9]]
    samples: 40
""")
        self.assertEqual(pairs, [(amplitude(row), amplitude(row, "other")) for row in self.rows("toleranced", "sample")])
        # the first of more samples are the same ones, which are not computed again
        said = self.call("run", "two.yaml", "-o", "two", "--set", "study.uncertainty.samples=50")
        self.assertIn("52 cases done, 42 of them earlier", said)

    def test_values_with_a_tolerance_are_the_inputs_where_none_is_named(self):
        text = PIPELINE.replace("amplitude: 2 mm}\n  other", "amplitude: 2 mm +- 0.5 mm}\n  other")
        self.write("drawing.yaml", text + "    samples: 40\n")
        self.call("run", "drawing.yaml", "-o", "drawing")
        rows = self.rows("drawing", "sample")
        values = [amplitude(row) for row in rows]
        self.assertTrue(1.5 <= min(values) < 1.6 and 2.4 < max(values) <= 2.5, values)
        self.assertEqual(len({row["other.total [m]"] for row in rows}), 1)
        self.write("none.yaml", PIPELINE)
        self.assertIn("no value of the pipeline has a tolerance", self.call("check", "none.yaml", code=2))
        self.write("sample.yaml", text.split("study:")[0] + "study: {sample: {sobol: 8, tolerances: uniform}}\n")
        self.assertIn("write study: {uncertainty: {outputs: ", self.call("check", "sample.yaml", code=2))

    def test_a_ladder_gives_the_same_for_less(self):
        """The cheap level is half the file's, so that the file's samples leave no variance but need be eight."""
        text = TWO + """    samples: 400
    pilot: 8
    ladder: {short: {wave.count: 4, cost: 1 %}}
"""
        self.study("ladder", text, words=("-j", "1"))
        found = self.read("ladder/uncertainty.json")
        of, levels = found["outputs"]["wave.total"], found["levels"]
        self.assertEqual((levels[0]["samples"], levels[1]["correlation"]), (8, 1))
        self.assertAlmostEqual(levels[1]["samples"], 400, delta=1)
        self.assertAlmostEqual(found["gain"]["predicted"], 400 / (8 + 4), delta=0.05)
        nominal = float(self.rows("ladder", "medians")[0]["wave.total [m]"])
        # the cheap samples show a plane, eight for two inputs do not: a share of 8 in 400 keeps its spread
        self.assertLess(abs(of["mean"]["value"] / nominal - 1), 2 * 0.05 / math.sqrt(8) * 8 / 400)
        shares = of["shares"]
        for kind in ("first", "total"):  # a plane, that one input makes
            for name, truth in (("wave.amplitude", 1), ("other.amplitude", 0)):
                share = shares[name][kind]
                self.assertAlmostEqual(share["value"], truth, delta=1e-9)
                self.assertTrue(share["low"] <= truth <= share["high"] + 1e-12, share)
                self.assertAlmostEqual(share["high"], truth, delta=1e-6)
        pilot, main = ({row["wave.amplitude"] for row in self.rows("ladder", word)} for word in ("pilot", "sample"))
        self.assertFalse(pilot & main)
        self.study("again", text, words=("-j", "2"))
        self.assertEqual(self.file("ladder"), self.file("again"))

    def test_what_few_samples_do_not_tell_is_said(self):
        """4 rows tell no share, which is said in the print and beside the figure that is on the page; 20 that are asked for do."""
        said = self.study("few", TWO + "    samples: 4\n", words=("-j", "1"))
        share = self.read("few/uncertainty.json")["outputs"]["wave.total"]["shares"]["wave.amplitude"]
        self.assertEqual((share["first"]["value"], share["untold"]), (None, "too few samples (4)"))
        self.assertIn("too few samples (4)", said)
        self.study("more", TWO + "    samples: 4\n    sensitivity: 20\n", words=("-j", "1"))
        share = self.read("more/uncertainty.json")["outputs"]["wave.total"]["shares"]["wave.amplitude"]
        self.assertAlmostEqual(share["first"]["value"], 1)
        self.assertEqual(len(self.rows("more", "sample")), 20)
        shares = next(figure["shares"] for figure in self.read("few/uncertainty.figure.json") if figure["sort"] == "shares")
        self.assertEqual([one["untold"] for one in shares.values()], ["too few samples (4)"] * 2)

    def test_each_word_of_an_input_has_its_own_mean(self):
        words = """    inputs: {wave.end: {samples: [good, good, doubtful]}, wave.amplitude: {normal: [2 mm, 5 %]}}
    samples: 40
"""
        self.study("words", words)
        rows = self.rows("words", "sample")
        found = self.read("words/uncertainty.json")["outputs"]["wave.total"]["words"]
        self.assertEqual([(one["input"], one["word"]) for one in found], [("wave.end", "good"), ("wave.end", "doubtful")])
        for one in found:
            own = [float(row["wave.total [m]"]) for row in rows if row["wave.end"] == one["word"]]
            self.assertEqual(one["samples"], len(own))
            self.assertAlmostEqual(one["mean"]["value"], statistics.mean(own), delta=1e-8 * abs(own[0]))
            self.assertAlmostEqual(one["deviation"]["value"] / statistics.stdev(own), 1, delta=1e-6)
        # the cheap level is half the file's, so that the mean of the word is that of its samples on that level
        self.study("laddered", words.replace("samples: 40", "samples: 400") +
                   "    pilot: 30\n    ladder: {short: {wave.count: 4, cost: 1 %}}\n    aim: distribution\n")
        rows = self.rows("laddered", "pilot") + self.rows("laddered", "sample")
        of = self.read("laddered/uncertainty.json")["outputs"]["wave.total"]
        for one in of["words"]:
            short = [float(row["wave.total [m]"]) for row in rows if row["wave.end"] == one["word"] and row["wave.count"]]
            scale = of["mean"]["value"] / statistics.mean(float(row["wave.total [m]"]) for row in rows if row["wave.count"])
            self.assertAlmostEqual(one["mean"]["value"] / statistics.mean(short) / scale, 1, delta=1e-6)

    def test_a_parameter_may_come_from_the_inputs_alone(self):
        self.write("alone.yaml", (PIPELINE + TWO).replace(", amplitude: 2 mm}", "}", 1))
        for verb in "check", "plan", "explain":
            self.call(verb, "alone.yaml")

    def test_explain_says_which_models_are_compared(self):
        self.write("models.yaml", PIPELINE + TWO + "    models: {longer: {wave.count: 12}, none: {wave.counts: 12}}\n")
        said = self.call("explain", "models.yaml")
        self.assertIn("  longer                   wave.count=12\n", said)
        self.assertIn('wave.counts=12; cannot be compared: wave: unknown key "counts"', said)

    def test_a_level_that_cannot_be_is_said_before_anything_runs(self):
        self.write("level.yaml", PIPELINE + TWO + "    ladder: {short: {wave.counts: 4}}\n")
        self.assertIn('pilot 1, short: wave: unknown key "counts"', self.call("run", "level.yaml", "-o", "level", code=2))

    def test_each_bad_input_has_a_sentence(self):
        inputs = "    inputs: {wave.amplitude: %s}\n"
        for text, sentence in (
                (inputs % "{normal: [2 mm, 3 N]}", "the spread has another dimension"),
                (inputs % "{normal: [2 mm]}", "expected two numbers"),
                (inputs % "{normal: [20 degC, 5 %]}", "a spread of a temperature is a number of kelvin"),
                (inputs % "{lognormal: [-2 mm, 5 %]}", "lognormal needs a positive median"),
                (inputs % "{uniform: [3 mm, 2 mm]}", "the first end must be the lower one"),
                (inputs % "3 mm +- 2 N", "two units that do not agree"),
                (inputs % "3 mm", "expected a distribution"),
                (inputs % "{gaussian: [3 mm, 2 mm]}", 'unknown key "gaussian"'),
                (inputs % "{samples: none.csv}", "No such file"),
                (inputs % "{samples: /dev/zero}", "it is not a regular file"),
                (TWO + "    samples: 999999\n", "more than 1000000 cases"),
                ("    inputs: {w: {uniform: [1 mm, 2 mm], sets: [wave.amplitude, wave.amplitude]}}\n", "wave.amplitude: it is set twice"),
                ("    inputs: {w: {uniform: [1 mm, 2 mm], sets: [sample, wave.amplitude]}}\n", "sample: it is not a path of the pipeline"),
                ("    inputs: {amplitude: {normal: [2 mm, 5 %]}}\n", "it is not a path of the pipeline"),
                (TWO + "    correlations: [[wave.amplitude, wave.total, 0.5]]\n", 'there is no input "wave.total"'),
                (TWO + "    correlations: [[wave.amplitude, other.amplitude, 1]]\n", "a number between -1 and 1"),
                (TWO + "    conditions: [sum < 1 mm]\n", "a condition must be about one of the outputs"),
                (TWO + "    conditions: [wave.total < 1 N]\n", "wave.total < 1 N"),
                (TWO + "    percentiles: [5]\n", "a percentile must be a share"),
                (TWO + "    percentiles: [0.5 x]\n", "a percentile must be a share"),
                (TWO + "    ladder: {short: {wave.amplitude: 1 mm}}\n", "it is set by an uncertain input"),
                (TWO + "    ladder: {short: {cost: 1 %}}\n", "it changes nothing"),
                (TWO + "    ladder: {short: {wave.count: 4, cost: cheap}}\n", "a cost must be relative"),
                ("    inputs: {wave.amplitud: {normal: [2 mm, 5 %]}}\n", 'bad.yaml:10:13: error: uncertainty: medians: wave: unknown key "amplitud"'),
                ("    inputs: {wave.amplitude: {normal: [2 N, 5 %]}}\n", "uncertainty: medians: wave.amplitude"),
                (TWO + "    sample: 4\n", 'did you mean "samples"')):
            with self.subTest(sentence):
                self.assertIn(sentence, self.study("bad", text, code=2))
        three = ", ".join(f"w{i}: {{normal: [2 mm, 5 %], sets: [{path}]}}" for i, path in enumerate(
            ("wave.amplitude", "other.amplitude", "wave.count")))
        self.assertIn("not positive definite", self.study(
            "bad", f"    inputs: {{{three}}}\n    correlations: [[w0, w1, 0.9], [w0, w2, 0.9], [w1, w2, -0.9]]\n", code=2))


if __name__ == "__main__":
    lab.main()
