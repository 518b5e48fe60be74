#!/bin/sh
# What README.md, docs/*.md and the guide print works: each shell block is run, in order and with the installed
# program alone; each YAML block is a file that `check` accepts; each C block compiles.
# docs.sh BUILD_DIRECTORY SOURCE_ROOT PREFIX
set -eu
build=$1 source=$2 prefix=$3
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
unset FLANKFILM_PLUGIN_PATH
export XDG_DATA_HOME="$lab/home"

# heads of files, lengths, links
/usr/bin/python3 "$source/tests/pages.py" "$source"

meson install -C "$build" --no-rebuild --quiet --destdir "$lab/root" >"$lab/said" 2>&1 || {
    cat "$lab/said"
    exit 1
}
PATH=$lab/root$prefix/bin:$PATH
PKG_CONFIG_PATH=$(dirname "$(find "$lab/root$prefix" -name flankfilm.pc)")
export PATH PKG_CONFIG_PATH

# The blocks of a page become files: C and YAML by the name in their first line, else by number; a
# part of a file is laid over an example.
cut_blocks() { # PAGE DIRECTORY
    awk -v to="$2" '
        /^```[a-z]+$/ { kind = substr($0, 4); count++; lines = 0; next }
        /^```$/ { if (kind == "sh") print "" >to "/all.sh"; else if (kind) close(file); kind = ""; next }
        !kind { next }
        kind == "sh" { print >(to "/all.sh"); next }
        kind != "c" && kind != "cpp" && kind != "yaml" { next }
        !lines++ {
            named = match($0, /[a-z-]+\.(c|cpp|yaml)/)
            file = to "/" (named ? substr($0, RSTART, RLENGTH) : "configs/block-" count "." kind)
            if (kind == "yaml" && /^study:/) {
                print "format: 2" >file
                print "include: [li-kahraman-2011.yaml]" >file
            }
        }
        { print >file }' "$1"
}

lines=0 blocks=0
# the guide is one job, chapter after chapter
chapters=$(sed -n "s#^- \\[.*\\](\\(guide/[a-z-]*\\.md\\)).*#$source/docs/\\1#p" "$source/docs/guide.md")
for page in "$source/README.md" "$source"/docs/*.md $chapters; do
    name=$(basename "$page" .md)
    case $page in */guide/*) name=guide ;; esac
    place=$lab/$name
    mkdir -p "$place/build" "$place/docs"
    rm -rf "$place/configs" "$place/all.sh"
    cp -r "$source/configs" "$place/"
    ln -sf "$lab/root$prefix/bin/flankfilm" "$place/build/flankfilm"
    cut_blocks "$page" "$place"
    cd "$place"
    for file in configs/block-*.yaml; do
        [ -f "$file" ] || continue
        flankfilm check "$file"
        blocks=$((blocks + 1))
    done
    [ -f all.sh ] || continue
    # those that build or draw everything are jobs of their own
    sed -n 's/^sh \([^ ]*\.sh\).*/\1/p' all.sh | while read -r script; do [ -f "$source/$script" ]; done
    # but what the demo leaves is there for the lines behind it
    sed -i -e 's/^sh configs\/demo\.sh.*/flankfilm run configs\/li-kahraman-2011.yaml/' -e '/^sh [a-z/-]*\.sh/d' all.sh
    # what wants a cluster has tests with one
    sed -i -e '/^sbatch /d' -e '/^PARTS=/d' -e '/^mpirun /d' all.sh
    grep -q . all.sh || continue
    sh -eux all.sh >said 2>&1 || { cat said && echo "$page: a command failed" && exit 1; }
    echo "$name: $(grep -c . all.sh) lines of shell, $(ls configs/block-* 2>/dev/null | wc -l) blocks"
    lines=$((lines + $(grep -c . all.sh)))
done
echo "$lines lines of shell, $blocks blocks of YAML"
[ "$lines" -ge 30 ]
[ "$blocks" -ge 5 ]

# what the page on plugins prints is a law: with beta = 0 it is that of Barus
cd "$lab/plugins"
film() { flankfilm run lab-oil.yaml --plugin-path lab --json --set viscosity.beta="$1" --set viscosity.use="$2" | grep -o '"data":\[[^]]*\]'; }
film '0 1/GPa2' viscosity/lab-oil >own
sed -i 's/, beta: -2 1.GPa2//' lab-oil.yaml
flankfilm run lab-oil.yaml --json --set viscosity.use=viscosity/barus | grep -o '"data":\[[^]]*\]' >barus
diff own barus
