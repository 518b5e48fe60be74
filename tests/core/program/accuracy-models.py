# SPDX-License-Identifier: GPL-3.0-or-later
"""`use: toy/auto`: the cheapest model that stays within the accuracy, among some whose errors are known."""
import csv
import json
import os

import lab
import records

FILE = """
format: 2
accuracy: 4 %
pipeline:
  first: {use: toy/auto, before: none, with: {toy/order: {strength: 1}, toy/guess: {off: 1 %}, toy/brief: {off: 50 %}}}
  last: {use: toy/order, before: first, strength: 1}
outputs: [last.value, first.wave]
"""


class Models(lab.Lab):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        os.symlink("guess.so", os.path.join(cls.directory, "plugins/toy/brief.so"))

    def ask(self, *sets, text=FILE, code=0):
        return self.answer(text, sets, code)

    @staticmethod
    def tried(answer):
        return {(one["stage"], one["model"]): one for one in answer["accuracy"]["models"]}

    @staticmethod
    def used(answer, stage):
        return next(s["model"] for s in answer["stages"] if s["stage"] == stage)

    def test_a_cheap_model_is_taken_and_its_part_counts(self):
        """1 % of the first value of 1 is 0.5 % of the last one of 2; the reference is known to a quarter of the accuracy."""
        answer = self.ask()
        self.assertEqual(self.used(answer, "first"), "toy/guess")
        error = answer["outputs"]["last.value"]["error"]
        self.assertGreater(error["parts"]["first.use"], 0.005)
        self.assertLess(error["parts"]["first.use"], 0.005 + 0.04 / 4)
        self.assertLess(error["parts"]["first.use"], error["relative"])
        self.assertLessEqual(error["relative"], 0.04)
        self.assertEqual(answer["verdict"], "good")
        bar, value = (answer["outputs"]["first.wave"]["error"]["relative"], answer["outputs"]["last.value"]["value"])
        self.assertGreater(bar, 0.01)
        self.assertAlmostEqual(value, 2.01, delta=2 * error["relative"])

    def test_no_model_is_taken_where_nothing_is_compared(self):
        """A series that turns out to be a field has no error."""
        answer = self.ask(text=FILE.replace("last.value, first.wave", "last.pairs"))
        self.assertEqual(self.used(answer, "first"), "toy/order")
        self.assertIn("no output can be compared", self.tried(answer)["first", "toy/guess"]["reason"])

    def test_the_answer_that_follows_holds_its_bar(self):
        """Whatever is taken, the truth is 2."""
        for goal in (0.5, 2, 4, 20):
            for off in (0.2, 1, 3, 10):
                answer = self.ask(f"accuracy={goal} %", f"first.with.toy/guess.off={off} %")
                error, value = answer["outputs"]["last.value"]["error"]["relative"], answer["outputs"]["last.value"]["value"]
                self.assertLessEqual(error, goal / 100, (goal, off))
                self.assertLessEqual(abs(value - 2) / 2, error, (goal, off))
                taken = self.used(answer, "first") == "toy/guess"
                self.assertEqual(taken, off < 0.45 * goal, (goal, off))

    def test_what_does_not_fit_is_told(self):
        tried = self.tried(self.ask("first.with.toy/guess.off=3 %"))
        self.assertIn('"wave"', tried["first", "toy/brief"]["reason"])
        self.assertRegex(tried["first", "toy/guess"]["reason"], r"^first.wave may be off by 3\.?\d* %, and models may cause 2 %$")
        tried = self.tried(self.ask("outputs=[last.value]"))
        self.assertIn("last.value may be off by 2", tried["first", "toy/brief"]["reason"])
        tried = self.tried(self.ask("first.with.toy/guess.sure=false"))
        self.assertEqual(tried["first", "toy/guess"]["reason"], "its quality line trust is doubtful")

    def test_models_are_tried_with_the_settings_of_the_reference(self):
        """And not with those of a finer attempt that failed."""
        for sets in (("accuracy=2 %", "last.strength=20", "first.with.toy/order.strength=20", "last.most=100"),):
            answer = self.ask("outputs=[last.value]", "first.with.toy/guess.off=0.001 %", *sets)
            self.assertIn("cells are too many", answer["accuracy"]["failure"])
            self.assertIsNone(self.tried(answer)["first", "toy/guess"]["reason"])
            self.assertLessEqual(answer["outputs"]["last.value"]["error"]["relative"], float(sets[0].split("=")[1].split()[0]) / 100)

    def test_the_cheapest_first(self):
        answer = self.ask("outputs=[last.value]", "first.with.toy/brief.off=1 %")
        self.assertEqual(self.used(answer, "first"), "toy/brief")
        self.assertEqual(len(self.tried(answer)), 1)

    def test_two_stages_share_what_models_may_move(self):
        """Each 1.5 % of 4 %, of which models may have the half."""
        text = FILE.replace("last: {use: toy/order", "last: {use: toy/auto, with: {toy/order: {strength: 1}, toy/guess: {off: 1.5 %}}").replace("first, strength: 1", "first")
        both = text.replace("first.wave", "last.wave").replace("guess: {off: 1 %}", "guess: {off: 1.5 %}")
        answer = self.ask(text=both)
        self.assertEqual((self.used(answer, "first"), self.used(answer, "last")), ("toy/guess", "toy/guess"))
        self.assertEqual({"first.use", "last.use"} & set(answer["outputs"]["last.value"]["error"]["parts"]), {"first.use", "last.use"})
        answer = self.ask("first.with.toy/guess.off=3 %", text=both)
        self.assertEqual((self.used(answer, "first"), self.used(answer, "last")), ("toy/guess", "toy/order"))

    def test_the_layer_gives_the_same_bits(self):
        answer = self.ask()
        sets = [f"{path}={value}" for path, value in answer["accuracy"]["settings"].items()]
        self.assertIn("first.use=toy/guess", sets)
        again = self.ask("accuracy=", *sets)
        for name, output in answer["outputs"].items():
            self.assertEqual(again["outputs"][name].get("value"), output.get("value"))
            self.assertEqual(again["outputs"][name].get("data"), output.get("data"))
        kept = self.ask(*sets)
        self.assertEqual((kept["accuracy"]["attempts"], kept["accuracy"]["models"]), (1, []))

    def test_the_reference_is_named_or_the_most_costly(self):
        named = FILE.replace("toy/order: {strength: 1}, ", "")
        self.assertEqual(self.used(self.ask("accuracy=0.5 %", "first.reference=toy/order", text=named), "first"), "toy/order")
        plain = FILE.replace(", with: {toy/order: {strength: 1}, toy/guess: {off: 1 %}, toy/brief: {off: 50 %}}", "")
        self.assertEqual(self.used(self.ask("accuracy=0.5 %", text=plain), "first"), "toy/order")
        self.assertEqual(self.used(self.ask(text=named), "first"), "toy/guess") # the first under `with`, for nothing better is known

    def test_words_that_are_wrong(self):
        self.write("order.yaml", FILE)
        for sets, say in ((("accuracy=",), "needs an accuracy, but the file states none"),
                          (("accuracy=measured",), "needs an accuracy"),
                          (("first.reference=viscosity/barus",), "is not a model of toy/auto"),
                          (("first.reference=toy/odrer",), 'toy/order'),
                          (("first.reference=[toy/order]",), "expected the name of a model, found a list"),
                          (("first.use=viscosity/auto", "first.with="), "which model of viscosity/auto"),
                          (("first.clels=3",), 'did you mean "cells"?')):
            words = [word for one in sets for word in ("--set", one)]
            self.assertIn(say, self.call("check", "order.yaml", *words, code=2))

    def test_what_explain_prints_leaves_the_models_open(self):
        self.write("order.yaml", FILE)
        printed = self.call("explain", "order.yaml", "--yaml", "--set", "first.reference=toy/order")
        self.assertIn("use: toy/auto", printed)
        self.assertEqual(self.ask(text=printed)["accuracy"]["settings"], self.ask()["accuracy"]["settings"])

    def test_explain_names_the_candidates(self):
        self.write("order.yaml", FILE)
        self.assertIn("the reference of toy/auto; a run also tries toy/brief, toy/guess",
                      " ".join(self.call("explain", "order.yaml").split()))
        told = json.loads(self.call("explain", "order.yaml", "--json"))
        first = next(s for s in told["stages"] if s["stage"] == "first")
        self.assertEqual(first["choice"], {"use": "toy/auto", "candidates": ["toy/brief", "toy/guess"]})

    def test_a_study(self):
        self.write("study.yaml", FILE + "study: {sweep: {accuracy: [0.5 %, 4 %]}}\n")
        self.call("run", "study.yaml", "-o", "chosen")
        used = [record["settings"]["first.use"] for record in sorted(records.read("chosen/journal.jsonl"), key=lambda r: r["case"])]
        self.assertEqual(used, ["toy/order", "toy/guess"])
        with open("chosen/table.csv", encoding="utf-8") as file:
            self.assertEqual(len(list(csv.DictReader(file))), 2)
        self.assertIn("2 of them earlier", self.call("run", "study.yaml", "-o", "chosen"))


lab.main()
