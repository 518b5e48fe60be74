#!/bin/sh
# docs/validation says what the program gives: the quick scripts are run anew, and the words of their
# pages, verdicts included, are those kept; numbers within 2 % or 2 of the last digit, which leaves
# room for other processors and libraries but not for another model.
# validation.sh BUILD_DIRECTORY SOURCE_ROOT
set -eu
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
unset FLANKFILM_PLUGIN_PATH
kept=$2/docs/validation
for page in paper benchmarks; do
    sh "$kept/$page.sh" "$1" "$lab" quick
    # what the quick run leaves out: what stands last, and a sentence on a finer surface; the commit is another
    sed -i '/^<!-- made at /d' "$lab/$page.md"
    sed -e '/^## Beyond the paper/,$d' -e '/^<!-- made at /d' -e 's/Waves down to 5 um .* cells of 1\.3 um\. //' "$kept/$page.md" > "$lab/kept.md"
    awk -f "$kept/compare.awk" "$lab/kept.md" "$lab/$page.md" || {
        echo "sh docs/validation/$page.sh build writes the page anew"
        exit 1
    }
done
command -v chromium >/dev/null || {
    echo "the pages hold; their figures need Chromium"
    exit 0
}
for figure in "$kept"/paper-fig*.svg "$kept"/paper-smooth*.svg; do
    [ -s "$lab/$(basename "$figure")" ] || { echo "$figure is not drawn" && exit 1; }
done
