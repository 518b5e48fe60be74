#!/bin/sh
# What the lines of the quality record cost: instructions of the functions that make them, over those of the films.
#   sh docs/lines.sh BUILD_DIRECTORY FILE [--set NAME=VALUE ...]
# Needs valgrind. None of these functions calls another one of them. `entrained_past` stands for the line of the
# inlet's end, whose other sum is part of the loss.
set -eu
build=$1
shift
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
valgrind --tool=callgrind --callgrind-out-file="$lab/counts" "$build/flankfilm" run "$@" >"$lab/run" 2>&1 || {
    cat "$lab/run"
    exit 1
}
callgrind_annotate --inclusive=yes --threshold=100 "$lab/counts" | awk '
    BEGIN {
        split("ehl_results_errors ehl_results_peak_in_time ehl_estimate_truncation ehl_march_truncation " \
              "ehl_advect_error ehl_balance_hold ehl_balance_outputs ehl_thermal_hold ehl_history_sample entrained_past " \
              "ehl_inlet_heating_report ehl_results_measure ehl_results_quality", names)
        for (k in names) line[names[k]] = 1
    }
    match($0, /:[a-z_0-9]+(\.[a-z0-9.]+)? \[/) {
        name = substr($0, RSTART + 1, RLENGTH - 3)
        sub(/\..*/, "", name)
        count = $1
        gsub(",", "", count)
        count += 0
        if (name == "ehl_evaluate") films += count
        if (name in line && count > 5000) { sum += count; printf "%-26s %9.2f\n", name, count / 1e6 }
    }
    END {
        if (!films) { print "no film"; exit 1 }
        printf "%-26s %9.2f million instructions of %.0f: %.2f %%\n", "all lines", sum / 1e6, films / 1e6, 100 * sum / films
    }'
