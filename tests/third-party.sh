#!/bin/sh
# People who have only the installed program: what `flankfilm new` writes for a law and for a stage (for every
# kind: tests/core/program/new-models.sh), and an example of every kind, in C, C++, Fortran and Rust, are built
# by meson, pass `verify` and serve a pipeline.
# third-party.sh BUILD_DIRECTORY SOURCE_ROOT PREFIX
set -eu
build=$1 source=$2 prefix=$3
for tool in g++ gfortran rustc; do
    command -v $tool >/dev/null || { echo "needs $tool" && exit 77; }
done
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
unset FLANKFILM_PLUGIN_PATH
export XDG_DATA_HOME="$lab/home"

meson install -C "$build" --no-rebuild --quiet --destdir "$lab/root" >"$lab/said" 2>&1 || {
    cat "$lab/said"
    exit 1
}
root=$lab/root$prefix
PATH=$root/bin:$PATH
PKG_CONFIG_PATH=$(dirname "$(find "$root" -name flankfilm.pc)")
export PATH PKG_CONFIG_PATH

# works FOLDER: builds the projects in its subprojects, one for each kind, and tests them
works() {
    echo "project('all', 'c')" >"$1/meson.build"
    for project in "$1"/subprojects/*; do
        echo "subproject('$(basename "$project")')" >>"$1/meson.build"
    done
    { meson setup "$1/build" "$1" && ninja -C "$1/build" &&
        meson test -C "$1/build" --no-rebuild --print-errorlogs; } >"$1/said" 2>&1 || {
        cat "$1/said"
        exit 1
    }
    if grep -i 'warning:' "$1/said" | grep -v '^WARNING: .*meson'; then exit 1; fi
    for project in "$1"/subprojects/*; do
        file=$(ls "$project"/*.yaml)
        flankfilm run "$file" --plugin-path "$1/build/subprojects" -o "$1/out-$(basename "$project")" >/dev/null
        echo "$(basename "$project")/$(basename "$file" .yaml): built, verified, run"
    done
}

mkdir -p "$lab/own/subprojects"
for kind in density stiffness; do
    flankfilm new "$kind/own-$kind" -o "$lab/own/subprojects/$kind" >/dev/null
done
works "$lab/own"

# a folder is called as its kind, so that a second example of a kind goes into a second project
for example in "$source"/tests/third-party/*; do
    kind=$(sed -n "s|.*plugindir') / '\(.*\)').*|\1|p" "$example/meson.build")
    project=$lab/labs
    [ ! -e "$project/subprojects/$kind" ] || project=$lab/more
    mkdir -p "$project/subprojects"
    cp -r "$example" "$project/subprojects/$kind"
done
works "$lab/labs"
works "$lab/more"

# there is one of each kind that has a template
for template in "$(pkg-config --variable=plugindir flankfilm)"/*.template.c; do
    kind=$(basename "$template" .template.c)
    [ -e "$lab/labs/subprojects/$kind" ] || { echo "tests/third-party has no $kind"; exit 1; }
done

# 5P4E is the same oil by the law from outside and by the card, whose laws share eta0 and alpha*
moes() {
    flankfilm run "$lab/more/subprojects/viscosity/yasutomi.yaml" --plugin-path "$lab/more/build/subprojects" \
        --set 'outputs=[discs.moes_M, discs.moes_L]' --json "$@" | grep -o '"data":\[[^]]*\]' | tr -dc '0-9.\n'
}
card="$root/share/flankfilm/configs/lubricants/5p4e.yaml"
constants=$(sed -n 's/^ *viscosity\/barus: {\(alpha\): \(.*\)}/viscosity.\1=\2/p' "$card")
moes >"$lab/yasutomi"
moes --set viscosity.use=viscosity/barus --set "$constants" --set "viscosity.eta0=16.4 mPa s" >"$lab/barus"
paste "$lab/yasutomi" "$lab/barus"
paste "$lab/yasutomi" "$lab/barus" | awk '{ d = $1/$2 - 1; bad += d*d > 1e-6 } END { exit bad || NR != 2 }'

# a law from outside takes part in a choice, and stands as the reference where the file says so
barus=$(echo "$constants" | sed 's|viscosity\.|viscosity.with.viscosity/barus.|')
flankfilm run "$lab/more/subprojects/viscosity/yasutomi.yaml" --plugin-path "$lab/more/build/subprojects" --json \
    --set viscosity.use=viscosity/auto --set viscosity.reference=viscosity/yasutomi --set accuracy='20 %' \
    --set "$barus" --set "viscosity.with.viscosity/barus.eta0=16.4 mPa s" --set 'outputs=[film.h_min]' >"$lab/choice"
grep -q '"model":"viscosity/barus","taken":true' "$lab/choice"

# installed for all users of the machine, it needs no path
meson install -C "$lab/labs/build" --no-rebuild --quiet >/dev/null 2>&1
flankfilm models stiffness/kuang-yang | grep -q 'Kuang & Yang 1992'
