#!/bin/sh
# Writes friction.md: the loss of a gear mesh that was measured, and the friction of FZG gears, by laws of oils that were measured elsewhere.
#   sh docs/validation/friction.sh build
set -eu
build=$(realpath "${1:-build}")
cd "$(dirname "$0")/../.."
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
python3 - "$build/flankfilm" >"$lab/page" <<'END'
import json, subprocess, sys

program = sys.argv[1]
FILE = "configs/validation/mesh-loss-oils.yaml"
TEETH = {2000: 117, 4000: 120, 6000: 124, 8000: 127, 10000: 129}
with open("configs/validation/mesh-loss.csv") as f:
    MEASURED = {int(row[0]): (1000 * float(row[1]), 1000 * float(row[2])) for row in (line.split(";") for line in f if line[0].isdigit())}
MINERAL = ["oil.base=mineral", "losses.lubricant_factor=0.8"]
LAWS = {"PAO100 (the choice)": [],
        "PAO100, tau_E -10 %": ["flow.limiting_stress_coefficient=0.0315"],
        "PAO100, tau_E +10 %": ["flow.limiting_stress_coefficient=0.0385"],
        "paraffinic M100": [*MINERAL, "viscosity.base=paraffinic", "flow.limiting_stress_coefficient=0.047"],
        "naphthenic N100": [*MINERAL, "viscosity.base=naphthenic", "flow.limiting_stress_coefficient=0.053"],
        "`lubricants/75w90.yaml`: Roelands, tau0 5 MPa": ["viscosity={use: viscosity/roelands}", "flow={use: rheology/ree-eyring, tau0: 5 MPa}"]}


def run(file, sets):
    """Scalars of the losses; None where no film was found."""
    words = [program, "run", file, "--json"]
    for word in sets:
        words += ["--set", word]
    told = json.loads(subprocess.run(words, capture_output=True, text=True, check=False).stdout)
    if told["exit"] != 0:
        return None
    return {k: v["value"] for stage in told["stages"] if stage["stage"] == "losses" for k, v in stage["scalars"].items()}


def held(speed):
    return ["duty.speed=%d rpm" % speed, "film.bulk_temperature=%d degC" % TEETH[speed], "losses.bulk_temperature=%d degC" % TEETH[speed]]


told = {name: {speed: run(FILE, held(speed) + sets) for speed in MEASURED} for name, sets in LAWS.items()}
speeds = list(MEASURED)
print("""# Friction and loss against measurement

Made by `sh docs/validation/friction.sh build`. The first sections are for the 40/40 spur pair of Petry-Johnson, Kahraman,
Anderson & Chase 2008 at 413 N m ([its data](measured.md#loss-of-a-spur-gear-mesh),
`configs/validation/mesh-loss-oils.yaml`). Laws and temperatures were fixed before the first run, and no constant is fitted. Laws of the measured oil, a 75W90, at high pressure are not
published. All rows therefore use eta0 of the 75W90, and the rise with pressure and the limiting stress of one of three
measured gear oils. The spread of the rows shows what this choice means for the loss.

## Loss of the mesh, W

| laws | %s rpm |
|---|%s""" % (" | ".join(str(s) for s in speeds), "---|" * len(speeds)))
for name, row in told.items():
    print("| %s | %s |" % (name, " | ".join("%.0f" % r["power_loss_mean"] if r else "no film was found" for r in row.values())))
print("| **measured** | %s |" % " | ".join("%.0f to %.0f" % MEASURED[s] for s in speeds))
first = next(iter(told.values()))
print("\nOf the losses in the first row, sliding makes %s W.\n" % ", ".join("%.0f" % r["sliding_loss_mean"] if r else "-" for r in first.values()))
print("## Compared with the measured interval, widened by 10 %\n\n| rpm | loss by PAO100, W | difference from the nearer end of the measured interval | |\n|---|---|---|---|")
for s in speeds:
    low, high = MEASURED[s]
    loss = first[s] and first[s]["power_loss_mean"]
    off = 0 if loss is None or low <= loss <= high else loss / (high if loss > high else low) - 1
    judged = "shown" if s in (2000, 10000) else "met" if loss and abs(off) <= 0.1 else "**missed**"
    print("| %d | %s | %s | %s |" % (s, "%.0f" % loss if loss else "-", "within" if loss and off == 0 else "%+.0f %%" % (100 * off), judged))
print("""
Up to 8000 rpm the measured losses lie between those of PAO100 and M100; PAO100 is off by up to 16 % from 4000 to 8000
rpm, instead of 10 %. The choice of the oil changes the loss by a factor of 2.2 to 3.4. An Eyring stress 10 % higher or
lower changes it only by 1 to 3 %, since heat limits the stress. These films neglect that oil conducts heat better under
pressure, and that asperities touch at 2000 rpm. At 2000 and 10000 rpm the result is shown but not judged.

## Friction coefficients

The film's coefficient is weighted with load and sliding speed; the formula is that of ISO/TR 14179-2; the measured coefficient is the loss
divided by the power and by a loss factor that assumes half the load on each of two pairs.

| rpm | film | formula | measured |
|---|---|---|---|""")
for s in speeds:
    r = first[s]
    if r:
        scale = r["power_input"] * r["loss_factor"]
        print("| %d | %.4f | %.4f | %.4f to %.4f |" % (s, r["friction_coefficient_mean"], r["friction_coefficient_formula"], MEASURED[s][0] / scale, MEASURED[s][1] / scale))

C_PT, C_MOD = "configs/validation/fzg-friction.yaml", "configs/validation/fzg-cmod-friction.yaml"
FLUID = ["film.roughness=ignored"]
RPM = {0.5: 130.5, 2: 522, 8.3: 2166, 8.6: 2250, 20: 5218}  # at the pitch line, m/s
# mean coefficients of the fluid alone by a local model of the contact, computed by a separate program with the same laws
LOCAL = {94.1: (0.0368, 0.0392, 0.0375, 0.0324), 183.4: (0.0456, 0.0458, 0.0429, 0.0361), 302: (0.0470, 0.0470, 0.0442, 0.0366)}


def mu(r, key="friction_coefficient_mean"):
    return r[key] if r else float("nan")


def off(value, of):
    return "%+.0f %%" % (100 * (value / of - 1))


print("""
## FZG C-mod gears

`%s`: 183.4 N m, Ra 0.2 um, a paraffinic gear oil of ISO VG 100 at 90 degC. At 0.5 m/s a mean of at most 0.065 was measured; the film's boundary friction, 0.065, comes from the same source, so this row agrees by construction and tests nothing. At 8.3 m/s
only the formula's 0.0423 is known, which was not measured on these gears; the film is expected between 0.040 and 0.055.

| m/s | film, fluid alone | with asperities | formula | expected | |
|---|---|---|---|---|---|""" % C_MOD)
for v, low, high in ((0.5, 0, 0.065), (8.3, 0.04, 0.055)):
    speed = ["duty.speed=%g rpm" % RPM[v]]
    fluid, both = run(C_MOD, speed + FLUID), run(C_MOD, speed)
    print("| %g | %.4f | %.4f | %.4f | %s | %s |" % (v, mu(fluid), mu(both), mu(both, "friction_coefficient_formula"),
                                              "%.3f to %.3f" % (low, high) if low else "at most %.3f" % high, ("met" if low else "by construction") if low <= mu(both) <= high else "**missed**"))
TEETH_ONLY = ["flanks=", "gears.roughness_ra=0.3 um", "film={use: ehl/inlet-analysis, thermal: local}"]
print("""
## FZG C-PT gears over torque and speed

`%s`: the same oil, Ra 0.3 um, tooth temperature by ISO/TR 15144-1 from the loss of the run. *Local* is a model of the contact at one temperature, with
the same laws and without asperities: *other* was computed by a separate program, *here* is `thermal: local` of `ehl/inlet-analysis`. The film is expected within 10 %% of
*other*, and above 2 m/s within -40 to +25 %% of the formula. The columns in per cent are differences of the film.

| N m | m/s | formula | local, other | local, here | film, fluid alone | from local, other | from local, here | with asperities | from formula | teeth, degC | |
|---|---|---|---|---|---|---|---|---|---|---|---|""" % C_PT)
largest = 0
for torque, local in LOCAL.items():
    for v, by_local in zip((0.5, 2, 8.6, 20), local):
        sets = ["duty.torque=%g N m" % torque, "duty.speed=%g rpm" % RPM[v]]
        fluid, both, here = run(C_PT, sets + FLUID), run(C_PT, sets), run(C_PT, sets + TEETH_ONLY)
        formula = mu(both, "friction_coefficient_formula")
        near = abs(mu(fluid) / by_local - 1) <= 0.1
        within = v <= 2 or -0.4 <= mu(both) / formula - 1 <= 0.25
        largest = max(largest, abs(mu(fluid) / mu(here) - 1))
        print("| %g | %g | %.4f | %.4f | %.4f | %.4f | %s | %s | %.4f | %s | %.1f | %s |" % (
            torque, v, formula, by_local, mu(here), mu(fluid), off(mu(fluid), by_local), off(mu(fluid), mu(here)), mu(both), off(mu(both), formula), mu(both, "bulk_temperature") - 273.15,
            "met" if near and within else "**missed**: %s" % ("formula" if near else "local, other" if within else "both")))
print("""
The coefficient of the film differs from that of the local model of this program by at most %.1f %%. The separate program has a thinner film at 20 m/s,
since its formula for inlet heating reduces the film by more than a full solution with heat does
([films with heat](heat.md#formulas-of-the-inlet-against-the-full-solution)).""" % (100 * largest))

EV = "configs/validation/ev-friction.yaml"
CHEAP = [["film={use: ehl/inlet-analysis}"], ["film={use: ehl/film-formula}"]]


def ev(heated, sets):
    """Coefficients of the film, of the inlet analysis and of Moes' formula."""
    film = run(EV, ["film.thermal=full" if heated else "film.thermal=none"] + sets)
    return [mu(film)] + [mu(run(EV, model + ["film.thermal=local" if heated else "film.thermal=none"] + sets)) for model in CHEAP]


print("""
## A fast stage with a thin oil

`%s`: 23/73 teeth, 110 N m, 14,000 rpm, a PAO of 5.2 mm2/s, oil and teeth at 97 degC. The table gives the mean friction coefficient without asperities: of the film, and of `thermal: local` with the same laws, Hertz'
pressure, and the film thickness of the inlet analysis or of Moes' formula.

| heat: film, local | film | inlet analysis | film differs by | Moes' formula | film differs by |
|---|---|---|---|---|---|""" % EV)
found = {}
for name, heated, sets in (("none", False, []), ("full, local", True, []),
                           ("the same, oil conducts better under pressure", True, ["oil.conductivity_pressure=[1.40 1/GPa, 0.34 1/GPa]"])):
    film, inlet, moes = found[name] = ev(heated, sets)
    print("| %s | %.5f | %.5f | %+.1f %% | %.5f | %+.1f %% |" % (name, film, inlet, 100 * (film / inlet - 1), moes, 100 * (film / moes - 1)))
film, inlet, moes = found["none"]
hot = found["full, local"]
print("""
The difference of %+.1f %% from Moes' formula has three parts. %+.1f %%: the film of the formula is thinner than that of the inlet analysis. %+.1f %%:
the film's pressure is not that of Hertz; under so light a load, part of it lies outside Hertz' width, where there is little friction. %+.1f %%: heat.
Twice the cells and 2.5 times the steps change the coefficient by %.2f %%.""" % (
    100 * (hot[0] / hot[2] - 1), 100 * (inlet / moes - 1), 100 * (film / inlet - 1), 100 * (hot[0] / hot[2] / (film / moes) - 1),
    100 * abs(mu(run(EV, ["film.cells=512", "film.steps=1000"])) / film - 1)))
formula = mu(run(EV, []), "friction_coefficient_formula")
print("The formula of ISO/TR 14179-2 has %.4f here, outside its range of speeds; the coefficient of the film with heat is %.0f %% lower." % (formula, 100 * (1 - hot[0] / formula)))
print("""
## A worked example of the formula

FZG C14 gears with the tip diameters of their drawing, a mineral oil of 13.28 mPa s, 200 N m, 1500 rpm, Ra 0.355 um, X_L 0.846; "printed" is the result of another program.

| | printed | here |
|---|---|---|""")
C14 = run(C_PT, ["film={use: ehl/film-formula}", "film.bulk=", "flanks=", "losses={use: losses/tooth-mesh, lubricant_factor: 0.846}", "gears.roughness_ra=0.355 um",
                 "gears.tip_diameter=[82.64 mm, 118.54 mm]", "duty.torque=200 N m", "duty.speed=1500 rpm",
                 "oil={use: lubricant/measured, eta0: 13.28 mPa s, at: 90 degC, density_15: 880 kg/m3, base: mineral}",
                 "outputs=[losses.friction_coefficient_formula, losses.loss_factor]"])
print("| coefficient | 0.0449 | %.4f |" % mu(C14, "friction_coefficient_formula"))
print("| loss factor H_v | 0.1986 | %.4f |" % mu(C14, "loss_factor"))
END
mv "$lab/page" docs/validation/friction.md
sh docs/made.sh docs/validation/friction.md plugins/ehl plugins/losses plugins/rheology plugins/viscosity
