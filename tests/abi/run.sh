#!/bin/sh
# Plugins compiled against the headers of interfaces 1.0, 1.2 and 1.3, now and when these were frozen (kept/, for
# x86-64), keep today's rules and run in today's program; one that needs a newer interface is refused in one sentence;
# docs/abi.md has a section for today's version and names every public header.
# run.sh FLANKFILM SOURCE_ROOT
set -eu
flankfilm=$(realpath "$1") source=$2
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT

mkdir "$lab/viscosity" "$lab/lab"
build() { # FILE FOLDER NAME INCLUDE [OPTION]
    file=$1 folder=$2 name=$3 include=$4
    shift 4
    ${CC:-cc} -std=c11 -O2 -Wall -Wextra -Werror -fPIC -shared -fvisibility=hidden -I "$include" "$@" \
        -DFROZEN_NAME="\"$name\"" "$source/tests/abi/$file.c" -o "$lab/$folder/$name.so" -lm
}
plugins="0 2 3 kept-0 kept-2 kept-3"
[ "$(uname -m)" = x86_64 ] || plugins="0 2 3"
for plugin in $plugins; do
    minor=${plugin#kept-}
    name=of-1-$minor
    if [ "$plugin" = "$minor" ]; then
        build law viscosity $name "$source/tests/abi/1.$minor" -DFROZEN_MINOR=$minor
        build stage lab $name "$source/tests/abi/1.$minor" -DFROZEN_MINOR=$minor
    else
        cp "$source/tests/abi/kept/law-1.$minor.so" "$lab/viscosity/$name.so"
        cp "$source/tests/abi/kept/stage-1.$minor.so" "$lab/lab/$name.so"
    fi
    cat >"$lab/case.yaml" <<END
format: 2
pipeline:
  viscosity: {use: viscosity/$name, eta0: 10 mPa s, alpha: 20 1/GPa}
  discs: {use: contact/constant, radius: 12 mm, entrainment_speed: 4 m/s, slide_roll_ratio: 0, load_per_width: 100 N/mm}
  eta: {use: lab/$name, contact: discs}
outputs: [eta.*, discs.hertz_pressure]
END
    for folder in viscosity lab; do
        FLANKFILM_PLUGIN_PATH=$lab "$flankfilm" verify "$lab/$folder/$name.so" --pipeline "$lab/case.yaml"
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
done

# what a program of 1.2 says of a plugin of 1.3, this one says of the version after its own
minor=$(sed -n 's/^#define FF_ABI_MINOR //p' "$source/include/flankfilm/plugin.h")
mkdir -p "$lab/newer"
cp -r "$source/include/flankfilm" "$lab/newer/"
sed -i "s/^#define FF_ABI_MINOR .*/#define FF_ABI_MINOR $((minor + 1))/" "$lab/newer/flankfilm/plugin.h"
build law viscosity of-later "$lab/newer" -DFROZEN_MINOR=$((minor + 1))
! "$flankfilm" run "$lab/case.yaml" --plugin-path "$lab" --set viscosity.use=viscosity/of-later \
    >"$lab/said" 2>&1
grep -q "needs version 1.$((minor + 1)) of the plugin interface, but this program has 1.$minor" "$lab/said" ||
    { cat "$lab/said"; exit 1; }
[ "$(grep -c '^error\|: error' "$lab/said")" = 1 ] || { cat "$lab/said"; exit 1; }

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
    grep -q 'at 80 degC eta0 is 0.01 Pa s in the law and 0.0298[0-9] Pa s in the oil' "$lab/said" ||
        { cat "$lab/said"; exit 1; }
done
"$flankfilm" check "$lab/oil.yaml" --plugin-path "$lab" --set "viscosity.eta0=29.9 mPa s" >"$lab/said" 2>&1 ||
    { cat "$lab/said"; exit 1; }

grep -q "^## 1\.$minor\$" "$source/docs/abi.md" || { echo "docs/abi.md has no section 1.$minor"; exit 1; }
for header in "$source"/include/flankfilm/*.h; do
    header=$(basename "$header")
    grep -q "\`$header\`" "$source/docs/abi.md" || { echo "docs/abi.md does not name $header"; exit 1; }
done
