#!/bin/sh
# Debian packages of what `meson install` installs: flankfilm, libflankfilm0, libflankfilm-dev and python3-flankfilm.
#   sh docs/package.sh [OUTPUT_DIRECTORY [BUILD_DIRECTORY]]
# Without a build directory one is made with Debian's places. That of another build is taken as it is, and its prefix is moved to /usr.
set -eu
out=$(mkdir -p "${1:-.}" && cd "${1:-.}" && pwd)
build=${2:+$(cd "$2" && pwd)}
cd "$(dirname "$0")/.."

for tool in meson dpkg-deb dpkg-shlibdeps; do
    command -v $tool >/dev/null || { echo "package.sh needs $tool, of Debian's meson and dpkg-dev" >&2 && exit 1; }
done
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
machine=$(dpkg --print-architecture)

if [ -z "$build" ]; then
    build=$lab/build
    meson setup "$build" --prefix=/usr --libdir="lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)" >"$lab/said" &&
        ninja -C "$build" >"$lab/said" || { tail -n 40 "$lab/said" >&2 && exit 1; }
fi
eval "$(meson introspect --projectinfo --buildoptions "$build" | python3 -c '
import json, shlex, sys
told = json.load(sys.stdin)
for option in told["buildoptions"]:
    if option["name"] in ("prefix", "libdir"):
        print(option["name"] + "=" + shlex.quote(option["value"]))
print("version=" + shlex.quote(told["projectinfo"]["version"]))')"
meson install -C "$build" --no-rebuild --quiet --strip --destdir "$lab/stage" >"$lab/said" 2>&1 || {
    cat "$lab/said" >&2
    exit 1
}

installed=$lab/stage$prefix

# take PACKAGE PATTERN...: moves what the patterns name from the installed tree into the package.
take() {
    package=$lab/$1
    shift
    for pattern in "$@"; do
        for path in "$installed"/$pattern; do
            to=$package/usr${path#"$installed"}
            mkdir -p "$(dirname "$to")"
            mv "$path" "$to"
        done
    done
}
take libflankfilm0 "$libdir/libflankfilm.so.*"
take libflankfilm-dev include "$libdir/libflankfilm.so" "$libdir/pkgconfig"
mkdir -p "$lab/python3-flankfilm/usr/lib/python3/dist-packages"
mv "$installed/share/flankfilm/configs/python/flankfilm" "$lab/python3-flankfilm/usr/lib/python3/dist-packages/"
# what Python has compiled goes with the package
mkdir "$lab/python3-flankfilm/DEBIAN"
cat >"$lab/python3-flankfilm/DEBIAN/prerm" <<'END'
#!/bin/sh
set -e
rm -rf "$DPKG_ROOT/usr/lib/python3/dist-packages/flankfilm/__pycache__"
END
chmod 755 "$lab/python3-flankfilm/DEBIAN/prerm"
take flankfilm bin "$libdir/flankfilm" share
rest=$(find "$lab/stage" ! -type d)
[ -z "$rest" ] || { echo "installed, and in no package: $rest" >&2 && exit 1; }

# needs FILE...: the packages whose shared libraries the files of this project need.
needs() {
    mkdir -p "$lab/debian"
    printf 'Source: flankfilm\n\nPackage: flankfilm\nArchitecture: any\n' >"$lab/debian/control"
    (cd "$lab" && dpkg-shlibdeps -O --ignore-missing-info -l"$lab/libflankfilm0/usr/$libdir" "$@" 2>"$lab/said") |
        sed -n 's/^shlibs:Depends=//p'
}

# pack NAME ARCHITECTURE SECTION SUMMARY DESCRIPTION FIELD...: a line for each further field.
pack() {
    name=$1 architecture=$2 section=$3 summary=$4 description=$5
    shift 5
    root=$lab/$name
    mkdir -p "$root/DEBIAN" "$root/usr/share/doc/$name"
    cp LICENSE "$root/usr/share/doc/$name/copyright"
    (cd "$root" && find usr -type f -exec md5sum {} +) >"$root/DEBIAN/md5sums"
    {
        echo "Package: $name"
        echo "Version: $version"
        echo "Architecture: $architecture"
        echo "Maintainer: The developers of flankfilm <flankfilm@localhost>"
        echo "Section: $section"
        echo "Priority: optional"
        echo "Installed-Size: $(du -k -s "$root/usr" | cut -f 1)"
        for field in "$@"; do echo "$field"; done
        echo "Description: $summary"
        echo "$description" | fold -s -w 76 | sed 's/ *$//; s/^/ /'
    } >"$root/DEBIAN/control"
    chmod -R u=rwX,go=rX "$root"
    dpkg-deb --root-owner-group --build "$root" "$out/${name}_${version}_$architecture.deb" >/dev/null
    echo "$out/${name}_${version}_$architecture.deb"
}

# what one model alone needs may stay away: it says so when it is asked for
optional=$(find "$lab/flankfilm/usr/$libdir/flankfilm/plugins" -path '*/executor/mpi.so')
models=$(find "$lab/flankfilm/usr/$libdir/flankfilm/plugins" -name '*.so' -type f)
for file in $optional; do models=$(echo "$models" | grep -vx "$file"); done
# shellcheck disable=SC2086
pack flankfilm "$machine" science "film and vibration of spur gear pairs, both ways" \
    "Predicts how the vibration of a spur gear pair changes the oil film between its teeth, and what the film does to the gears: program, models, examples and manual." \
    "Depends: libflankfilm0 (= $version), $(needs "$lab"/flankfilm/usr/bin/flankfilm $models)" \
    "Recommends: python3-numpy, python3-netcdf4${optional:+, $(needs $optional)}"
pack libflankfilm0 "$machine" libs "film and vibration of spur gear pairs: library" \
    "Reads a pipeline of models, wires and runs it. The models are in the package flankfilm." \
    "Depends: $(needs "$lab"/libflankfilm0/usr/"$libdir"/libflankfilm.so.*)" "Recommends: flankfilm (= $version)"
pack libflankfilm-dev "$machine" libdevel "film and vibration of spur gear pairs: headers" \
    "For models of one's own, and for programs that use the library." "Depends: libflankfilm0 (= $version)"
pack python3-flankfilm all python "film and vibration of spur gear pairs: Python module" \
    "Runs pipelines, studies and single models from Python; arrays share the memory of the library." \
    "Depends: python3, flankfilm (>= $version), libflankfilm0 (>= $version)" "Recommends: python3-numpy"
