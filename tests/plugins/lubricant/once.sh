#!/bin/sh
# The oil stands once: what contradicts it is an error that shows both; a swap of the law moves nothing
# of the oil.
# once.sh FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT BAD_PLUGINS
set -eu
flankfilm=$1 plugins=$2 source=$3 bad=$4
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT

run() { # SETTING...
    set -- "$@" end
    while [ "$1" != end ]; do
        set -- "$@" --set "$1"
        shift
    done
    shift
    "$flankfilm" run --all "$source/configs/one-oil.yaml" --plugin-path "$plugins" -o "$lab/results" \
        --set film.use=ehl/film-formula --set outputs="[oil.*, film.h_central]" "$@" 2>&1 || true
}
says() { # TEXT, then SETTING...
    text=$1
    shift
    said=$(run "$@")
    echo "$said" | tr '\n' ' ' | grep -q "$text" || { echo "$*: $said" && exit 1; }
}
refuses() { # TEXT, then SETTING...: what `run` refuses is found by `check`, too
    says "$@"
    text=$1
    shift
    set -- "$@" end
    while [ "$1" != end ]; do
        set -- "$@" --set "$1"
        shift
    done
    shift
    if said=$("$flankfilm" check "$source/configs/one-oil.yaml" --plugin-path "$plugins" "$@" 2>&1); then
        echo "check $*: $said"
        exit 1
    fi
    echo "$said" | tr '\n' ' ' | grep -q "$text" || { echo "check $*: $said" && exit 1; }
}

refuses 'viscosity.eta0: the stage "oil" gives this value, too, by the wire "oil"' "viscosity.eta0=60 mPa s"
refuses 'density.rho0: the stage "oil" gives this value, too, by the wire "oil"' "density.rho0=855 kg/m3"
# a law that knows nothing of the oil, by 2 % and by 0.3 %
refuses 'at 70 degC eta0 is 0.06025 Pa s in the law and 0.05907 Pa s in the oil' \
    viscosity.use=viscosity/roelands viscosity.oil=none "viscosity.alpha=20 1/GPa" "viscosity.eta0=60.25 mPa s"
says 'h_central' viscosity.use=viscosity/roelands viscosity.oil=none "viscosity.alpha=20 1/GPa" "viscosity.eta0=59.25 mPa s"
refuses 'rho0 is 880 kg/m3 in the law and 855.1 kg/m3 in the oil' density.oil=none "density.rho0=880 kg/m3"
refuses 'in two places: here 70 degC, and as duty.oil_temperature 90 degC (--set' \
    "duty={use: operating/steady, torque: 1 N m, speed: 1 rpm, oil_temperature: 90 degC}"

run viscosity.use=viscosity/roelands >"$lab/roelands"
run viscosity.use=viscosity/barus >"$lab/barus"
for value in temperature eta0 rho0 alpha; do
    for law in roelands barus; do
        grep "^  $value " "$lab/$law" >"$lab/$law.$value"
    done
    cmp "$lab/roelands.$value" "$lab/barus.$value"
done
grep -q "^  h_central " "$lab/roelands"
grep -q "^  h_central " "$lab/barus"

# a law that crashes while `check` holds it against the oil is named
said=$(FLANKFILM_MISDEED="law eval crash" "$flankfilm" check "$source/configs/one-oil.yaml" --plugin-path "$plugins" \
    --plugin-path "$bad" --set viscosity.use=viscosity/misdeed 2>&1) && code=0 || code=$?
[ "$code" = 3 ] && echo "$said" | grep -q "the plugin $bad/viscosity/misdeed.so crashed during eval" || { echo "$code: $said" && exit 1; }
