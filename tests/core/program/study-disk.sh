#!/bin/sh
# A study on a disk that fills up, that is read-only, or that belongs to somebody else: a clear
# sentence, and nothing that was finished is lost.   study-disk.sh FLANKFILM TOYS...
# In a mount namespace of its own; where the system allows none, the test says so and does not count.
set -eu
if [ "${STUDY_DISK:-}" = "" ]; then
    for option in -m -rm; do
        if unshare $option true 2>/dev/null; then
            STUDY_DISK=$option exec unshare $option sh "$0" "$@"
        fi
    done
    echo "needs a system that lets it make a mount namespace"
    exit 77
fi
flankfilm=$(realpath "$1")
shift
lab=$(mktemp -d)
trap 'umount "$lab/disk" 2>/dev/null || true; rm -rf "$lab"' EXIT
chmod 755 "$lab"
mkdir -p "$lab/plugins/toy" "$lab/disk"
for toy; do
    cp "$toy" "$lab/plugins/toy/${toy##*/cli-toy-}"
done
cp "$flankfilm" "${flankfilm%/*}/libflankfilm.so.0" "$lab"
cd "$lab"
export FLANKFILM_PLUGIN_PATH="$lab/plugins"
cat >study.yaml <<YAML
format: 2
pipeline:
  wave: {use: toy/wave, amplitude: 2 mm}
  walk: {use: toy/walk}
outputs: [wave.total, walk.place]
study: {sweep: {wave.count: {from: 1, to: 80, points: 80}, walk.step: {from: 1 m, to: 2 m, points: 2, follow: up}}}
YAML

# expect CODE WORDS COMMAND...: the program ends so and says so
expect() {
    code=$1 words=$2
    shift 2
    got=0
    "$@" >out 2>err || got=$?
    if [ "$got" -ne "$code" ] || ! grep -qF -e "$words" out err; then
        echo "expected $code and \"$words\" of: $*; it was $got"
        cat out err
        exit 1
    fi
}

# the journal does not fit
./flankfilm run study.yaml -j 2 -o roomy >out
mount -t tmpfs -o size=32k tmpfs disk
expect 1 "the journal could not be written: No space left on device" \
    ./flankfilm run study.yaml -j 2 -o disk/full
before=$(wc -l <disk/full/journal.jsonl)
[ "$before" -gt 0 ]
[ "$before" -lt 160 ]
expect 0 "to run" ./flankfilm plan study.yaml -o disk/full
mount -o remount,size=64m disk
expect 0 "160 of 160 cases done, $before of them earlier" \
    ./flankfilm run study.yaml -j 2 -o disk/full
cmp roomy/table.csv disk/full/table.csv

# the arrays of the cases do not fit
expect 0 "160 of 160" ./flankfilm run study.yaml --set outputs=wave.field -o fields
umount disk
mount -t tmpfs -o size=200k tmpfs disk
expect 1 "No space left on device" \
    ./flankfilm run study.yaml --set outputs=wave.field -o disk/fields
mount -o remount,size=64m disk
expect 0 "160 of 160 cases done" ./flankfilm run study.yaml --set outputs=wave.field -o disk/fields
cmp fields/table.csv disk/fields/table.csv
./flankfilm export fields --to csv -o fields-csv
./flankfilm export disk/fields --to csv -o disk-csv
cmp fields-csv/wave-t-x.csv disk-csv/wave-t-x.csv

# the disk is read-only
mount -o remount,ro disk
expect 2 "cannot be used: Read-only file system" ./flankfilm run study.yaml -o disk/new
expect 2 "cannot be used: Read-only file system" \
    ./flankfilm run study.yaml --set outputs=wave.field -o disk/fields --rerun all
expect 0 "160 done" ./flankfilm plan study.yaml --set outputs=wave.field -o disk/fields

# the directory is somebody else's: even root is nobody there
mkdir locked
chmod 555 locked
if [ "$STUDY_DISK" = -m ]; then
    expect 2 "cannot be used: Permission denied" \
        setpriv --reuid=65534 --regid=65534 --clear-groups ./flankfilm run study.yaml -o locked
else
    umount disk # root of this namespace is a user outside: its own directory obeys no mode
    echo "a locked directory was not tried, for want of another user"
fi
