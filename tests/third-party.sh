#!/bin/sh
# The plugin that docs/plugins.md prints, compiled outside the tree, serves a pipeline without a
# rebuild.   third-party.sh FLANKFILM SOURCE_ROOT
set -eu
flankfilm=$1
source=$2
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT

awk '/^```c$/ {on = 1; next} /^```$/ {on = 0} on' "$source/docs/plugins.md" >"$lab/lab-oil.c"
mkdir "$lab/viscosity"
cc -std=c11 -O2 -Wall -Wextra -Wpedantic -Werror -fPIC -shared -fvisibility=hidden \
    -I "$source/include" "$lab/lab-oil.c" -o "$lab/viscosity/lab-oil.so" -lm

"$flankfilm" models viscosity/lab-oil --plugin-path "$lab" | grep -q alpha

run() {
    "$flankfilm" run "$source/configs/line-contact.yaml" --plugin-path "$lab" \
        --set film.cells=128 --set 'outputs=[film.h_central]' --json "$@" |
        grep -o '"data": *\[[^]]*\]'
}
own=$(run --set oil.use=viscosity/lab-oil --set 'oil.eta0=5.006 mPa s' --set 'oil.alpha=11.03 1/GPa')
barus=$(run --set oil.use=viscosity/barus --set 'oil.eta0=5.006 mPa s' --set 'oil.alpha=11.03 1/GPa')

# With beta = 0 the new law is Barus' law.
echo "lab-oil $own, barus $barus"
[ "$own" = "$barus" ]
