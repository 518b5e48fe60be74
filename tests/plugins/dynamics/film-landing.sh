#!/bin/sh
# Where flanks part and land, the film takes what the motion gives it: the books of power of both close.
# film-landing.sh FLANKFILM SOURCE_ROOT
set -eu
flankfilm=$(realpath "$1") source=$(realpath "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

run()
{
    "$flankfilm" run "$source/configs/two-way.yaml" --set 'duty.mesh_frequency=2375 Hz' --set motion.branch=upper \
        --set film.cells=256 --set outputs=[motion.film_power] \
        --set motion.squeeze=series --json > run.json 2> errors || {
        cat errors
        grep -o '"message":"[^"]*"' run.json
        exit 1
    }
}

line()
{
    sed -n "s/.*\"$1\":{\"value\":\([^,]*\).*/\1/p" run.json
}

# the loop settles: it swung between two motions while the film of flanks that part acted on them at small loads
run
echo "rounds: $(line feedback_rounds)"

series=$(line power_balance)
echo "in less out over the loss: $series"
# 3.7e-3 with 256 cells; 1.8e-2 with the films squeezed twice, by the motion and by the film stage, 1.1e-2 with the gap of stiff teeth
awk -v series="$series" 'BEGIN { exit !(series != "" && series < 5e-3) }'
