#!/bin/sh
# Plugins compiled against the headers of interface 1.0 keep today's rules and run in today's program;
# docs/abi.md has a section for today's version and names every public header.
# run.sh FLANKFILM SOURCE_ROOT
set -eu
flankfilm=$(realpath "$1") source=$2
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT

mkdir "$lab/viscosity" "$lab/lab"
build() {
    ${CC:-cc} -std=c11 -O2 -Wall -Wextra -Werror -fPIC -shared -fvisibility=hidden \
        -I "$source/tests/abi/1.0" "$source/tests/abi/$1.c" -o "$lab/$2/of-1-0.so" -lm
}
build law viscosity
build stage lab
cat >"$lab/case.yaml" <<'END'
format: 2
pipeline:
  viscosity: {use: viscosity/of-1-0, eta0: 10 mPa s, alpha: 20 1/GPa}
  discs: {use: contact/constant, radius: 12 mm, entrainment_speed: 4 m/s, slide_roll_ratio: 0, load_per_width: 100 N/mm}
  eta: {use: lab/of-1-0, contact: discs}
outputs: [eta.*, discs.hertz_pressure]
END
for file in viscosity lab; do
    FLANKFILM_PLUGIN_PATH=$lab "$flankfilm" verify "$lab/$file/of-1-0.so" --pipeline "$lab/case.yaml"
done
"$flankfilm" run "$lab/case.yaml" --plugin-path "$lab" --json >"$lab/result"
grep -q '"status": *"ok"' "$lab/result"
# ln eta = ln eta0 + alpha p_H
tr -d ' ' <"$lab/result" | awk 'BEGIN { RS = "," } { print }' | awk -F: '
    /eta.highest/ { highest = 1 }
    /discs.hertz_pressure/ { pressure = 1 }
    /"value"/ && highest { eta = $NF + 0; highest = 0 }
    /"data"/ && pressure { sub(/.*\[/, "", $NF); p = $NF + 0; pressure = 0 }
    END { d = eta - (log(0.01) + 20e-9 * p); print eta, p, d; exit !(d < 1e-9 && d > -1e-9) }'

# beside an oil that it contradicts: an error that shows both, of `run` and of `check`
cat >"$lab/oil.yaml" <<'END'
format: 2
pipeline:
  oil: {use: lubricant/grade, grade: ISO VG 220, base: mineral, temperature: 80 degC}
  viscosity: {use: viscosity/of-1-0, eta0: 10 mPa s, alpha: 20 1/GPa}
  density: {use: density/dowson-higginson}
  discs: {use: contact/constant, radius: 12 mm, entrainment_speed: 4 m/s, load_per_width: 100 N/mm}
  film: {use: ehl/film-formula}
outputs: [film.h_central]
END
for command in run check; do
    ! (cd "$lab" && "$flankfilm" $command oil.yaml --plugin-path "$lab") >"$lab/said" 2>&1
    grep -q 'at 80 degC eta0 is 0.01 Pa s by the law and 0.0298[0-9] Pa s by the oil' "$lab/said" ||
        { cat "$lab/said"; exit 1; }
done
"$flankfilm" check "$lab/oil.yaml" --plugin-path "$lab" --set "viscosity.eta0=29.9 mPa s" >"$lab/said" 2>&1 ||
    { cat "$lab/said"; exit 1; }

minor=$(sed -n 's/^#define FF_ABI_MINOR //p' "$source/include/flankfilm/plugin.h")
grep -q "^## 1\.$minor\$" "$source/docs/abi.md" || { echo "docs/abi.md has no section 1.$minor"; exit 1; }
for header in "$source"/include/flankfilm/*.h; do
    header=$(basename "$header")
    grep -q "\`$header\`" "$source/docs/abi.md" || { echo "docs/abi.md does not name $header"; exit 1; }
done
