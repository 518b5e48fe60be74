#!/bin/sh
# configs/octave/example.m reads an export in GNU Octave and prints what the table of the study says.
# octave.sh FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT
set -eu
flankfilm=$(realpath "$1") source=$3
command -v octave-cli >/dev/null || { echo "needs GNU Octave" && exit 77; }
"$(dirname "$flankfilm")/flankfilm-netcdf" 2>&1 | grep -q usage || { echo "needs flankfilm-netcdf with its packages" && exit 77; }
FLANKFILM_PLUGIN_PATH=$2
export FLANKFILM_PLUGIN_PATH
unset DISPLAY
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
cd "$lab"
export HOME="$lab"

"$flankfilm" run "$source/configs/octave/torque.yaml" -o study >said 2>&1 || {
    cat said
    exit 1
}
"$flankfilm" export study --to netcdf >said
octave-cli -q "$source/configs/octave/example.m" study/results.nc >shown 2>said || {
    cat shown said
    exit 1
}
# torque and least film of each case, to 4 digits
sed -n 's/^\([0-9]*\) N m: \([^ ]*\) m, \([0-9]*\) points, least \([^ ]*\) m$/\1 \2 \4/p' shown >octave
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
         { film = sprintf("%.4g", $column["film.h_min_lowest [m]"])
           print $column["duty.torque [N m]"], film, film }' study/table.csv >table
diff table octave && [ "$(wc -l <octave)" -eq 4 ] && grep -q 'to the power of -0.1' shown || {
    cat shown
    exit 1
}
