#!/bin/sh
# `flankfilm explain --yaml` prints a file that runs to the same result and says where values come from;
# `flankfilm cite` prints each entry once.
# explain-yaml.sh FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT
set -eu
flankfilm=$(realpath "$1") source=$(realpath "$3")
export FLANKFILM_PLUGIN_PATH="$2"
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
cd "$source"

bare() { sed -e 's/ *# .*//' -e '/^$/d' "$1"; }
same_run() { # FILE [--set ...]: the file and what is printed of it give the same numbers
    rm -rf "$lab/a" "$lab/b"
    "$flankfilm" explain --yaml "$@" >"$lab/shown.yaml"
    "$flankfilm" run "$@" -o "$lab/a" >/dev/null
    "$flankfilm" run "$lab/shown.yaml" -o "$lab/b" >/dev/null
    rm -rf "$lab"/[ab]/result.json "$lab"/[ab]/study.json "$lab"/[ab]/journal.jsonl "$lab"/[ab]/stages # times, and what took long
    diff -r "$lab/a" "$lab/b"
}

for file in configs/*.yaml configs/studies/*.yaml; do
    "$flankfilm" explain --yaml "$file" >"$lab/once.yaml"
    # from another folder, includes gone; leaks were looked for above
    ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=0" "$flankfilm" explain --yaml "$lab/once.yaml" >"$lab/twice.yaml"
    bare "$lab/once.yaml" >"$lab/once"
    bare "$lab/twice.yaml" >"$lab/twice"
    diff "$lab/once" "$lab/twice"
    grep -q '^pipeline:$' "$lab/once"
done

# layers: a later value replaces another of its group, a set another model's
same_run configs/line-contact.yaml --set film.cells=64 --set viscosity.use=viscosity/barus \
    --set 'viscosity.alpha=12.345678901 1/GPa'
grep -q 'alpha: 12.345678901 1/GPa  *# --set$' "$lab/shown.yaml"
grep -q '# alpha: 11.0 1/GPa .*mil-l-23699.yaml:[0-9]*, replaced by a later value$' "$lab/shown.yaml"
grep -q '# tolerance: .* # preset$' "$lab/shown.yaml"
grep -q '# viscosity: viscosity  *# automatic$' "$lab/shown.yaml"
gears='--set mesh.use=stiffness/iso-6336 --set outputs=[motion.dte_rms]'
# shellcheck disable=SC2086
same_run configs/li-kahraman-2011.yaml $gears --set 'duty.speed=1500 rpm'
grep -q '# mesh_frequency: 1250 Hz .*replaced by a later value$' "$lab/shown.yaml"

# files, names that need quotes, and a study over whole stages
mkdir "$lab/case"
printf 'phase,stiffness [N/m]\n0,4e8\n0.5,6e8\n' >"$lab/case/my mesh: #1.csv"
cat >"$lab/case/study.yaml" <<EOF
format: 2
title: "a: 'b' # \"c\" \\\\ d"
include: [$source/configs/gears/unity-50.yaml]
pipeline:
  duty: {use: operating/steady, torque: 250 N m}
  mesh: {use: stiffness/table, file: "my mesh: #1.csv"}
outputs: [motion.dte_rms, mesh.stiffness_mean]
study:
  sweep:
    motion: [{use: dynamics/quasi-static}, {use: dynamics/shooting, damping_ratio: 0.01}]
    duty.mesh_frequency: [1000 Hz, 2000 Hz]
EOF
same_run "$lab/case/study.yaml"
[ "$(wc -l <"$lab/b/table.csv")" = 5 ]

"$flankfilm" cite configs/li-kahraman-2011.yaml >"$lab/bib"
[ "$(grep -ci '^@article{likahraman2011,' "$lab/bib")" = 1 ]
# the program itself, with its version and, if the sources know it, their commit
grep -q "^@software{flankfilm,.* version={$("$flankfilm" --version | cut -d' ' -f2)}" "$lab/bib"
commit=$(sh core/program/cli/commit.sh .)
[ -z "$commit" ] || grep -Eq '^@software.* note=\{commit [0-9a-f]{12}(-dirty)?\}\}$' "$lab/bib"
[ -z "$(grep -o '^@[a-z]*{[^,]*' "$lab/bib" | tr A-Z a-z | sort | uniq -d)" ]
"$flankfilm" cite configs/studies/film-map.yaml | grep -q 'viscosity/doolittle-tait (study)'
if "$flankfilm" cite "$lab/case/none.yaml" 2>"$lab/said"; then exit 1; fi
grep -qF none.yaml "$lab/said"
