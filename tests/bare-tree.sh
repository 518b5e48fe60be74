#!/bin/sh
# The Debian packages in a tree that debootstrap makes, with nothing but what they depend on: apt installs them, the
# seed's case runs, a model compiles, Python runs, and a purge leaves the tree as it was. As root, with a mirror at hand.
# bare-tree.sh BUILD_DIRECTORY SOURCE_ROOT DIRECTORY [MIRROR]
set -eu
build=$1 source=$2 lab=$3 mirror=${4:-}
tree=$lab/tree
{ [ "$(id -u)" = 0 ] && command -v debootstrap >/dev/null; } || { echo "needs root and debootstrap" && exit 77; }
mkdir -p "$lab"
[ -e "$tree/usr/bin/apt-get" ] || debootstrap --variant=minbase bookworm "$tree" ${mirror:+"$mirror"} >"$lab/said"
sh "$source/docs/package.sh" "$tree/packages" "$build"

# within COMMAND...: in the tree, with no environment of ours
within() { chroot "$tree" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C DEBIAN_FRONTEND=noninteractive "$@"; }
files() { find "$tree" -xdev \( -path "$tree/var" -o -path "$tree/packages" -o -path "$tree/root" -o -path "$tree/tmp" -o -path "$tree/proc" -o -path "$tree/etc/ld.so.cache" \) -prune -o -print | sort; }

within apt-get -q update >"$lab/said"
# what the packages of this project need, and a compiler, belong to the tree that the purge is held against
within apt-get -q -y install gcc libc6-dev pkg-config python3-numpy >"$lab/said"
needed=$(for deb in "$tree"/packages/*.deb; do dpkg-deb -f "$deb" Depends; done | tr ',' '\n' | sed 's/(.*//; s/|.*//; s/ //g' | grep -v flankfilm | sort -u)
# shellcheck disable=SC2086
within apt-get -q -y --no-install-recommends install $needed >"$lab/said"
files >"$lab/before"
within sh -c 'apt-get -q -y --no-install-recommends install /packages/*.deb' >"$lab/said"
within dpkg -l | grep flankfilm

seed=/usr/share/flankfilm/configs/li-kahraman-2011.yaml
within flankfilm run $seed --set 'outputs=[film.h_min_lowest]' -o /root/results | grep h_min_lowest
within sh -c 'cd /root && flankfilm new viscosity/mine >/dev/null && mkdir -p viscosity &&
    cc -std=gnu11 -O2 -fPIC -shared -fvisibility=hidden $(pkg-config --cflags flankfilm) "$(find . -name mine.c)" -o viscosity/mine.so -lm &&
    flankfilm verify viscosity/mine.so' | grep -c "^ok"
within python3 -c '
import flankfilm
run = flankfilm.Engine().run("'$seed'", {"outputs": ["film.h_min_lowest"]})
print("from Python", run["film.h_min_lowest"].data)'
within apt-get -q -y purge flankfilm libflankfilm0 libflankfilm-dev python3-flankfilm >"$lab/said"
files | diff "$lab/before" - && echo "purged without a trace: $(wc -l <"$lab/before") paths as before"
