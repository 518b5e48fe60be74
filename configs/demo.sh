#!/bin/sh
# Installs what is missing, builds flankfilm and runs the gear pair of Li & Kahraman 2011 under
# quasi-static and dynamic load.
#   sh configs/demo.sh [OPTION OF flankfilm run]...
set -eu
cd "$(dirname "$0")/.."

# what a step says is shown to who watches, or when it fails
step() {
    if [ -t 1 ]; then
        "$@"
    else
        said=$("$@" 2>&1) || {
            printf '%s\n' "$said"
            exit 1
        }
    fi
}

sh configs/need.sh
[ -f build/build.ninja ] || step meson setup build
echo "Building the program and its models, which takes one core some two minutes the first time"
# shellcheck disable=SC2046
step ninja -C build flankfilm $(ninja -C build -t targets all | sed -n 's/^\(plugins\/.*\.so\): .*/\1/p')

said=$(build/flankfilm run configs/li-kahraman-2011.yaml "$@")
results=$(printf '%s\n' "$said" | sed -n 's/^results in //p')
cat <<END
$said

Next:
  build/flankfilm report $results           # its figures, as one page
  build/flankfilm explain configs/li-kahraman-2011.yaml    # what ran, and why
  build/flankfilm models                                   # what can be swapped
  sh tests/run.sh                                          # every test
END
