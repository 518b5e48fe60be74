# SPDX-License-Identifier: GPL-3.0-or-later
"""Chromium opens the report, moves its sliders, and finds nothing to complain about."""
import base64
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile

import lab

if not shutil.which("chromium"):
    print("needs Chromium")
    sys.exit(77)

QUIET = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--disable-dev-shm-usage", "--enable-logging=stderr", "--virtual-time-budget=10000"]
HOSTILE = "</title><script>document.body.dataset.errors='evil'</script>&amp;"


class Report(lab.Lab):
    def look(self, path):
        """The page as the browser has it after its own check, and what went to the console."""
        profile = tempfile.mkdtemp(prefix="flankfilm-chromium-")
        try:
            done = subprocess.run(
                ["chromium", *QUIET, "--user-data-dir=" + profile, "--dump-dom",
                 "file://" + os.path.abspath(path) + "#check"],
                capture_output=True, text=True, check=False, timeout=100)
        finally:
            shutil.rmtree(profile, ignore_errors=True)
        body = re.search(r"<body[^>]*>", done.stdout)
        self.assertIsNotNone(body, done.stderr)
        found = dict(re.findall(r'data-(\w+)="([^"]*)"', body.group()))
        self.assertEqual(found.get("ready"), "1", done.stderr)
        self.assertEqual(found.get("errors"), "")
        self.assertEqual(re.findall(r".*CONSOLE.*", done.stderr), [])
        return done.stdout, int(found["figures"])

    def read_page(self, path):
        self.assertLess(os.path.getsize(path), 5e6)
        with open(path, encoding="utf-8") as file:
            page = file.read()
        self.assertEqual(re.findall(r'(?:src|href)="(?!#)[^"]*"', page), [])
        self.assertEqual(set(re.findall(r"https?://[^\s\"'<]*", page)) -
                         {"http://www.w3.org/" + name for name in ("2000/svg", "2000/xmlns/", "1999/xlink")}, set())
        return page

    def read_extremes(self, page):
        """The frames of the slider hold the least film and the highest pressure of the field."""
        frames = json.loads(re.search(r'class="frames">(.*?)</script>', page, re.DOTALL).group(1))
        stage = frames["stages"][-1]
        for letter, field, worst in (("p", "pressure", max), ("h", "film", min)):
            data = base64.b64decode(stage[letter])
            shown = worst(struct.unpack(f"<{len(data) // 4}f", data))
            with open(f"pair/film.{field}.npy", "rb") as file:
                whole = file.read()
            whole = whole[10 + struct.unpack("<H", whole[8:10])[0]:]
            factor = {"GPa": 1e-9, "MPa": 1e-6, "\u00b5m": 1e6, "nm": 1e9}[frames[letter]]
            kept = worst(struct.unpack(f"<{len(whole) // 8}d", whole)) * factor
            self.assertAlmostEqual(shown / kept, 1, places=6)

    def test_gear_pair(self):
        source = os.environ["FLANKFILM_TEST_SOURCE"]
        small = [word for stage in ("film", "film_static")
                 for word in ("--set", stage + ".cells=64", "--set", stage + ".steps=400")]
        self.call("run", source + "/configs/li-kahraman-2011.yaml", "-o", "pair", *small,
                  "--set", "mesh.use=stiffness/potential-energy")
        self.assertEqual(self.call("report", "pair"), "pair/report.html\n")
        page = self.read_page("pair/report.html")
        dom, figures = self.look("pair/report.html")
        self.assertGreater(figures, 12)
        for words in ("Least film thickness", "roll angle", "LPSTC", "HPSTC", "µm)", "GPa",
                      "Quality of the numbers", "unity-50.yaml", "@article"):
            self.assertIn(words, page)
        self.read_extremes(page)
        self.assertRegex(dom, r'"extremes">film_static: least film 0.1')
        self.assertRegex(dom, r"<output>roll angle [\d.]+ deg</output>")

    def test_one_instant(self):
        source = os.environ["FLANKFILM_TEST_SOURCE"]
        self.call("run", source + "/configs/line-contact.yaml", "-o", "steady", "--set", "film.cells=64")
        self.call("report", "steady")
        self.assertIn("Steady line contact", self.read_page("steady/report.html"))

    def test_study(self):
        self.call("report", "study", "-o", "study.html")
        page = self.read_page("study.html")
        _, figures = self.look("study.html")
        self.assertGreater(figures, 0)
        self.assertIn("Failed cases", page)
        commands = [record["command"] for record in self.records() if "command" in record]
        self.assertEqual(len(commands), 2)  # of the cases that failed
        for command in commands:
            self.assertIn(command.replace("'", "&#39;"), page)

    def test_map(self):
        """A map says its scale, and what its lines are."""
        self.call("run", "run.yaml", "-o", "map", "--set", "outputs=sum.sum", "--set",
                  "study={sweep: {wave.amplitude: {from: 1 mm, to: 5 mm, points: 5}, wave.count: {from: 8, to: 38, points: 11}}}")
        self.call("report", "map")
        dom, _ = self.look("map/report.html")
        self.assertIn("Lines join equal values", dom)
        self.assertIn("linear scale", dom)

    def test_decades(self):
        for spacing, log in (("log", 1), ("linear", 0)):
            self.call("run", "run.yaml", "-o", spacing, "--set", "outputs=sum.sum", "--set",
                      "study={sweep: {wave.amplitude: {from: 0.01 mm, to: 1 mm, points: 5, "
                      f"spacing: {spacing}}}}}}}")
            self.call("report", spacing)
            self.look(f"{spacing}/report.html")
            self.assertIn(f'"x":{{"label":"amplitude (mm)","log":{log}}}', self.read_page(f"{spacing}/report.html"))

    def test_description(self):
        with open("own.json", "w", encoding="utf-8") as file:
            file.write('''[{"sort": "curves", "title": "</script>", "marks": [], "x": {"label": "x", "log": 1}, "y": {"label": "y"},
                "z": {"label": "z", "low": 0, "high": 9, "step": 3}, "curves": [
                {"name": "a", "colour": "#0072b2", "dash": [6, 3], "style": "line", "x": [1, 10, 100], "y": [2, null, 3]},
                {"name": "b", "colour": 1, "dash": 0, "axis": "z", "style": "line", "x": [1, 100], "y": [0, 9]}]}]''')
        self.assertEqual(self.call("report", "own.json"), "own.html\n")
        self.read_page("own.html")
        _, figures = self.look("own.html")
        self.assertEqual(figures, 1)
        with open("own.json", "w", encoding="utf-8") as file:
            file.write("{}")
        self.assertIn("does not describe figures", self.call("report", "own.json", code=2))

    def test_without_library(self):
        self.call("report", "run")
        page = self.read_page("run/report.html").replace("self.vega =", "self.none =")
        with open("tables.html", "w", encoding="utf-8") as file:
            file.write(page)
        dom, figures = self.look("tables.html")
        self.assertGreater(figures, 0)
        self.assertIn('<p class="alarm without">This build has no plotting library', dom)
        self.assertRegex(dom, r'</script><div class="wide"><table>')

    def test_hostile_text(self):
        self.call("run", "run.yaml", "-o", "hostile", "--set", f'title="{HOSTILE}"')
        self.call("report", "hostile")
        self.assertNotIn(HOSTILE, self.read_page("hostile/report.html"))
        dom, _ = self.look("hostile/report.html")
        self.assertIn("&lt;/title&gt;&lt;script&gt;", dom)

    def test_failed_run(self):
        self.call("run", "run.yaml", "-o", "failed", "--set", "wave.end=fail", code=1)
        self.call("report", "failed")
        self.assertIn("The run ended as <b>failed</b>: wave", self.read_page("failed/report.html"))
        self.look("failed/report.html")

    def test_disk_full(self):
        self.call("report", "run")
        with open("run/report.html", "rb") as file:
            before = file.read()
        self.assertIn("could not be written", self.call("report", "run", code=1, limit=4))
        with open("run/report.html", "rb") as file:
            self.assertEqual(file.read(), before)


lab.main()
