# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of every example, computed coarsely, is written, has a verdict and no empty figure.

  pages.py FLANKFILM PLUGINS CONFIGS [watched]

`watched`: by a sanitizer, for which one example in three will do.
"""
import glob
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

flankfilm, plugins, configs = map(os.path.abspath, sys.argv[1:4])
sys.path.insert(0, os.path.join(os.path.dirname(configs), "docs"))
import look as screen

browser = screen.Browser() if shutil.which("chromium") else None  # figures are made in one
os.environ["FLANKFILM_PLUGIN_PATH"] = plugins
faults = []

# The figures of which no curve and no map has a number; those that a slider moves have theirs beside them.
EMPTY = """[...document.querySelectorAll('figure:not(.live)')].filter(node => ![...(node.figure.curves || []).map(c => c.y), ...(node.figure.values || []),
  node.figure.cells || []].some(list => list.some(Number.isFinite))).map(node => node.textContent)"""
WRONG = re.compile(r"\bundefined\b|\bnan\b|\binf\b|\(null\)|<td></td><td class=\"number\"></td>", re.IGNORECASE)


def coarse(text):
    """Settings that make the films of a file cheap, and what is asked of its numbers."""
    words = []
    for stage in re.findall(r"^ +(\w+): *{use: ehl/(?:finite-volume|control-volume)", text, re.MULTILINE):
        words += ["--set", f"{stage}.cells=128", "--set", f"{stage}.steps=100"]
    if re.search("^accuracy:", text, re.MULTILINE):
        words += ["--set", "accuracy=20 %"]
    return words


def call(*words):
    return subprocess.run([flankfilm, *words], capture_output=True, text=True, check=False, timeout=100)


def look(name, path, verdict):
    with open(path, encoding="utf-8") as file:
        page = file.read().split("<script>")[0]
    found = [f"says {match.group()}" for match in WRONG.finditer(re.sub(r"<style.*?</style>", "", page, flags=re.DOTALL))]
    figures = 0
    if browser:
        browser.open("file://" + os.path.abspath(path))
        figures = browser.value("document.querySelectorAll('figure').length")
        found += ["has an empty figure: " + words[:120] for words in browser.value(EMPTY)] + screen.wrong(browser)
    if not re.search(verdict, page):
        found.append("has no verdict")
    faults.extend(f"{name} {what}" for what in found)
    print(f"{name}: {figures} figures, {len(found)} faults")


files = sorted(glob.glob(configs + "/*.yaml"))
with tempfile.TemporaryDirectory() as lab:
    os.chdir(lab)
    for file in files[::3 if "watched" in sys.argv[4:] else 1]:
        name = os.path.basename(file)
        with open(file, encoding="utf-8") as stream:
            ran = call("run", file, "-o", name, *coarse(stream.read()))
        done = call("report", name)
        if ran.returncode not in (0, 1) or done.returncode:
            faults.append(f"{name}: run {ran.returncode}, report {done.returncode}: {ran.stderr}{done.stderr}")
            continue
        with open(name + "/result.json", encoding="utf-8") as result:
            verdict = json.load(result)["verdict"]
        look(name, name + "/report.html", rf'<p class="judgement"><span class="badge (bad|{verdict})">{verdict}</span>')
    # that of a study, whose fastest case is outside of a calibrated range
    ran = call("run", configs + "/line-contact.yaml", "-o", "study", "--set", "film.use=ehl/film-formula",
               "--set", "outputs=[film.h_central]", "--set",
               "study={sweep: {discs.entrainment_speed: [1 m/s, 2 m/s, 4 m/s], viscosity.B: [4, 5, 12]}}")
    done = call("report", "study")
    if ran.returncode or done.returncode:
        faults.append(f"study: run {ran.returncode}, report {done.returncode}: {ran.stderr}{done.stderr}")
    else:
        look("study", "study/report.html", r'</span> Of 9 cases, 9 are good, (.|\n)*"note">9 good[^<]*; outside the range of a model 2 \(')
if browser:
    browser.close()
if len(files) < 10:
    faults.append(f"only {len(files)} files in {configs}")
print("\n".join(faults))
sys.exit(bool(faults))
