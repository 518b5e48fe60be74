#!/bin/sh
# Draws dynamics.svg, the forced response by two sources of mesh stiffness, and puts its tables into
# dynamics.md.
#   sh docs/validation/dynamics.sh build
set -eu

build=$(realpath "${1:-build}")
program=$build/flankfilm
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# source | title | what is set
cat > "$work/variants" <<'LIST'
energy|potential energy|mesh.use=stiffness/potential-energy
load|load distribution with corner contact|mesh.use=stiffness/load-distribution mesh.definition=secant mesh.corner_contact=true
LIST

# rms over frequency in the words of plot.awk: colour by period, dashes where unstable
draw()
{
    awk -F, '
        function style() {
            return (int($4 / 1000) == 1 ? "#0072b2" : "#d55e00") ($3 + 0 ? " none 2 y" : " 4,3 1 y")
        }
        NR > 1 {
            if ($2 > 40e-6) { last = ""; next }
            if ($4 != branch) last = ""
            if (last == "" || $3 != stable) { print "curve " style(); if (last != "") print last }
            branch = $4; stable = $3
            last = $1 " " $2 * 1e6
            print last
        }' "$1"
}

axes()
{
    cat <<END
panel 70 $1 780 300
x 400 4500 500 $3
y 0 40 10 rms of s, um
title $2
mark 1250 I
mark 2085 II
mark 2375 III
END
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
    python3 "$here/tables.py" "$work/$source-atlas"
    for point in "1250 lower" "2085 lower" "2375 lower" "2375 upper"; do
        "$program" run "$here/dynamics.yaml" "$@" --set duty.mesh_frequency="${point% *} Hz" \
            --set motion.branch="${point#* }" --set motion.max_period=1 \
            --set motion.search_starts=0 -o "$work/$source" > /dev/null
        python3 "$here/tables.py" "$work/$source"
        scalars=$work/$source/motion-scalars.csv
        cp "$scalars" "$work/$source-$(echo "$point" | tr ' ' -).csv"
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
        END { print "| their period doublings | " substr(list, 3) " |" }' "$work/$source-atlas/motion-doubling.csv"
    echo
    "$program" run "$here/dynamics.yaml" "$@" --set 'outputs=[mesh.stiffness_mean, mesh.stiffness_harmonics]' -o "$work/$source-mesh" > /dev/null
    python3 "$here/tables.py" "$work/$source-mesh"
    axes "$top" "$title; blue: period 1, orange: period 2" "mesh frequency, Hz" >> "$work/lines"
    draw "$work/$source-atlas/motion-point.csv" >> "$work/lines"
    top=$((top + 390))
done < "$work/variants"

# what the figure is compared with
awk -v in_="$work" -F, '
    function get(source, point, name,  path, line, cell, x) {
        path = in_ "/" source "-" point ".csv"
        while ((getline line < path) > 0) { split(line, cell, ","); if (cell[1] == name) x = cell[2] }
        close(path)
        return x + 0
    }
    # upper fold of the primary resonance, its lower branch''s last two doublings, and the fold that ends the
    # branch which comes down from the highest speed
    function read(source,  path, line, c, top) {
        path = in_ "/" source "-atlas/motion-point.csv"
        getline line < path
        while ((getline line < path) > 0) {
            split(line, c, ",")
            if (int(c[4] / 1000) == 1 && c[1] > top) { top = c[1]; branch = c[4] }
            if (int(c[4] / 1000) == 2 && c[3] == 1 && c[1] > 3242 && (!(source in two) || c[1] < two[source])) two[source] = c[1]
        }
        close(path)
        path = in_ "/" source "-atlas/motion-fold.csv"
        getline line < path
        while ((getline line < path) > 0) {
            split(line, c, ",")
            if (c[2] == branch) low[source] = c[1]
            if (int(c[2] / 1000) == 1 && c[1] > upper[source]) { upper[source] = c[1]; linear = c[2] }
        }
        close(path)
        path = in_ "/" source "-atlas/motion-doubling.csv"
        getline line < path
        while ((getline line < path) > 0) {
            split(line, c, ",")
            if (c[2] == linear) { from[source] = to[source]; to[source] = c[1] }
        }
        close(path)
        path = in_ "/" source "-mesh/mesh-harmonic.csv"
        getline line < path; getline line < path; first[source] = line + 0
        close(path)
        path = in_ "/" source "-mesh/mesh-scalars.csv"
        while ((getline line < path) > 0) { split(line, c, ","); if (c[1] == "stiffness_mean") first[source] /= c[2] }
        close(path)
    }
    function both(format, point, name, scale) {
        return sprintf(format " and " format, scale * get("energy", point, name), scale * get("load", point, name))
    }
    function yes(x) { return x ? "yes" : "no" }
    BEGIN {
        read("energy"); read("load")
        still = both("%.2f", "2375-upper", "dynamic_factor_tooth", 1)
        print "| the paper says | result |"
        print "|---|---|"
        printf "| harmonics of k (digits lost) | first harmonic over the mean: %.2f and %.2f |\n", first["energy"], first["load"]
        printf "| near the primary resonance two stable motions, linear without separation, non-linear with it; softening | between %.0f and %.0f Hz, and %.0f and %.0f Hz |\n", low["energy"], upper["energy"], low["load"], upper["load"]
        printf "| points I and II linear | %s: apart for %s of the time at I, %s at II |\n", \
            yes(get("energy", "1250-lower", "contact_loss") + get("energy", "2085-lower", "contact_loss") + get("load", "1250-lower", "contact_loss") + get("load", "2085-lower", "contact_loss") == 0), \
            both("%g", "1250-lower", "contact_loss", 1), both("%g", "2085-lower", "contact_loss", 1)
        printf "| III on the upper branch: separation | apart for %s of the time |\n", both("%.2f", "2375-upper", "contact_loss", 1)
        printf "| III: W_d more than twice the largest W_s | %s times |\n", still
        printf "| | III, upper: rms %s um: in flight the spring does not act, so k(t) has little effect |\n", both("%.1f", "2375-upper", "dte_rms", 1e6)
        printf "| | III, lower: rms %s um, in proportion to the harmonics of k(t): not to be compared before these are known |\n", both("%.1f", "2375-lower", "dte_rms", 1e6)
        printf "| two motions | more in places: from %.0f to %.0f Hz, and %.0f to %.0f Hz, the linear motion is unstable and doubles its period; above f_n stable motions of period 2 exist from %.0f and %.0f Hz up |\n", \
            from["energy"], to["energy"], from["load"], to["load"], two["energy"], two["load"]
        print ""
    }'

# what the tests and the benchmark measure
export FLANKFILM_TEST_PLUGINS="$build/plugins"
export FLANKFILM_TEST_SOURCE="$here/../.."
for test in pinned flow twin extremes atlas; do
    "$build/tests/plugins/dynamics/test-dynamics-shooting-$test" > "$work/test-$test"
done
worst() { # TITLE CHECKS TEST...; the worst of the checks that are so called
    title=$1 checks=$2
    shift 2
    for test do cat "$work/test-$test"; done | awk -v title="$title" -v checks="$checks" '
        $0 !~ "^ok   (" checks "): " { next }
        /off by/ { sub(/.*off by /, ""); off = $1; held = $3 }
        !/ of / { sub(/.*: /, ""); off = $1; held = $3 }
        { n++; if (off + 0 > most) most = off + 0; if (held + 0 > limit) limit = held + 0 }
        END { if (!n) exit 1; printf "| %s | %g | %.1e | %d |\n", title, limit, most, n }'
}
echo "| compared quantity | limit | largest difference | number of values |"
echo "|---|---|---|---|"
worst "states by another program (trapezoidal k), lengths over half the backlash b" "[0-9]+ Hz (lower|upper) (x.0.|v.0.|rms|max|min)" pinned
awk '
    /^ok   fold_frequency/ { own[++n] = $3 + 0 }
    /^ok   fold at/ { theirs[++m] = $4 }
    END {
        for (i = 1; i <= m; i++) {
            least = 1e9
            for (k = 1; k <= n; k++) { d = own[k] - theirs[i]; if (d < 0) d = -d; if (d < least) least = d }
            if (least > most) most = least
        }
        printf "| folds by that program, which rounds them, Hz | 1 | %.2f | %d |\n", most, m
    }' "$work/test-pinned"
worst "folds and doublings with continuation steps of different length (factor 4), relative" "fold_frequency|doubling_frequency" pinned
worst "determinant of the monodromy matrix and exp(-2 zeta omega_n T)" "det|det M|det by steps|determinant" pinned flow twin extremes atlas
worst "the same at 3 to 40 Hz, thousands of radians in a mesh cycle" "determinant, slow mesh" extremes
worst "energy balance" "energy balance" pinned twin extremes atlas
worst "Mathieu characteristic values a1, b1, a2, b2" "Mathieu.s characteristic value" flow
worst "return map without separation and its closed form" "fixed point|monodromy" flow
worst "free vibration with backlash and its closed form (front flank, flight, back flank), also backwards in time" "free vibration returns|returns" flow
worst "dte of \`dynamics/time-integration\` at 1e-10, same branch, three kinds of damper, over b" "dte" twin
worst "derivatives with respect to state, speed and period, and finite differences" "after [xvT]" flow
echo
echo "| atlas from 400 to 4500 Hz with stability | points | CPU, s |"
echo "|---|---|---|"
"$build/tests/bench/bench-dynamics" | sed -n 's/^\(.*[^ ]\)  *\([0-9.]*\) s  *\([0-9]*\) points.*/| \1 | \3 | \2 |/p'
echo
echo "| trapezoid | Hz |"
echo "|---|---|"
for event in fold doubling; do
    awk -v event=$event '$2 == event "_frequency:" { list = list sprintf(", %.3f", $3) }
        END { print "| " event "s | " substr(list, 3) " |" }' "$work/test-pinned"
done
} > "$work/tables"
awk -f "$here/splice.awk" "$work/tables" "$here/dynamics.md" > "$work/page"
mv "$work/page" "$here/dynamics.md"
sh "$here/../made.sh" "$here/dynamics.md" plugins/dynamics

awk -f "$here/plot.awk" "$work/lines" > "$work/figure.json"
sh "$here/../draw.sh" "$program" "$work/figure.json" "$here/dynamics.svg"
