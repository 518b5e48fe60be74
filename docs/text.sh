#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Share of a run's instructions that write its results: sh docs/text.sh BUILD FILE...
# A row of a table for each file: instructions of the run, of the writing, and the share. Wants valgrind.
set -eu
flankfilm=$1/flankfilm
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
echo '| file | run, 1e6 instructions | writing, 1e6 | share |'
echo '|---|---|---|---|'
for file; do
    valgrind --tool=callgrind --callgrind-out-file="$work/out" "$flankfilm" run -j 1 -o "$work/results" "$file" > "$work/said" 2>&1 ||
        { cat "$work/said" >&2; exit 1; }
    callgrind_annotate --inclusive=yes --threshold=100 "$work/out" | tr -d , | awk -v file="$(basename "$file")" '
        /PROGRAM TOTALS/ { all = $1 }
        /:results_write_run [[]/ { writing = $1 }
        END { printf "| %s | %.1f | %.2f | %.2g %% |\n", file, all / 1e6, writing / 1e6, 100 * writing / all }'
    rm -rf "$work/results"
done
