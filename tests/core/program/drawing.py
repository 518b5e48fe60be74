# SPDX-License-Identifier: GPL-3.0-or-later
"""explain --drawing: a table against a calculation of its own, ranges of tolerances among it.

    python3 drawing.py FLANKFILM PLUGINS SOURCE
"""
import itertools
import json
import math
import os
import subprocess
import sys
import tempfile

program, plugins, source = sys.argv[1:]
Z, X, M, ALPHA, DISTANCE, A = (21, 58), (0.3, 0.1), 3e-3, math.radians(20), 119.664e-3, (-60e-6, -90e-6)
TIP = (70.728e-3, 180.528e-3)
TOLERANCES = """format: 2
pipeline:
  gears:
    use: gear/involute-spur
    teeth: [21, 58]
    module: 3 mm
    face_width: 28 mm
    profile_shift: [0.3, 0.1]
    tip_diameter: [70.728 mm, 180.528 mm]
    centre_distance: 119.664 mm +- 20 um
    thickness_allowance: [-75 um to -45 um, -110 um to -70 um]
    material: 18CrNiMo7-6
"""


def involute(angle):
    return math.tan(angle) - angle


def bisect(f, low, high):
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if f(middle) < 0 else (low, middle)
    return low


def span(i, allowance, count):
    """As tables of spans have it: m cos a ((k - 1/2) pi + z inv a) + 2 x m sin a, and the allowance normal to the flank."""
    full = M * math.cos(ALPHA) * ((count - 0.5) * math.pi + Z[i] * involute(ALPHA)) + 2 * X[i] * M * math.sin(ALPHA)
    return full + allowance * math.cos(ALPHA)


def over_pins(i, allowance, pin):
    """The axis of the pin is where half the space, s_y = 2 r_y (pi/z - ...), has room for it along the base tangent."""
    r = M * Z[i] / 2
    base = r * math.cos(ALPHA)
    space = math.pi / Z[i] - (M * (math.pi / 2 + 2 * X[i] * math.tan(ALPHA)) + allowance) / (2 * r) - involute(ALPHA)
    angle = bisect(lambda a: involute(a) * base + space * base - pin / 2, 1e-6, 1.4)
    return 2 * base / math.cos(angle) * (math.cos(math.pi / 2 / Z[i]) if Z[i] % 2 else 1) + pin


def backlash(distance, allowances):
    """What the arcs of both teeth leave of the pitch of the working circle, along the line of action."""
    working = math.acos(M * sum(Z) / 2 * math.cos(ALPHA) / distance)
    left = 2 * math.pi * distance / sum(Z)
    for i in range(2):
        r = M * Z[i] / 2
        arc = M * (math.pi / 2 + 2 * X[i] * math.tan(ALPHA)) + allowances[i]
        left -= 2 * distance * Z[i] / sum(Z) * (arc / (2 * r) + involute(ALPHA) - involute(working))
    return left * math.cos(working)


def contact_ratio(distance):
    working = math.acos(M * sum(Z) / 2 * math.cos(ALPHA) / distance)
    path = -distance * math.sin(working)
    for i in range(2):
        path += math.sqrt((TIP[i] / 2) ** 2 - (M * Z[i] / 2 * math.cos(ALPHA)) ** 2)
    return path / (math.pi * M * math.cos(ALPHA))


def ends(middle, half):
    return middle - half, middle + half


def explain(file, *more):
    run = subprocess.run([program, "explain", file, "--drawing", "--plugin-path", plugins, *more],
                         capture_output=True, text=True)
    return run.returncode, run.stdout, run.stderr


def expect(what, value, wanted, within):
    assert abs(value - wanted) <= within, f"{what}: {value}, expected {wanted}"


def check_numbers(gears):
    half = (15e-6, 20e-6)
    for i in range(2):
        count, pin = gears["span_teeth"]["value"][i], gears["pin_diameter"]["value"][i]
        low, high = ends(A[i], half[i])
        for name, by_hand in (("span", lambda a: span(i, a, count)), ("over_pins", lambda a: over_pins(i, a, pin))):
            expect(name, gears[name]["value"][i], by_hand(A[i]), 1e-9)
            expect(name + " lowest", gears[name]["lowest"][i], by_hand(low), 1e-9)
            expect(name + " highest", gears[name]["highest"][i], by_hand(high), 1e-9)
        expect("base", gears["base_radius"]["value"][i], M * Z[i] / 2 * math.cos(ALPHA), 1e-12)
        expect("root", gears["root_radius"]["value"][i], M * (Z[i] / 2 + X[i] - 1.25), 1e-12)
        expect("modulus", gears["elastic_modulus"]["value"][i], 210e9, 1)
    corners = [backlash(d, (a, b)) for d, a, b in
               itertools.product(ends(DISTANCE, 20e-6), ends(A[0], half[0]), ends(A[1], half[1]))]
    expect("backlash", gears["backlash"]["value"][0], backlash(DISTANCE, A), 1e-11)
    expect("least backlash", gears["backlash"]["lowest"][0], min(corners), 1e-11)
    expect("largest backlash", gears["backlash"]["highest"][0], max(corners), 1e-11)
    expect("contact ratio", gears["contact_ratio"]["value"][0], contact_ratio(DISTANCE), 1e-9)
    expect("least contact ratio", gears["contact_ratio"]["lowest"][0], contact_ratio(DISTANCE + 20e-6), 1e-9)


with tempfile.TemporaryDirectory() as place:
    file = os.path.join(place, "pair.yaml")
    with open(file, "w", encoding="utf-8") as out:
        out.write(TOLERANCES)
    code, text, _ = explain(file)
    assert code == 0, text
    rows = {line[:42].strip(): line[42:].split() for line in text.splitlines()}
    assert rows["centre distance a"] == ["119.6640", "(119.6440", "to", "119.6840)", "mm"], rows["centre distance a"]
    assert rows["tip diameter d_a"] == ["70.7280", "180.5280", "mm"], rows["tip diameter d_a"]
    assert rows["material"] == ["18CrNiMo7-6"]
    assert not any("tolerance" in row for row in rows), "no class, no tolerances"
    code, text, _ = explain(file, "--json")
    check_numbers(json.loads(text)["gears"])

    reliefs = {"tip_relief": "[20 um, 8 um]", "tip_relief_diameter": "[69.4 mm, 179.2 mm]", "tip_relief_shape": "parabolic",
               "root_relief": "6 um", "root_relief_length": "[1.5 mm, 2 mm]", "quality": "6"}
    code, text, _ = explain(file, *[word for name, value in reliefs.items() for word in ("--set", f"gears.{name}={value}")])
    rows = {line[:42].strip(): line[42:].strip() for line in text.splitlines()}
    assert [rows.get(row) for row in ("tip relief", "tip relief from the diameter", "shape of the tip relief", "root relief",
                                      "length of the root relief", "accuracy class of ISO 1328-1")] == list(reliefs.values()), text
    assert rows["profile slope tolerance f_H_alpha"].split() == ["7.0", "8.0", "um"], text

    code, _, said = explain(file, "--set", "gears.thickness_allowance=[-60 um to 0 um, -60 um to 120 um]")
    assert code == 2 and "jam by" in said and "cannot be made" in said, said
    code, _, said = explain(os.path.join(source, "configs/line-contact.yaml"))
    assert code == 2 and "none of the stages that run is a pair of gears" in said, said
