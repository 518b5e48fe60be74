# SPDX-License-Identifier: GPL-3.0-or-later
"""Fields stand in .npy files: what is read of one that is not as result.json says is a sentence."""
import json
import os
import shutil
import struct

import lab

FIELD = "{'descr': '<f8', 'fortran_order': False, 'shape': (9, 10), }"


def npy(header=FIELD, numbers=90, version=b"\1\0", order="<"):
    """The bytes of a file."""
    text = header.ljust(117) + "\n"
    return (b"\x93NUMPY" + version + struct.pack("<H", len(text)) + text.encode("ascii") +
            struct.pack(f"{order}{numbers}d", *range(numbers)))


class Fields(lab.Lab):
    def put(self, data, name="bad"):
        """A copy of the run with another field."""
        shutil.rmtree(name, ignore_errors=True)
        shutil.copytree("run", name)
        os.remove(f"{name}/wave.field.npy")
        if data is not None:
            with open(f"{name}/wave.field.npy", "wb") as file:
                file.write(data)

    def refused(self, data, sentence):
        self.put(data)
        for words in ((), ("--json",)):
            said = self.call("export", "bad", "--to", "csv", "-o", "out", *words, code=2)
            self.assertIn("bad/wave.field.npy cannot be read: " + sentence,
                          json.loads(said)["errors"][0]["message"] if words else said)
        self.assertFalse(os.path.exists("out/wave-t-x.csv"))

    def test_good(self):
        self.put(npy())
        self.call("export", "bad", "--to", "csv", "-o", "good")
        with open("good/wave-t-x.csv", encoding="utf-8") as file:
            last = file.read().splitlines()[-1]
        self.assertTrue(last.endswith(",89"), last)
        self.put(npy("{'shape':(9,10),'fortran_order':False,'descr':'<f8'}"))
        self.call("export", "bad", "--to", "csv", "-o", "good")

    def test_not_finite(self):
        self.put(npy(numbers=88) + struct.pack("<2d", float("inf"), float("nan")))
        self.call("export", "bad", "--to", "csv", "-o", "good")
        with open("good/wave-t-x.csv", encoding="utf-8") as file:
            lines = file.read().splitlines()
        self.assertTrue(all(line.endswith(",nan") for line in lines[-2:]), lines[-2:])

    def test_missing(self):
        self.refused(None, "No such file or directory")

    def test_cut_off(self):
        whole = npy()
        for length, sentence in ((len(whole) - 1, f"it has {len(whole) - 1} bytes, but its shape needs 848"),
                                 (128, "it has 128 bytes, but"), (127, "it ends within its header"),
                                 (9, "it is not a .npy file"), (0, "it is not a .npy file")):
            self.refused(whole[:length], sentence)
        self.refused(whole + b"\0", "it has 849 bytes, but its shape needs 848")

    def test_foreign(self):
        self.refused(b"t,x\n" * 300, "it is not a .npy file")
        self.refused(npy(version=b"\2\0"), "its format has version 2.0, not 1.0")
        self.refused(b"\x93NUMPY\1\0\xff\xff" + bytes(70000), "its header is longer than")
        self.refused(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (9, 10), }"),
                     "its numbers are of the type '<f4', not '<f8'")
        self.refused(npy("nothing"), "its numbers are of the type , not '<f8'")

    def test_big_endian(self):
        self.refused(npy(FIELD.replace("<", ">"), order=">"), "its numbers are big-endian")

    def test_fortran_order(self):
        self.refused(npy(FIELD.replace("False", "True")), "its numbers are in Fortran order")

    def test_pickled(self):
        self.refused(npy(FIELD.replace("<f8", "|O")), "it holds pickled objects, which are never read")

    def test_shape(self):
        self.refused(npy(FIELD.replace("(9, 10)", "(10, 9)")), "its shape is (10, 9), not (9, 10)")
        self.refused(npy(FIELD.replace("(9, 10)", "(90,)")), "its shape is (90,), not (9, 10)")
        self.refused(npy(FIELD.replace("(9, 10)", "(9, 100)")), "its shape is (9, 100), not (9, 10)")

    def test_huge_shape(self):
        """What result.json says is not believed before the size of the file is known."""
        self.put(npy(FIELD.replace("(9, 10)", "(4000000000, 4000000000)")))
        told = self.read("bad/result.json")
        told["outputs"]["wave.field"]["shape"] = [4000000000, 4000000000]
        with open("bad/result.json", "w", encoding="utf-8") as file:
            json.dump(told, file)
        self.assertIn("but its shape needs", self.call("export", "bad", "--to", "csv", code=2))

    def test_not_a_file(self):
        self.put(None)
        os.mkfifo("bad/wave.field.npy")
        self.assertIn("it is not a regular file", self.call("export", "bad", "--to", "csv", code=2))

    def test_names(self):
        """A name in result.json leads nowhere else."""
        self.put(npy())
        os.replace("bad/wave.field.npy", "elsewhere.npy")
        told = self.read("bad/result.json")
        for name in ("../elsewhere.npy", os.path.abspath("elsewhere.npy"), "", ".hidden"):
            told["outputs"]["wave.field"]["file"] = name
            with open("bad/result.json", "w", encoding="utf-8") as file:
                json.dump(told, file)
            said = self.call("export", "bad", "--to", "csv", code=2)
            self.assertIn("is not the name of a file in its directory", said)

    def test_log_cut_off(self):
        """A record that has lost its end is a sentence, and a case that runs anew."""
        self.call("run", "study.yaml", "-o", "lost", "-j", "1", code=4)
        self.call("export", "lost", "--to", "csv", "-o", "lost-whole")
        os.truncate("lost/arrays.1.log", os.path.getsize("lost/arrays.1.log") - 1)
        said = self.call("export", "lost", "--to", "csv", "-o", "lost-csv", code=2)
        self.assertRegex(said, r"wave\.\w+ of case \d+, in lost/arrays\.1\.log, cannot be read: the record at byte \d+, "
                               r"of \d+ bytes, is cut off")
        self.assertIn("3 done, 2 failed, 1 to run", self.call("plan", "study.yaml", "-o", "lost"))
        self.call("run", "study.yaml", "-o", "lost", "-j", "1", code=4)
        self.call("export", "lost", "--to", "csv", "-o", "lost-csv")
        for name in "wave-t.csv", "wave-t-x.csv":
            with open("lost-csv/" + name, "rb") as found, open("lost-whole/" + name, "rb") as whole:
                self.assertEqual(found.read(), whole.read())

    def test_crashes(self):
        """Workers that follow each other in one place go on with one log."""
        self.call("run", "run.yaml", "-o", "crashes", "-j", "1", "--set", "outputs=[wave.height]", "--set",
                  "study={sweep: {wave.amplitude: [1 mm, 2 mm, 3 mm, 4 mm], wave.end: [good, crash]}}", code=4)
        self.assertEqual([n for n in os.listdir("crashes") if n.endswith(".log")], ["arrays.1.log"])
        self.call("export", "crashes", "--to", "csv", "-o", "crashes-csv")
        with open("crashes-csv/wave-t.csv", encoding="utf-8") as file:
            self.assertEqual(len(file.readlines()), 1 + 4 * 9)

    def test_log_changed(self):
        self.call("run", "study.yaml", "-o", "flipped", "-j", "1", code=4)
        with open("flipped/arrays.1.log", "r+b") as file:
            file.seek(-100, os.SEEK_END)
            byte = file.read(1)
            file.seek(-1, os.SEEK_CUR)
            file.write(bytes([byte[0] ^ 1]))
        said = self.call("export", "flipped", "--to", "csv", "-o", "flipped-csv", code=2)
        self.assertIn("does not have its checksum", said)
        self.call("run", "study.yaml", "-o", "flipped", "-j", "1", "--rerun", "all", code=4)
        self.call("export", "flipped", "--to", "csv", "-o", "flipped-csv")

    def test_formats(self):
        """Studies of an older or a newer flankfilm, and runs of a newer one, are refused."""
        self.call("run", "study.yaml", "-o", "other", "-j", "1", code=4)
        for format, sentence in ((1, "was written by an older flankfilm: its files have format 1, not 2"),
                                 (3, "was written by a newer flankfilm: its files have format 3, not 2")):
            told = {**self.read("other/study.json"), "format": format}
            with open("other/study.json", "w", encoding="utf-8") as file:
                json.dump(told, file)
            for words in (["run", "study.yaml", "-o", "other"], ["plan", "study.yaml", "-o", "other"],
                          ["report", "other"], ["export", "other", "--to", "csv"]):
                self.assertIn(sentence, self.call(*words, code=2))
        self.put(npy())
        told = {**self.read("bad/result.json"), "format": 2}
        with open("bad/result.json", "w", encoding="utf-8") as file:
            json.dump(told, file)
        self.assertIn("bad/result.json has format 2; this flankfilm reads up to 1",
                      self.call("export", "bad", "--to", "csv", code=2))

    def test_series_of_one(self):
        """One number is a scalar, in the table and in what is exported; among longer series it is one of them."""
        self.call("run", "run.yaml", "-o", "one", "--set", "study={sweep: {wave.count: [1]}}",
                  "--set", "outputs=[wave.height]")
        self.assertEqual([n for n in os.listdir("one") if n.endswith(".log")], [])
        with open("one/table.csv", encoding="utf-8") as file:
            self.assertIn(",wave.height [m],", file.readline())
        self.call("run", "run.yaml", "-o", "mixed", "--set", "study={sweep: {wave.count: [1, 2]}}",
                  "--set", "outputs=[wave.height]")
        self.call("export", "mixed", "--to", "csv", "-o", "mixed-csv")
        with open("mixed-csv/wave-t.csv", encoding="utf-8") as file:
            self.assertEqual([line.split(",")[:3] for line in file][1:], [["1", "1", "0"], ["2", "2", "0"], ["2", "2", "1"]])

    def test_each_once(self):
        """No array is in the text of a run, and none in two files; of what nobody asked for, the axes alone."""
        told = self.read("run/result.json")
        entries = {k: e for k, e in {**told["outputs"], **told["computed"]}.items() if "shape" in e}
        self.assertTrue(all("data" not in e and e["file"] == k + ".npy" for k, e in entries.items()), entries)
        self.assertEqual({k for k in told["computed"] if k in entries}, {"wave.time"})
        self.assertEqual({name for name in os.listdir("run") if name.startswith("wave")}, {e["file"] for e in entries.values()})


lab.main()
