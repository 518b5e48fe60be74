#!/bin/sh
# A plugin that is built anew while its version stays the same is seen by key, plan, run and resume,
# and `--rerun all` takes nothing over from before.   study-rebuilt.sh FLANKFILM PLUGINS SOURCE_ROOT
set -eu
flankfilm=$(realpath "$1") source=$(realpath "$3")
FLANKFILM_PLUGIN_PATH=$(realpath "$2")
export FLANKFILM_PLUGIN_PATH
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
cd "$lab"
"$flankfilm" new viscosity/my-law >said
cd my-law
mkdir -p own/viscosity
build() { # FOLDER: the file is a new one, as a linker makes it
    rm -f "$1/viscosity/my-law.so"
    ${CC:-cc} -std=c11 -O1 -fPIC -shared -fvisibility=hidden -I "$source/include" my-law.c \
        -o "$1/viscosity/my-law.so" -lm
}
sed 's/^outputs.*/outputs: [film.h_min_lowest]/; s/cells: 256/cells: 2048/' my-law.yaml >study.yaml
echo 'study: {sweep: {discs.entrainment_speed: {from: 1 m/s, to: 8 m/s, points: 8}}}' >>study.yaml
study() { # COMMAND DIRECTORY [OPTION]...
    command=$1 directory=$2
    shift 2
    "$flankfilm" "$command" study.yaml --plugin-path own -o "$directory" -j1 "$@" >said 2>&1
}
holds() { grep -qF -- "$1" said || { echo "not said: $1"; cat said; exit 1; }; }
table() { sed 's/^\([0-9]*\),[0-9a-f]*,/\1,/' "$1/table.csv"; } # without the keys
films() { # of both directories are the same, for each case
    table "$1" >a
    table "$2" >b
    cmp a b
}

build own
study run first
cp -r first again
cp -r first there
[ "$(ls first/stages | wc -l)" -gt 0 ] # kept results of stages that might be taken over
study plan first
holds '8 done, 0 failed, 0 to run'
# the same bytes in a new file are the same build
cp own/viscosity/my-law.so copy
rm own/viscosity/my-law.so
mv copy own/viscosity/my-law.so
study plan first
holds '8 done, 0 failed, 0 to run'

sed -i 's/ln_eta\[i\] = ln_eta0/ln_eta[i] = 1 + ln_eta0/' my-law.c
build own
study run fresh
if films first fresh; then exit 1; fi
study plan again
holds '0 done, 0 failed, 8 to run'
holds 'oil.build of the plugin: '
study run again
holds 'oil: the plugin own/viscosity/my-law.so is a different build from that of the results in again'
holds '8 of 8 cases done'
if grep 'before' said; then exit 1; fi
films again fresh
study run again
holds '8 of 8 cases done, 8 of them earlier'
if grep 'another build' said; then exit 1; fi
study run there --rerun all
films there fresh

# a stage that is computed again by the same build: nothing stands from before
touch mark
study run again --rerun all
[ -z "$(find again/stages -type f ! -newer mark)" ]
films again fresh
