#!/bin/sh
# Draws stiffness.svg, k over the mesh cycle by every source, and puts its table into stiffness.md.
#   sh docs/validation/stiffness.sh build
set -eu

build=$(realpath "${1:-build}")
program=$build/flankfilm
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# name | colour | dashes | what is set
cat > "$work/variants" <<'LIST'
load distribution, finite elements|#0072b2||mesh.use=stiffness/load-distribution
the same with corner contact|#56b4e9||mesh.corner_contact=true
the same in plane stress|#009e73|6,3|mesh.plane=stress
the same, neighbours uncoupled|#0072b2|2,3|mesh.neighbour_coupling=false
load distribution, analytical|#e69f00||mesh.compliance=analytical
potential energy|#d55e00||mesh.use=stiffness/potential-energy
ISO 6336, rectangular|#666666||mesh.use=stiffness/iso-6336
ISO 6336, trapezoidal|#666666|6,3|mesh.use=stiffness/iso-6336 mesh.shape=trapezoidal
LIST

number()
{
    grep -o "\"$1\":{\"unit\":\"[^\"]*\",\"value\":[0-9.e+-]*" "$2" | sed 's/.*://'
}

{
    echo "| source | mean 1e8 N/m | k1 | k2 | k3 | W_s/F at SAP | loaded contact ratio |"
    echo "|---|---|---|---|---|---|---|"
row=0
while IFS='|' read -r name colour dashes settings; do
    row=$((row + 1))
    set --
    for setting in $settings; do set -- "$@" --set "$setting"; done
    "$program" run "$here/stiffness.yaml" "$@" -o "$work/$row" > /dev/null
    python3 "$here/tables.py" "$work/$row"
    "$program" run "$here/stiffness.yaml" "$@" --json > "$work/$row.json"
    mean=$(number mesh.stiffness_mean "$work/$row.json")
    ratio=$(number mesh.loaded_contact_ratio "$work/$row.json")
    share=$(sed -n 2p "$work/$row/mesh-station.csv")
    awk -F, -v name="$name" -v mean="$mean" -v share="$share" -v ratio="$ratio" '
        NR > 1 && NR < 5 { k = k sprintf(" %.3f |", $1 / 1e8) }
        END { printf "| %s | %.3f |%s %.3f | %.3f |\n", name, mean / 1e8, k, share, ratio }' "$work/$row/mesh-harmonic.csv"
    echo "curve $colour ${dashes:-none} 1.8 y $name" >> "$work/lines"
    awk -F, 'NR > 1 { print $1, $2 / 1e8 }' "$work/$row/mesh.csv" >> "$work/lines"
done < "$work/variants"

# what the mean and the loaded contact ratio depend on
value() { # OUTPUT SETTING...
    output=$1
    shift
    for setting do
        set -- "$@" --set "$setting"
        shift
    done
    "$program" run "$here/stiffness.yaml" --json "$@" > "$work/value.json"
    number "$output" "$work/value.json"
}
mean() {
    value mesh.stiffness_mean "$@" | awk '{ printf " %.3f |", $1 / 1e8 }'
}

# mean, first harmonic, mean of k with one pair and with two: those of the first setting over those of the
# second, less one; settings are parted by blanks
levels() { # SETTINGS
    set -- $1
    for setting do
        set -- "$@" --set "$setting"
        shift
    done
    "$program" run "$here/stiffness.yaml" -o "$work/levels" "$@" > /dev/null
    python3 "$here/tables.py" "$work/levels"
    awk -F, '
        FILENAME ~ /harmonic/ { if (FNR == 2) first = $1; next }
        FNR == 1 { next }
        $1 < 0.754 { two += $2; twos++ }
        $1 > 0.756 { one += $2; ones++ }
        { if (FNR > 2) mean += (k + $2) / 2 * ($1 - phase); phase = $1; k = $2 }
        END { print mean, first, one / ones, two / twos }' "$work/levels/mesh-harmonic.csv" "$work/levels/mesh.csv"
}
effect() { # TITLE SETTINGS SETTINGS
    { levels "$2"; levels "$3"; } | awk -v title="$1" '
        NR == 1 { for (i = 1; i <= 4; i++) new[i] = $i; next }
        { printf "| %s |", title; for (i = 1; i <= 4; i++) printf " %+.1f %% |", 100 * (new[i] / $i - 1); print "" }'
}
finite=mesh.use=stiffness/load-distribution
energy=mesh.use=stiffness/potential-energy
iso=mesh.use=stiffness/iso-6336
echo
echo "| new assumption; before: old assumption | mean | first harmonic | one pair | two pairs |"
echo "|---|---|---|---|---|"
effect "neighbouring teeth on one body; before: independent parallel springs" "$finite" "$finite mesh.neighbour_coupling=false"
effect "potential energy; before: finite elements" "$energy" "$finite"
effect "finite elements with the fillet that a rack cuts, neighbours uncoupled, plane stress; before: potential energy" "$finite mesh.plane=stress mesh.neighbour_coupling=false" "$energy"
effect "tip radius of the rack 0.1 module; before: 0.38" "$finite gears.tool_tip_radius=0.1" "$finite"
effect "plane stress; before: plane strain" "$finite mesh.plane=stress" "$finite"
effect "corner contact; before: none" "$finite mesh.corner_contact=true" "$finite"
effect "ISO 6336 with its own dedendum of 1.2 modules; before: 1.55" "$iso gears.root_diameter=[142.8mm,142.8mm]" "$iso"
echo
echo "| 200 mesh positions by | 1e6 instructions, including the start of the program |"
echo "|---|---|"
for source in "finite elements|$finite" "the analytical compliance|$finite mesh.compliance=analytical" "potential energy|$energy" "ISO 6336|$iso"; do
    set --
    for setting in ${source#*|}; do set -- "$@" --set "$setting"; done
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" run "$here/stiffness.yaml" "$@" --json 2>&1 >/dev/null |
        awk -v name="${source%%|*}" '/Collected/ { printf "| %s | %.0f |\n", name, $NF / 1e6 }'
done
echo
echo "| W_s/F at SAP | before LPSTC | at the pitch point | largest difference from the mirror image, with ten digits |"
echo "|---|---|---|---|"
"$program" run "$here/stiffness.yaml" --set $finite --set 'outputs=[mesh.load_share, gears.roll_angle]' -o "$work/shares" > /dev/null
python3 "$here/tables.py" "$work/shares"
awk -F, 'FNR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /load_share/) c = i; next }
    { s[++n] = $c }
    END {
        for (i = 1; i <= n; i++) { d = s[i] - s[n + 1 - i]; if (d < 0) d = -d; if (d > worst) worst = d }
        for (i = 2; i <= n && s[i] < 1.2 * s[i - 1]; i++);
        printf "| %.3f | %.3f | %.3f | %g |\n", s[1], s[i - 1], s[int((n + 1) / 2)], worst
    }' "$work/shares/mesh-station.csv"
echo
echo "| mean 1e8 N/m at a bore of | 50 mm | 60 mm | 70 mm | 85 mm | 100 mm |"
echo "|---|---|---|---|---|---|"
for root in 140.68 142.50; do
    for plane in strain stress; do
        printf "| root diameter %s mm, plane %s |" $root $plane
        for bore in 50 60 70 85 100; do
            mean "mesh.plane=$plane" "gears.root_diameter=[$root mm, $root mm]" "gears.bore_diameter=[$bore mm, $bore mm]"
        done
        echo
    done
done
echo
echo "| torque, N m | 10 | 25 | 50 | 100 | 250 | 500 |"
echo "|---|---|---|---|---|---|---|"
printf "| mean 1e8 N/m |"
for torque in 10 25 50 100 250 500; do mean "duty.torque=$torque N m"; done
echo
printf "| loaded contact ratio with corner contact |"
for torque in 10 25 50 100 250 500; do
    value mesh.loaded_contact_ratio "duty.torque=$torque N m" mesh.corner_contact=true | awk '{ printf " %.3f |", $1 }'
done
echo
echo
echo "| elements per sector | 225 | 450 | 900 | 1800 | 3600 | 7200 |"
echo "|---|---|---|---|---|---|---|"
printf "| mean 1e8 N/m |"
for elements in 225 450 900 1800 3600 7200; do
    value mesh.stiffness_mean "mesh.elements_per_tooth=$elements" | awk '{ printf " %.4f |", $1 / 1e8 }'
done
echo
echo
"$build/tests/plugins/stiffness/test-ring" | awk '
    /^pressure/ {
        if (!($2 in seen)) { seen[$2] = 1; order[++n] = $2 }
        if (/nearer by/) nearer[$2] = $(NF - 1); else own[$2] = $(NF - 1)
    }
    END { # by width
        for (i = 2; i <= n; i++)
            for (k = i; k > 1 && order[k] < order[k - 1]; k--) { t = order[k]; order[k] = order[k - 1]; order[k - 1] = t }
        head = "| half width of the pressure over the depth of the axis |"; rule = "|---|"
        for (i = 1; i <= n; i++) {
            w = order[i]; head = head " " w " |"; rule = rule "---|"
            first = first " " nearer[w] " % |"; second = second " " (w in own ? own[w] " %" : "0") " |"
        }
        print head; print rule
        print "| approach of flank and axis beyond that of the formula |" first
        print "| compliance of the tooth compared with width 0.3 |" second
    }'
echo
echo "| torque, N m | 10 | 50 | 250 | 500 |"
echo "|---|---|---|---|---|"
printf "| share of the constant in a pair's deflection |"
for torque in 10 50 250 500; do
    "$program" run "$here/stiffness.yaml" --json --set "duty.torque=$torque N m" |
        grep -o '"half_plane":{"value":[0-9.e-]*' | sed 's/.*://' | awk '{ printf " %.1f %% |", 100 * $1 }'
done
echo
} > "$work/table"
awk -f "$here/splice.awk" "$work/table" "$here/stiffness.md" > "$work/page"
mv "$work/page" "$here/stiffness.md"
sh "$here/../made.sh" "$here/stiffness.md" plugins/stiffness

{
    echo 'panel 70 110 760 400'
    echo 'x 0 1 0.2 phase of the mesh cycle'
    echo 'y 1.5 4.5 0.5 mesh stiffness, 1e8 N/m'
    cat "$work/lines"
} | awk -f "$here/plot.awk" > "$work/figure.json"
sh "$here/../draw.sh" "$program" "$work/figure.json" "$here/stiffness.svg"
