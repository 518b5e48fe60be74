# SPDX-License-Identifier: GPL-3.0-or-later
"""Chromium opens pages of every sort: each tries itself, zooms, toggles, moves its slider, and complains of nothing."""
import base64
import copy
import csv
import hashlib
import json
import os
import re
import shutil
import struct
import sys

import lab

sys.path.insert(0, os.path.join(os.environ["FLANKFILM_TEST_SOURCE"], "docs"))
import look

if not shutil.which("chromium"):
    print("needs Chromium")
    sys.exit(77)

HOSTILE = """</script></style></title>'"--><img src=x onerror="document.title='evil'"><script>document.title='evil'</script>&amp;"""
NAMED = "outputs", "computed", "quality", "parameters", "wires", "docs", "models", "facts"  # maps whose keys are names
CONFIGS = os.environ["FLANKFILM_TEST_SOURCE"] + "/configs/"

# The figures that are to be seen and stay empty.
EMPTY = """new Promise(function wait(done) {
  const empty = [...document.querySelectorAll('.plot')].filter(p => p.offsetWidth && !p.querySelector('svg'));
  empty.length && performance.now() < 1e5 ? setTimeout(wait, 20, done) : done(empty.map(p => p.parentNode.textContent)); })"""
# What a print does not have, and what it has of use on a screen alone.
LEFT_OUT = """[...document.querySelectorAll('details:not([open])'),
  ...[...document.querySelectorAll('.buttons, .tools, .player')].filter(b => b.offsetWidth)].map(one => one.textContent)"""

# A study of toy models of each sort of page.
STUDIES = {
    "sample": """
pipeline: {wave: {use: toy/wave, amplitude: 2 mm, count: 8}}
outputs: [wave.total]
study:
  sweep: {wave.amplitude: {from: 0.001 mm, to: 5 mm, spacing: log}}
  sample: {sobol: 200, seed: 1}
""",
    "uncertainty": """
pipeline: {wave: {use: toy/wave, amplitude: 2 mm, count: 8}}
outputs: [wave.total]
study:
  uncertainty:
    outputs: [wave.total]
    inputs: {wave.amplitude: {normal: [2 mm, 5 %]}}
    samples: 40
    models: {longer: {wave.count: 12}}
""",
    "tradeoff": """
pipeline: {root: {use: toy/root}}
outputs: [root.value]
study:
  tradeoff:
    outputs: [root.value]
    accuracy: 1e-2
    reference: {root.n: 100, refine: [root.n], refinements: 5}
    candidates: [{root.n: [2, 4]}, {root.n: 5}, {root.blind: 8}]
    repeats: 1
""",
    "stability": """
pipeline: {verge: {use: toy/verge}}
outputs: [verge.answers]
study:
  stability:
    axes: {verge.load: {from: 1 N, to: 10 N, points: 3}, verge.speed: {from: 0.1 m/s, to: 4 m/s, points: 4}}
    outputs: [verge.answer]
    estimates: {verge.answer: [verge.answer_error]}
    refine: [verge.cells]
    range: [verge.law]
    bisect: {verge.speed: 2}
""",
    "sweep": """
pipeline: {wave: {use: toy/wave, amplitude: 2 mm}, second: {use: toy/wave, amplitude: 1 mm, count: 8}}
outputs: [second.total, wave.total]
limits: {second.total: "> 5 mm"}
study:
  sweep: {second.amplitude: [1 mm, 3 mm, 2 mm], wave.amplitude: [1 mm, 2 mm, 3 mm, 4 mm, 5 mm], wave.count: [4, 7, 11]}
""",
    "along": """
pipeline: {wave: {use: toy/wave, amplitude: 2 mm, count: 8}}
outputs: [wave.total, wave.height, wave.x]
limits: {wave.total: "> 3 mm"}
study:
  sweep: {wave.amplitude: {from: 1 mm, to: 4 mm, points: 6}}
""",
    "spectrum": """
pipeline: {wave: {use: toy/wave, amplitude: 2 mm, count: 8}}
outputs: [wave.total, wave.height, wave.x]
study:
  cases: [{time: 3 h, wave.amplitude: 2 mm}, {time: 1 h, wave.amplitude: 4 mm}, {time: 8 h, wave.amplitude: 1 mm}, {time: 2 h, wave.amplitude: 3 mm}, {time: 5 h, wave.amplitude: 2.5 mm}, {time: 1 h, wave.amplitude: 5 mm}, {time: 4 h, wave.amplitude: 1.5 mm}, {time: 6 h, wave.amplitude: 2.2 mm}]
""",
}


class Report(lab.Lab):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.browser = look.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        super().tearDownClass()

    def look(self, path):
        """The page as the browser has it after all was tried, and the number of its figures."""
        self.browser.open("file://" + os.path.abspath(path))
        self.assertEqual(self.browser.value("document.body.dataset.ready"), "1")
        with open(os.path.dirname(lab.__file__) + "/report.js", encoding="utf-8") as script:
            self.assertEqual(self.browser.value(script.read()), [])
        self.assertEqual(look.wrong(self.browser), [])
        self.drawn = json.loads(self.browser.value("JSON.stringify([...document.querySelectorAll('figure')].map(f => f.figure))"))
        return self.browser.value("document.documentElement.outerHTML"), len(self.drawn)

    def numbers(self, page):
        """The numbers that lie in a page, from which its template draws."""
        return json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL).group(1))

    def see(self, path):
        """A phone and a wide screen, light and dark, paper, and a browser that runs no scripts have the whole page."""
        url, ground = "file://" + os.path.abspath(path), {}
        for width, scheme in (420, "light"), (420, "dark"), (1600, "dark"), (1600, "light"), (1000, "print"):
            self.browser.dress(width, scheme)
            self.assertEqual(look.wrong(self.browser), [], (width, scheme))
            self.assertEqual(self.browser.value(EMPTY), [], (width, scheme))
            ground[scheme] = self.browser.value("getComputedStyle(document.body).backgroundColor")
        self.assertEqual(len(set(ground.values())), 3)
        self.browser.open(url)
        title = self.browser.value("document.title")
        words = self.browser.value("document.querySelector('main').innerText.length")
        closed = self.browser.value("document.querySelectorAll('details:not([open])').length")
        self.browser.dress(1000, "print")
        self.assertEqual(self.browser.value(LEFT_OUT), [])
        self.browser.dress(1000, "light")
        self.assertEqual(self.browser.value("document.querySelectorAll('details:not([open])').length"), closed)
        self.browser.open(url, scripts=False)
        self.assertIsNone(self.browser.value("document.body.dataset.ready"))
        self.assertGreater(self.browser.value("document.querySelector('main').innerText.length"), 0.5 * words)
        self.assertEqual(self.browser.value("document.title"), title)

    def made(self, name):
        """Runs a study unless it was run; the map of stability has a cell that fails."""
        self.write(name + ".yaml", "format: 2\n" + STUDIES[name])
        self.call("run", name + ".yaml", "-o", name, code=4 if name == "stability" else 0)

    def study(self, name):
        """Returns a study's page, what the browser makes of it, and the number of its figures."""
        self.made(name)
        self.call("report", name)
        found = self.read_page(name + "/report.html"), *self.look(name + "/report.html")
        self.see(name + "/report.html")
        return found

    def read_page(self, path):
        self.assertLess(os.path.getsize(path), 5e6)
        with open(path, encoding="utf-8") as file:
            page = file.read()
        self.assertEqual(re.findall(r'(?:src|href)="(?!#)[^"]*"', page), [])
        self.assertEqual(set(re.findall(r"https?://[^\s\"'<]*", page)) -
                         {"http://www.w3.org/" + name for name in ("2000/svg", "2000/xmlns/", "1999/xlink")}, set())
        return page

    def read_extremes(self, page):
        """The instants of the slider hold the least film and the highest pressure of the field."""
        stage = self.numbers(page)["fields"][-1]
        for field, worst in ("pressure", max), ("film", min):
            data = base64.b64decode(stage["values"][field])
            shown = worst(struct.unpack(f"<{len(data) // 4}f", data))
            with open(f"pair/film.{field}.npy", "rb") as file:
                whole = file.read()
            whole = whole[10 + struct.unpack("<H", whole[8:10])[0]:]
            self.assertAlmostEqual(shown / worst(struct.unpack(f"<{len(whole) // 8}d", whole)), 1, places=6)

    def test_gear_pair(self):
        small = [word for stage in ("film", "film_static")
                 for word in ("--set", stage + ".cells=64", "--set", stage + ".steps=400")]
        self.call("run", CONFIGS + "li-kahraman-2011.yaml", "-o", "pair", *small,
                  "--set", "mesh.use=stiffness/potential-energy")
        self.assertEqual(self.call("report", "pair"), "pair/report.html\n")
        page = self.read_page("pair/report.html")
        dom, figures = self.look("pair/report.html")
        self.see("pair/report.html")
        self.assertGreater(figures, 12)
        for words in ("minimum film thickness", "roll angle", "LPSTC", "HPSTC", "µm", "MPa",
                      "Quality of the numbers", "unity-50.yaml", "@article"):
            self.assertIn(words, page)
        films = next(f for f in self.drawn if f["title"] == "Film thickness")
        self.assertEqual([curve["name"].split(" film")[0] for curve in films["curves"]],
                         ["film_static: minimum", "film_static: central", "film: minimum", "film: central"])
        self.assertEqual(films["y"]["label"], "film thickness (µm)")
        self.read_extremes(page)
        self.assertRegex(dom, r'"extremes">film_static: least film 0\.\d+ µm, highest pressure [\d.]+ MPa')
        self.assertRegex(dom, r"<output>roll angle of gear 1 [\d.]+ deg</output>")

    def test_asked(self):
        """The first table has what the file asks for, of any model, in the file's order; what was computed besides is folded."""
        with open("asked.yaml", "w", encoding="utf-8") as file:
            file.write("format: 2\npipeline: {wave: {use: toy/wave, amplitude: 2 mm, count: 8}}\n"
                       "outputs: [wave.total, wave.height, wave.level]\n")
        self.call("run", "asked.yaml", "-o", "asked")
        self.call("report", "asked")
        self.look("asked/report.html")
        asked = self.read_page("asked/report.html").split("<details>")
        self.assertEqual(re.findall(r"<td><code>([^<]*)</code>", asked[0]), ["wave.total", "wave.height", "wave.level"])
        self.assertIn("<code>wave.cost</code>", asked[1])

    def test_label(self):
        """An output is called by the label of its row, if it has one, on terminal and page."""
        with open("label.yaml", "w", encoding="utf-8") as file:
            file.write("format: 2\npipeline: {verge: {use: toy/verge}}\noutputs: [verge.swing]\n")
        self.assertIn("state of <the> verge", self.call("run", "label.yaml", "-o", "label"))
        self.call("report", "label")
        with open("label/report.html", encoding="utf-8") as page:
            self.assertIn('<th scope="row">state of &lt;the&gt; verge</th>', page.read())

    def test_at_least(self):
        """A peak that the cells do not resolve is known from below: print, result.json, page and tables say so of it alone."""
        with open("blow.csv", "w", encoding="utf-8") as file:
            file.write("time [s],radius [mm],speed_1 [m/s],speed_2 [m/s],load_per_width [N/mm]\n"
                       "0,12.8,0.05,0.05,2\n50e-6,12.8,0.05,0.05,150\n120e-6,12.8,0.05,0.05,150\n")
        with open("blow.yaml", "w", encoding="utf-8") as file:
            file.write("format: 2\npipeline:\n  spot: {use: contact/table, file: blow.csv}\n"
                       "  viscosity: {use: viscosity/barus, eta0: 10 mPa s, alpha: 15 1/GPa}\n"
                       "  density: {use: density/dowson-higginson, rho0: 870 kg/m3}\n"
                       "  film: {use: ehl/finite-volume, cells: 64}\n"
                       "outputs: [film.p_max_highest, film.h_min_lowest]\n")
        said = self.call("run", "blow.yaml", "-o", "blow")
        self.assertRegex(said, r"film\.p_max_highest +>= \d+")
        self.assertNotRegex(said, r"film\.h_min_lowest +>=")
        with open("blow/result.json", encoding="utf-8") as file:
            outputs = json.load(file)["outputs"]
        self.assertEqual([o.get("at_least", False) for o in outputs.values()], [True, False])
        self.call("report", "blow")
        page = self.read_page("blow/report.html")
        self.assertRegex(page, r'film\.p_max_highest</code></td><td class="number">≥ ')
        self.assertNotRegex(page, r'film\.h_min_lowest</code></td><td class="number">≥')
        said = self.call("run", "blow.yaml", "--set", "study={sweep: {film.steps: [20, 30]}}", "-o", "blows")
        words = "film.p_max_highest only a lower bound"
        self.assertIn(words + " 2", said)
        self.call("export", "blows", "--to", "csv")
        for table in "blows/table.csv", "blows/results-csv/scalars.csv":
            with open(table, encoding="utf-8") as file:
                self.assertEqual(file.read().count(words), 2)

    def test_inputs(self):
        """What the user has given stands beside the answer; presets and what a study varies do not."""
        self.call("report", "run")
        inputs = self.read_page("run/report.html").split('<dl class="inputs">')[1].split("</dl>")[0]
        self.assertEqual(re.findall("<span>(.*?)</span>", inputs), ["amplitude <b>2 mm</b>", "count <b>9</b>", "end <b>doubtful</b>"])
        self.write("heights.csv", "time [s],radius [mm],speed_1 [m/s],speed_2 [m/s],load_per_width [N/mm]\n0,12.8,9,1,100\n1,12.8,9,1,100\n")
        self.write("named.yaml", f"format: 2\npipeline: {{spot: {{use: contact/table, file: {os.getcwd()}/heights.csv}}}}\noutputs: [spot.radius_1]\n")
        self.call("run", "named.yaml", "-o", "named")
        self.call("report", "named")
        named = self.read_page("named/report.html")
        self.assertIn("<b>heights.csv</b>", named)
        self.assertNotIn(os.getcwd(), named)  # no folder of the author's disk
        page, _, _ = self.study("along")
        self.assertIn("<dt>wave <small>toy/wave</small></dt><dd><span>count <b>8</b></span> </dd>", page)

    def test_pair(self):
        """The pair of the inputs is drawn to scale: tips as typed or by the module, pitch circles that touch."""
        for tips, ratio in (("", 60 / 23), (", tip_diameter: [67 mm, 181 mm]", 181 / 67)):
            self.write("gears.yaml", "format: 2\npipeline: {gears: {use: gear/involute-spur, teeth: [21, 58], module: 3 mm, "
                                     f"face_width: 28 mm, material: steel, centre_distance: 118.6 mm{tips}}}}}\noutputs: [gears.contact_ratio]\n")
            self.call("run", "gears.yaml", "-o", "gears")
            self.call("report", "gears")
            self.look("gears/report.html")
            sizes = self.browser.value("[...document.querySelectorAll('.pair path')].map(p => p.getBBox().height)")
            self.assertAlmostEqual(sizes[1] / sizes[0], ratio, delta=0.02 * ratio)  # a tooth need not stand at the top
            circles = self.browser.value("[...document.querySelectorAll('.pair circle')].flatMap(c => [+c.getAttribute('cx'), +c.getAttribute('r')])")
            self.assertAlmostEqual(circles[2] - circles[0], 118.6)
            self.assertAlmostEqual(circles[1] + circles[3], 118.6)
            self.assertAlmostEqual(circles[3] / circles[1], 58 / 21)

    def test_along(self):
        """A sweep of one axis: curves with the limit, and how many cases meet it."""
        page, _, figures = self.study("along")
        self.assertEqual(figures, 2)  # the total, and the heights of some cases
        self.assertEqual(self.drawn[0]["limit"], {"at": 3, "name": "> 3 mm"})
        self.assertRegex(page, r"Of 6 cases, \d meet the limits of the file")

    def test_spectrum(self):
        """Rows of a load spectrum are no sample, and their numbers no axis."""
        page, dom, _ = self.study("spectrum")
        self.assertNotIn("median", page.split("<main>")[1].split("</main>")[0])
        self.assertNotIn("Over what is varied</h2>", dom)
        self.assertEqual([f["title"] for f in self.drawn if "distribution" in f["title"]], [])
        self.assertIn("share of the time below a value", dom)

    def test_share(self):
        """A friction coefficient has its extremes where there is load; without load it may be anything."""
        self.write("fade.csv", "time [s],radius [mm],speed_1 [m/s],speed_2 [m/s],load_per_width [N/mm]\n"
                               "0,12.8,9,1,0.1\n50e-6,12.8,1,9,0.1\n100e-6,12.8,3,2.9,150\n200e-6,12.8,2.9,3,150\n250e-6,12.8,3,3,0.1\n")
        self.write("fade.yaml", "format: 2\npipeline:\n  spot: {use: contact/table, file: fade.csv}\n"
                                "  viscosity: {use: viscosity/barus, eta0: 10 mPa s, alpha: 6 1/GPa}\n"
                                "  density: {use: density/dowson-higginson, rho0: 870 kg/m3}\n"
                                "  film: {use: ehl/film-formula}\noutputs: [film.time, film.friction_coefficient]\n")
        said = self.call("run", "fade.yaml", "-o", "fade")
        with open("fade/film.friction_coefficient.npy", "rb") as file:
            friction = struct.unpack("<5d", file.read()[-40:])
        self.assertGreater(max(abs(f) for f in friction[:2]), max(abs(f) for f in friction[2:4]))
        shown = f"{friction[3]:.4g} to {friction[2]:.4g}"
        self.assertIn(shown, said)
        self.call("report", "fade")
        self.call("compare", "fade", "fade", "-o", "faded")
        page = self.read_page("fade/report.html")
        self.assertIn(shown, page)
        self.look("fade/report.html")
        drawn = next(f["y"] for f in self.drawn if f["title"] == "Friction coefficient")
        self.assertLess(max(abs(drawn[end]) for end in ("low", "high")), 1.3 * max(abs(f) for f in friction[2:4]))
        self.assertIn("; where load per width is above 1 % of its largest", page)
        with open("faded.csv", encoding="utf-8") as table:
            self.assertEqual([float(row["fade"]) for row in csv.DictReader(table) if "friction" in row["output of flankfilm"]],
                             [float(f"{friction[k]:.9g}") for k in (3, 2)])

    def test_two_axes(self):
        """Series of one output name over different axes have a figure each, along the path and over time."""
        self.write("blow.csv", "time [s],radius [mm],speed_1 [m/s],speed_2 [m/s],load_per_width [N/mm]\n"
                               "0,12.8,9,1,20\n50e-6,12.8,9,1,150\n120e-6,12.8,9,1,90\n")
        self.write("axes.yaml", f"format: 2\ninclude: [{CONFIGS}li-kahraman-2011.yaml]\n"
                                "pipeline: {mesh: {use: stiffness/iso-6336}, spot: {use: contact/table, file: blow.csv}}\n"
                                "outputs: [static.roll_angle, static.load_per_width, spot.time, spot.load_per_width]\n")
        self.call("run", "axes.yaml", "-o", "axes")
        self.call("report", "axes")
        self.look("axes/report.html")
        self.assertEqual([(f["title"], f["x"]["label"], [c["name"] for c in f["curves"]]) for f in self.drawn],
                         [("Load per width", "roll angle of gear 1 (deg)", ["static"]), ("load per width", "time since the start of the history (µs)", ["spot"])])

    def test_gaps(self):
        """A curve of more points than a drawing holds keeps its gaps and its peaks."""
        self.made("along")
        self.call("report", "along")
        self.browser.open("file://" + os.path.abspath("along/report.html"))
        values = [1.0, -1.0] * 4500
        values[700], values[2001:2004], values[4000] = 9.0, [float("nan")] * 3, -9.0
        def packed(numbers):
            return base64.b64encode(struct.pack(f"<{len(numbers)}f", *numbers)).decode()
        data = self.numbers(self.read_page("along/report.html"))
        data["lengths"], data["standing"], data["series"] = [9000], "0" * 9000, []
        data["scalars"] = {"wave.total": packed(values)}
        data["axes"][0].update(values=packed(range(9000)), named=[])
        data["outputs"]["wave.total"].update(factor=1)
        drawn = self.browser.value(f"choice.sections({json.dumps(data)})[0].figures[0].curves[0].y")
        self.assertLess(len(drawn), 3000)
        self.assertEqual((max(v for v in drawn if v), min(v for v in drawn if v), drawn.count(None)), (9, -9, 1))

    def test_rough_flanks(self):
        """The flanks move with the slider, asperities have their pressure, and nothing is out of the figure."""
        self.call("run", CONFIGS + "mixed-film.yaml", "-o", "rough", "--set", "film.cells=128", "--set", "film.steps=60",
                  "--set", "film.roughness_cutoff=20 um",  # else the cells leave nothing that touches
                  "--set", "outputs=[film.roll_angle, film.x, film.film, film.pressure, film.asperity_pressure, film.roughness]")
        self.call("report", "rough")
        self.look("rough/report.html")
        self.assertEqual(self.browser.value("document.querySelectorAll('.snapshots .plot').length"), 3)
        self.assertIn("film: of asperities", [curve["name"] for f in self.drawn for curve in f["curves"]])

    def test_points(self):
        """Points of the path that the file does not ask for are marked, of a run and of designs that are compared."""
        for name, torque in ("light", "100 N m"), ("heavy", "250 N m"):
            self.call("run", CONFIGS + "li-kahraman-2011.yaml", "-o", name, "--set", "mesh.use=stiffness/iso-6336", "--set",
                      "outputs=[static.roll_angle, static.load_per_width]", "--set", "duty.torque=" + torque)
        self.call("report", "light")
        self.call("compare", "light", "heavy", "-o", "side")
        for page in "light/report.html", "side.html":
            text = self.read_page(page)
            self.assertEqual([mark for mark in ("SAP", "LPSTC", "pitch", "HPSTC", "tip") if f'"{mark}"]' not in text], [])
        self.assertIn("<th>difference</th>", text)  # without scripts, too
        _, figures = self.look("side.html")
        self.see("side.html")
        self.assertEqual(figures, 1)
        self.assertEqual([max(x for x in c["x"] if x is not None) for c in self.drawn[0]["curves"]], [4, 4])  # at the tip

    def test_atlas(self):
        self.call("run", CONFIGS + "li-kahraman-2011.yaml", "-o", "atlas", "--set", "mesh.use=stiffness/iso-6336", "--set",
                  "motion.atlas={from: 1500 Hz, to: 4000 Hz}", "--set", "motion.search_starts=2", "--set", "motion.max_period=2", "--set",
                  "outputs=[motion.atlas_frequency, motion.atlas_rms, motion.atlas_stable, motion.atlas_branch, duty.mesh_frequency]")
        self.call("report", "atlas")
        dom, figures = self.look("atlas/report.html")
        self.assertGreater(figures, 0)
        self.assertIn("all periodic motions", dom)

    def test_sample(self):
        page, dom, figures = self.study("sample")
        self.assertEqual(figures, 3)  # its distribution, its correlation with the input, over each input
        self.assertEqual(next(f["y"]["low"] for f in self.drawn if f["y"]["label"] == "cases"), 0)  # columns stand on 0
        for words in ("median", "95 %"):
            self.assertIn(words, page)
        self.assertIn("rank correlation", dom)

    def test_uncertainty(self):
        """What limits an output, its histogram with percentiles, and the share of each input."""
        page, dom, figures = self.study("uncertainty")
        self.assertEqual(figures, 6)  # and the three of its samples
        self.assertNotIn("error bar", page.split('class="verdict span')[1].split("</table>")[0])
        # 8 points make 3.6 amplitudes, 12 make 0.2; an amplitude is known to 5 %
        self.assertIn("the choice of the model matters", page)
        for words in ("What limits each output", "spread by the inputs", "50 % are below", "share of the variance"):
            self.assertIn(words, dom)

    def test_tradeoff(self):
        """Its cases are named by what they set, with a table of the front and one of all candidates."""
        page, dom, figures = self.study("tradeoff")
        self.assertEqual(figures, 1)
        # levels that were not needed are no cases
        self.assertIn('<p class="judgement"><span class="badge good">good</span> Of 6 cases, 6 are good, ', page)
        for words in ("error against cost", "the front", "all candidates", "reference 1, n 200<"):
            self.assertIn(words, page)  # without scripts, too
        self.assertNotRegex(page, ", ,|, <")
        self.assertNotIn("case", [f["x"]["label"] for f in self.drawn])  # no figure over the numbers of cases
        with open("tradeoff/table.csv", encoding="utf-8") as file:
            self.assertEqual(len(file.readlines()), 7)

    def test_stability(self):
        """A map has a letter and a reason for each cell, and its boundaries."""
        page, dom, figures = self.study("stability")
        self.assertGreater(figures, 0)
        self.assertIn("cells that are not converged, and why", dom)
        self.assertRegex(dom, r"<b[^>]*>F</b>\d+ failed")
        self.assertIn("Black lines", dom)

    def test_one_instant(self):
        self.call("run", CONFIGS + "line-contact.yaml", "-o", "steady", "--set", "film.cells=64")
        self.call("report", "steady")
        page = self.read_page("steady/report.html")
        self.assertIn("Steady line contact", page)
        for name in set(re.findall(r'href="#means-(\w+)"', page)):  # a doubt leads to what the guide says of it
            self.assertRegex(page, f'<span id="means-{name}">')
        self.assertRegex(page, r'href="#means-\w+_error"')

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
        self.call("run", "run.yaml", "-o", "map", "--set", "outputs=sum.sum", "--set", 'limits={sum.sum: "> 10 mm"}', "--set",
                  "study={sweep: {wave.amplitude: {from: 1 mm, to: 5 mm, points: 5}, wave.count: {from: 8, to: 38, points: 11}}}")
        self.call("report", "map")
        dom, _ = self.look("map/report.html")
        self.assertIn("the thick one is the limit of 10. \u2605 the best. Crossed out: a limit is missed", dom)
        with open("map/table.csv", encoding="utf-8") as table:
            cases = list(csv.DictReader(table))
        self.assertEqual(sum(row.count("2") for row in self.drawn[0]["standing"]), sum("missed" in case["limits"] for case in cases))
        self.assertIn("linear scale", dom)

    def test_decades(self):
        for spacing, log in (("log", 1), ("linear", 0)):
            self.call("run", "run.yaml", "-o", spacing, "--set", "outputs=sum.sum", "--set",
                      "study={sweep: {wave.amplitude: {from: 0.01 mm, to: 1 mm, points: 5, "
                      f"spacing: {spacing}}}}}}}")
            self.call("report", spacing)
            self.look(f"{spacing}/report.html")
            self.assertEqual(self.drawn[0]["x"], {"label": "amplitude (mm)", "log": log})

    def test_description(self):
        with open("own.json", "w", encoding="utf-8") as file:
            file.write('''[{"sort": "curves", "title": "</script>", "marks": [], "x": {"label": "x", "log": 1}, "y": {"label": "y"},
                "z": {"label": "z", "low": 0, "high": 9, "step": 3}, "curves": [
                {"name": "a", "colour": "#0072b2", "dash": [6, 3], "style": "line", "x": [1, 10, 100], "y": [2, null, 3]},
                {"name": "b", "colour": 1, "dash": 0, "axis": "z", "style": "line", "x": [1, 100], "y": [0, 9]}]}]''')
        os.makedirs("lab", exist_ok=True)
        self.write("lab/page.css", "h1{color:teal}\n")
        self.assertEqual(self.call("report", "own.json", "--template", "lab"), "own.html\n")
        self.assertIn("h1{color:teal}", self.read_page("own.html"))
        _, figures = self.look("own.html")
        self.assertEqual(figures, 1)
        self.assertEqual(self.browser.value("answers.shares({shares: {a: {first: {value: null}, total: {value: 1}, untold: 'too few samples (4)'}}}).note"),
                         "too few samples (4) 1 of 1 alone.")
        with open("own.json", "w", encoding="utf-8") as file:
            file.write("{}")
        self.assertIn("does not describe figures", self.call("report", "own.json", code=2))

    def test_template(self):
        """A lab chooses the figures of its pages by a script of its own; their numbers lie in the page."""
        os.makedirs("ours", exist_ok=True)
        self.write("ours/choose.js", """var choice = {sections: function (data) {
          return [{at: 'over', title: 'Ours', figures: Object.keys(data.scalars).map(function (name) {
            var of = data.outputs[name], y = Array.from(new Float32Array(Uint8Array.from(atob(data.scalars[name]), c => c.charCodeAt(0)).buffer));
            return {sort: 'curves', title: of.label, class: '', marks: [], x: {label: 'case', log: 0}, y: {label: of.si, log: 0},
              curves: [{name: name, colour: 0, dash: 0, style: 'line', x: y.map((_, i) => i), y: y}]};
          })}];
        }};""")
        self.made("along")
        self.call("report", "along", "--template", "ours", "-o", "ours.html")
        dom, figures = self.look("ours.html")
        self.assertIn("<h2>Ours</h2>", dom)
        self.assertEqual(figures, 1)
        with open("along/table.csv", encoding="utf-8") as table:
            totals = [float(case["wave.total [m]"]) for case in csv.DictReader(table)]
        for shown, total in zip(self.drawn[0]["curves"][0]["y"], totals, strict=True):
            self.assertAlmostEqual(shown / total, 1, places=6)

    def test_without_library(self):
        self.call("report", "run")
        page = self.read_page("run/report.html").replace("self.vega =", "self.none =")
        script = re.search(r"<script>(.*)</script>", page, re.DOTALL).group(1).encode()
        named = base64.b64encode(hashlib.sha256(script).digest()).decode()
        page = re.sub(r"script-src 'sha256-[^']*'", lambda _: f"script-src 'sha256-{named}'", page)  # else nothing runs
        with open("tables.html", "w", encoding="utf-8") as file:
            file.write(page)
        dom, figures = self.look("tables.html")
        self.assertGreater(figures, 0)
        self.assertIn('<p class="alarm without">This build has no plotting library', dom)
        self.assertRegex(dom, r'</figcaption>(<p class="note">[^<]*</p>)?<div class="wide"><table>')

    def test_hostile_results(self):
        """Whatever text and name of a result is markup, the page of each sort shows it as text."""
        for name in STUDIES:
            self.made(name)
        for name in "run", "study", *STUDIES:
            taken = self.poison(name)
            self.assertGreater(taken, 20, name)
            self.call("report", "hostile", "-o", "hostile.html")
            self.harmless("hostile.html")
        self.poison("run")
        self.call("compare", "hostile", "run", "-o", "against")
        self.harmless("against.html")

    def harmless(self, path):
        with open(path, encoding="utf-8") as file:
            self.assertEqual(file.read().count("<img"), 0)
        self.browser.open("file://" + os.path.abspath(path))
        self.assertEqual(self.browser.value("document.body.dataset.ready"), "1")
        self.assertNotEqual(self.browser.value("document.title"), "evil")
        self.assertEqual(self.browser.value("document.querySelectorAll('img, [onerror]').length"), 0)
        self.assertGreater(self.browser.value("document.querySelector('main').textContent.split('<img').length"), 5)

    def poison(self, name):
        """Copies results and puts markup into each text and name but those of files that are read; returns how many."""
        def places(of, path):
            if isinstance(of, dict):
                for key, one in of.items():
                    yield from places(one, (*path, key))
                    if path[-1:] and path[-1] in NAMED:
                        yield (*path, key), True
            elif isinstance(of, list):
                for k, one in enumerate(of[:3]):
                    yield from places(one, (*path, k))
            elif isinstance(of, str):
                yield path, False

        def store(chosen):
            files = copy.deepcopy(whole)
            for path, key in sorted(chosen, key=lambda place: (place[1], -len(place[0]))):  # names after texts, from within
                of = files
                for step in path[:-1]:
                    of = of[step]
                if key:
                    of[HOSTILE + path[-1]] = of.pop(path[-1])
                else:
                    of[path[-1]] = HOSTILE
            for name, value in files.items():
                self.write("hostile/" + name, json.dumps(value))

        shutil.rmtree("hostile", ignore_errors=True)
        shutil.copytree(name, "hostile")
        whole = {file: self.read("hostile/" + file) for file in os.listdir("hostile") if file.endswith(".json")}
        taken = [(path, key) for path, key in places(whole, ()) if len(path) > 1 and not (path[-1] == "file" and path[1] in ("outputs", "computed"))]
        store(taken)
        return len(taken)

    def test_sweep(self):
        """Of a sweep of several axes the best of each condition stands first; what no figure can hold is small tables. Both need no script."""
        page, _, _ = self.study("sweep")
        with open("sweep/table.csv", encoding="utf-8") as table:
            cases = list(csv.DictReader(table))
        best = page.split('<table class="best">')[1].split("</table>")[0]
        for case in cases:  # the first wave is a condition, and does not change what is best of the second
            row = best.split(f"amplitude {case['wave.amplitude [mm]']} mm, count {case['wave.count']}</th>")[1].split("</tr>")[0]
            shown, unit = re.search('data-head="wave.total"><div>\u25bc <b>([0-9.]+) (\\S+)</b> at', row).groups()
            self.assertAlmostEqual(float(shown) * {"mm": 1e-3, "\u00b5m": 1e-6}[unit] / float(case["wave.total [m]"]), 1, places=3)
            self.assertIn("<b>10.85 mm</b> at 3 mm<", row)
        self.assertEqual(page.count('class="missed'), 30)  # 1 mm, under all conditions, of both outputs
        self.assertEqual(page.count("\u2605\u202f10.85<"), 3)
        self.assertNotIn("10.85 mm</b>", self.sought("wave.total=least"))
        self.assertIn("<b>7.233 mm</b> at 2 mm<", self.sought("wave.total=largest", "second.total=least"))  # 1 mm misses the limit
        for words, said in (("wave.totl=least", 'did you mean "wave.total"'), ("wave.total", "OUTPUT=least or OUTPUT=largest")):
            self.assertIn(said, self.call("report", "sweep", "--best", words, code=2))
        self.assertIn("not of a sweep", self.call("report", "run", "--best", "sum.sum=least", code=2))

    def sought(self, *best):
        self.call("report", "sweep", "-o", "sought.html", *[word for one in best for word in ("--best", one)])
        return self.read_page("sought.html").split('<table class="best">')[1].split("</table>")[0]

    def test_failed_run(self):
        self.call("run", "run.yaml", "-o", "failed", "--set", "wave.end=fail", code=1)
        self.call("report", "failed")
        self.assertIn("The run did not succeed (<b>failed</b>): wave", self.read_page("failed/report.html"))
        self.look("failed/report.html")

    def test_disk_full(self):
        self.call("report", "run")
        with open("run/report.html", "rb") as file:
            before = file.read()
        self.assertIn("could not be written", self.call("report", "run", code=1, limit=4))
        with open("run/report.html", "rb") as file:
            self.assertEqual(file.read(), before)


lab.main()
