#!/bin/sh
# Installs the Debian packages that flankfilm is built with and that are missing here;
# `need.sh test` adds those of its tests.
set -eu

packages="gcc libc6-dev meson ninja-build pkg-config libyaml-dev libjansson-dev libgsl-dev
          libfftw3-dev libopenblas-dev liblapacke-dev libsuitesparse-dev
          libnetcdf-dev libjs-vega"
if [ "${1:-}" = test ]; then
    packages="$packages check libsubunit-dev libudunits2-dev openmpi-bin libopenmpi-dev
              slurmctld slurmd slurm-client munge"
    # plugins in other languages; man page and completion
    packages="$packages g++ gfortran rustc mandoc groff-base fish"
    # Debian packages of the program
    packages="$packages dpkg-dev"
    # counts of instructions, and what they are
    packages="$packages valgrind binutils"
    # the schema of editors
    packages="$packages python3-jsonschema python3-yaml"
    # NetCDF as users read it, and a browser for the report
    packages="$packages python3-xarray python3-netcdf4 chromium"
    # the examples in other languages
    packages="$packages python3-numpy python3-scipy octave octave-netcdf"
fi

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "This is no Debian: install the equivalents of" $packages >&2
    exit 0
fi

missing=
for package in $packages; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' ||
        missing="$missing $package"
done
[ -n "$missing" ] || exit 0

root=
[ "$(id -u)" = 0 ] || root=sudo
echo "Installing$missing"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
{ $root apt-get update -qq && $root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends $missing; } >"$log" 2>&1 || {
    cat "$log" >&2
    exit 1
}
