#!/bin/sh
# docs/validation/paper.md says what the program gives: its script is run anew, and the words, verdicts
# included, are those of the page; numbers within 2 % or 2 of the last digit, which leaves room for
# other processors and libraries but not for another model.
# validation.sh BUILD_DIRECTORY SOURCE_ROOT
set -eu
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
unset FLANKFILM_PLUGIN_PATH
sh "$2/docs/validation/paper.sh" "$1" "$lab"
awk -f "$2/docs/validation/compare.awk" "$2/docs/validation/paper.md" "$lab/paper.md"
for figure in "$2"/docs/validation/paper-fig*.svg; do
    [ -s "$lab/$(basename "$figure")" ] || { echo "$figure is not drawn" && exit 1; }
done
