#!/bin/sh
# Writes measured.md: what others measured or computed, beside what comes out here. The data and the runs stand in
# configs/validation.
#   sh docs/validation/measured.sh build
set -eu

build=$(realpath "${1:-build}")
here=$(cd "$(dirname "$0")" && pwd)
data=$here/../../configs/validation
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Rows of a table of numbers, without its comment and its head.
table()
{
    sed '/^#/d' "$data/$1.csv" | sed 1d | tr -d ' ' | tr ';' ' '
}

run()
{
    file=$1
    shift
    "$build/flankfilm" run "$data/$file.yaml" "$@" --json > "$work/run.json"
}

# The number of a scalar, or the largest of a series, of the last run.
value()
{
    grep -o "\"$1\":{\"unit\":[^}]*}" "$work/run.json" | head -n 1 |
        sed -n 's/.*"data":\[\([^]]*\)\].*/\1/p; s/.*"value":\([^,}]*\).*/\1/p' | tr ',' '\n' | sort -g | tail -n 1
}

# Is $1 within $2 to $3?
verdict()
{
    awk -v x="$1" -v low="$2" -v high="$3" 'BEGIN { print (x >= low && x <= high) ? "agrees" : "**differs**" }'
}

rolling()
{
    echo '| M | L | rolling loss, W/m | fit, W/m | ratio | within 15 % |'
    echo '|---|---|---|---|---|---|'
    table rolling-force | while read -r M L; do
        set -- $(awk -v M="$M" -v L="$L" 'BEGIN {
            E = 226.4e9; R = 0.01; U = 2 * 22.64e-3 / (E * R); m = 1.4 * sqrt(M)
            printf "%.8g %.8g %.6g\n", 1e-3 * M * E * R * sqrt(U), 1e9 * L / (E * U ^ 0.25),
                2 * E * R * U ^ 0.75 * m / (1 + (m / 1.45) ^ 10) ^ 0.1 }')
        run rolling-force --set discs.load_per_width="$1 N/mm" --set viscosity.alpha="$2 1/GPa"
        ratio=$(awk -v a="$(value film.rolling_loss)" -v b="$3" 'BEGIN { printf "%.4f", a / b }')
        printf '| %s | %s | %.2f | %.2f | %.3f | %s |\n' "$M" "$L" "$(value film.rolling_loss)" "$3" "$ratio" \
            "$(verdict "$ratio" 0.85 1.15)"
    done
}

# law | settings
cat > "$work/laws" <<'LIST'
Roelands, 5 MPa|
Roelands, 28 MPa|flow.tau0=28+MPa
Barus, 5 MPa|viscosity.use=viscosity/barus
Barus, 28 MPa|viscosity.use=viscosity/barus flow.tau0=28+MPa
LIST

# loss SPEED SETTINGS: kW, sliding and all; empty where there is none
loss()
{
    speed=$1
    shift
    set -- $* duty.speed="$speed+rpm"
    arguments=
    for setting; do arguments="$arguments --set $setting"; done
    eval "set -- $(echo "$arguments" | sed "s/--set \([^ ]*\)/--set '\1'/g; s/+/ /g")"
    run mesh-loss "$@" 2> /dev/null || true
    awk -v a="$(value losses.sliding_loss_mean)" -v b="$(value losses.power_loss_mean)" \
        'BEGIN { if (a != "") printf "%.4f %.4f\n", a / 1000, b / 1000 }'
}

losses()
{
    echo '| laws | rpm | sliding, kW | total loss, kW | measured, kW | |'
    echo '|---|---|---|---|---|---|'
    while IFS='|' read -r name settings; do
        table mesh-loss | while read -r speed low high; do
            set -- $(loss "$speed" "$settings")
            [ $# = 2 ] || { echo "| $name | $speed | no film was found | | $low to $high | |" && continue; }
            echo "$name|$speed|$2" >> "$work/losses"
            echo "| $name | $speed | $1 | $2 | $low to $high | $(verdict "$2" "$low" "$high") |"
        done
    done < "$work/laws"
}

slopes()
{
    echo '| laws | slope from 8000 to 10,000 rpm, kW per 1000 rpm | measured |'
    echo '|---|---|---|'
    awk -F '|' '$2 == 8000 { before[$1] = $3 }
        $2 == 10000 && $1 in before { printf "| %s | %+.3f | -0.08 to +0.02 |\n", $1, ($3 - before[$1]) / 2 }' "$work/losses"
}

spread()
{
    echo '| laws, 6000 rpm | total loss, kW | eta0 -10 % | eta0 +10 % | alpha -10 % | alpha +10 % |'
    echo '|---|---|---|---|---|---|'
    while IFS='|' read -r name settings; do
        row="| $name"
        for change in "" oil.eta0=9.54+mPa+s oil.eta0=11.66+mPa+s oil.alpha=8.71+1/GPa oil.alpha=10.65+1/GPa; do
            set -- $(loss 6000 "$settings $change")
            row="$row | ${2:-no film}"
        done
        echo "$row |"
    done < "$work/laws"
}

fzg()
{
    run fzg-pressure
    pressure=$(value tooth.hertz_pressure)
    published=$(table fzg-pressure)
    awk -v a="$pressure" -v b="$published" 'BEGIN {
        printf "| highest Hertzian pressure, MPa | published | |\n|---|---|---|\n"
        printf "| %.0f | %s | %+.1f %% |\n", a / 1e6, b, 100 * (a / 1e6 / b - 1) }'
}

{
    cat <<'TEXT'
# What others measured and computed

Every number of this page comes from

```sh
sh docs/validation/measured.sh build
```

which writes the page. Each set of data has a CSV file in `configs/validation` with the published numbers and how they were
derived, and a YAML file with the run that is compared with them, so that you can repeat it without the paper. The films of this page are
isothermal.

## Rolling force

`rolling-force.yaml`: Biboulet & Houpert 2010, a formula fitted to multigrid solutions of flooded line contacts in pure
rolling. M and L are Moes' numbers; `ratio` is the computed rolling loss over that of the fit.

TEXT
    rolling
    cat <<'TEXT'

The paper claims 15 % for M from 2 on. The computed loss includes the part of the inlet in front of the domain ([theory,
7.11](../theory.md#7-film)); whether the fit includes this part is not known. At small L the difference slightly exceeds 15
%.

## Loss of a spur gear mesh

`mesh-loss.yaml`: Petry-Johnson, Kahraman, Anderson & Chase 2007/2008, 413 N m. The measured values are intervals, since the
paper gives rounded percentages. The intervals assume the loss of one mesh; if the loss is that of the two meshes of a
back-to-back rig, each has half. Gears,
oil, laws and the rule for the temperature were written down before the first run; every run is shown. "Laws" are eta(p)
and the Eyring stress.

TEXT
    losses
    cat <<'TEXT'

TEXT
    slopes
    cat <<'TEXT'

Measured losses level off from 8000 rpm on; those of isothermal films do not. The effect of the oil's constants on the loss in kW, one at a time:

TEXT
    spread
    cat <<'TEXT'

The law of eta(p) and the Eyring stress change the loss far more than the constants of the oil within 10 %. No law agrees
with these data. To decide, one would need the traction of this oil over slip and pressure, its
viscosity over temperature, the temperature of the teeth, and whether one mesh or two were measured.

## Pressure of FZG C-mod gears

`fzg-pressure.yaml`: load stage 7.

TEXT
    fzg
    cat <<'TEXT'

The run omits the tip relief of 35 um, whose shape and start are not published. The published loss factor, 0.1680, depends on
the relief and is not compared.

## What is not on this page

- The mesh loss with laws of measured oils: [friction and loss against measurement](friction.md).
- The mesh loss with heat in the film, and formulas for inlet heating compared with a film with heat: [films with heat](heat.md).
- Traction of squalane, and losses of FZG gears: the curves are available only as figures.
- ISO/TR 6336-30, example 1: its gears are helical; this program is for
  spur gears. The formula of c' for spur gears is in [benchmarks](benchmarks.md).
TEXT
} > "$work/measured.md"
mv "$work/measured.md" "$here/measured.md"
sh "$here/../made.sh" "$here/measured.md" plugins/ehl plugins/losses plugins/rating
