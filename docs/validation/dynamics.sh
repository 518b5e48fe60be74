#!/bin/sh
# Draws dynamics.svg, the forced response by two sources of mesh stiffness, and puts its tables into
# dynamics.md.
#   sh docs/validation/dynamics.sh build
set -eu

program=$(realpath "${1:-build}")/flankfilm
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# source | title | what is set
cat > "$work/variants" <<'LIST'
energy|potential energy|mesh.use=stiffness/potential-energy
load|load distribution with corner contact|mesh.use=stiffness/load-distribution mesh.corner_contact=true
LIST

# rms over frequency as polylines: colour by period, dashes where unstable
draw()
{
    awk -F, -v top="$2" '
        function flush() {
            if (line != "")
                printf "<polyline points=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"%s\"%s/>\n",
                       line, period == 1 ? "#0072b2" : "#d55e00", stable ? 2 : 1,
                       stable ? "" : " stroke-dasharray=\"4 3\""
            line = ""
        }
        NR > 1 {
            x = sprintf("%.1f", 70 + 0.19 * ($1 - 400))
            y = sprintf("%.1f", top + 300 - 7.5 * $2 * 1e6)
            if ($4 != branch || $2 > 40e-6) { flush(); last = "" }
            else if ($3 != stable) { flush(); line = last }
            branch = $4; stable = $3; period = int($4 / 1000)
            if ($2 <= 40e-6) { last = x "," y " "; line = line last }
        }
        END { flush() }' "$1"
}

axes()
{
    awk -v top="$1" -v title="$2" 'BEGIN {
        for (f = 500; f <= 4500; f += 500)
            printf "<path d=\"M%d %dv-300\" stroke=\"#ddd\"/><text x=\"%d\" y=\"%d\" " \
                   "text-anchor=\"middle\">%d</text>\n",
                   70 + 0.19 * (f - 400), top + 300, 70 + 0.19 * (f - 400), top + 317, f
        for (s = 0; s <= 40; s += 10)
            printf "<path d=\"M70 %dh779\" stroke=\"#ddd\"/><text x=\"62\" y=\"%d\" " \
                   "text-anchor=\"end\">%d</text>\n", top + 300 - 7.5 * s, top + 304 - 7.5 * s, s
        split("1250 2085 2375", at, " "); split("I II III", name, " ")
        for (i = 1; i <= 3; i++)
            printf "<path d=\"M%.1f %dv300\" stroke=\"#999\" stroke-dasharray=\"1 3\"/>" \
                   "<text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\" fill=\"#666\">%s</text>\n",
                   70 + 0.19 * (at[i] - 400), top, 70 + 0.19 * (at[i] - 400), top - 4, name[i]
        printf "<text x=\"842\" y=\"%d\" text-anchor=\"end\">%s</text>\n", top - 8, title
    }'
}

number()
{
    grep "^$1," "$2" | cut -d, -f2
}

: > "$work/lines"
top=30
{
while IFS='|' read -r source title settings; do
    set --
    for setting in $settings; do set -- "$@" --set "$setting"; done
    echo "| $title | period | rms um | DMF/F | W_d/W_s | time apart |"
    echo "|---|---|---|---|---|---|"
    "$program" run "$here/dynamics.yaml" "$@" -o "$work/$source-atlas" > /dev/null
    for point in "1250 lower" "2085 lower" "2375 lower" "2375 upper"; do
        "$program" run "$here/dynamics.yaml" "$@" --set duty.mesh_frequency="${point% *} Hz" \
            --set motion.branch="${point#* }" --set motion.max_period=1 \
            --set motion.search_starts=0 -o "$work/$source" > /dev/null
        scalars=$work/$source/motion-scalars.csv
        awk -v point="$point" -v rms="$(number dte_rms "$scalars")" \
            -v period="$(number period "$scalars")" \
            -v mesh="$(number dynamic_factor_mesh "$scalars")" \
            -v tooth="$(number dynamic_factor_tooth "$scalars")" \
            -v apart="$(number contact_loss "$scalars")" 'BEGIN {
                printf "| %s | %d | %.3f | %.3f | %.3f | %.3f |\n", point, period, 1e6 * rms, mesh,
                       tooth, apart }'
    done
    echo
    echo "| $title | Hz |"
    echo "|---|---|"
    awk -F, 'NR > 1 && $2 < 2000 && $1 > 800 { list = list sprintf(", %.1f", $1) }
        END { print "| folds of motions of period 1 above 800 Hz | " substr(list, 3) " |" }' \
        "$work/$source-atlas/motion-fold.csv"
    awk -F, 'NR > 1 && $2 < 2000 && $1 > 800 { list = list sprintf(", %.1f", $1) }
        END { print "| their doublings | " substr(list, 3) " |" }' "$work/$source-atlas/motion-doubling.csv"
    echo
    axes "$top" "$title" >> "$work/lines"
    draw "$work/$source-atlas/motion-point.csv" "$top" >> "$work/lines"
    top=$((top + 350))
done < "$work/variants"
} > "$work/tables"
awk -f "$here/splice.awk" "$work/tables" "$here/dynamics.md" > "$work/page"
mv "$work/page" "$here/dynamics.md"

{
    echo '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 870 740" font-family="sans-serif"' \
         'font-size="13">'
    echo '<rect width="870" height="740" fill="white"/>'
    cat "$work/lines"
    echo '<text x="460" y="722" text-anchor="middle">mesh frequency, Hz</text>'
    echo '<text transform="translate(24 360) rotate(-90)" text-anchor="middle">rms of s, um</text>'
    echo '<path d="M600 718h30" stroke="#0072b2" stroke-width="2"/><text x="636" y="722">period 1' \
         '</text>'
    echo '<path d="M700 718h30" stroke="#d55e00" stroke-width="2"/><text x="736" y="722">period 2' \
         '</text>'
    echo '</svg>'
} > "$here/dynamics.svg"
