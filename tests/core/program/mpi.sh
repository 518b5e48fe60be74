#!/bin/bash
# A study on the ranks of an MPI job: its results are those of -j, whatever its cases do to their
# processes; it goes on after an interruption, takes shards, and gives work to every rank.
#   mpi.sh FLANKFILM PLUGINS TOYS...
set -eu
flankfilm=$(realpath "$1")
plugins=$(realpath "$2")
shift 2
for need in "$(type -P mpirun)" "$plugins/executor/mpi.so"; do
    [ -e "$need" ] || { echo "needs Open MPI" && exit 77; }
done
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
mkdir -p "$lab/plugins/toy"
for toy; do
    name=${toy##*/cli-toy-}
    ln -s "$(realpath "$toy")" "$lab/plugins/toy/$name"
done
cd "$lab"
export FLANKFILM_PLUGIN_PATH="$lab/plugins:$plugins"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_oob_tcp_if_include=lo
export OMPI_MCA_btl=self,vader OMPI_MCA_btl_vader_single_copy_mechanism=none
export ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=0" # Open MPI does not give back all it has taken
export OMPI_MCA_orte_abort_print_stack=0

cat >study.yaml <<YAML
format: 2
pipeline:
  wave: {use: toy/wave, amplitude: 2 mm, work: 60 ms}
  sum: {use: toy/sum, wave: wave}
outputs: [sum.sum, wave.height]
study:
  sweep:
    wave.amplitude: {from: 1 mm, to: 4 mm, points: 12}
    wave.end: [good, crash, quit, fail]
YAML

# expect CODE COMMAND...
expect() {
    local wanted=$1 code=0
    shift
    "$@" >said 2>&1 || code=$?
    if [ $code -ne "$wanted" ]; then
        echo "exit code $code, not $wanted: $*"
        cat said
        exit 1
    fi
}
farm() { expect "$1" timeout 60 mpirun -n 4 "$flankfilm" run "${@:2}" --executor mpi; }
same() {
    cmp here/table.csv "$1/table.csv"
    expect 0 "$flankfilm" export "$1" --to csv -o "$1-csv"
    cmp here-csv/wave-t.csv "$1-csv/wave-t.csv"
}

expect 4 "$flankfilm" run study.yaml -j 8 -o here
expect 0 "$flankfilm" export here --to csv -o here-csv
farm 4 study.yaml -o farm
grep -q '^48 of 48 cases done: 12 good, 36 failed' said
same farm
[ "$(ls farm/journal*)" = farm/journal.jsonl ]
echo "four ranks: 24 of 48 cases ended their process, results as with -j"

farm 4 study.yaml -o farm
grep -q '^48 of 48 cases done, 48 of them earlier: 12 good, 36 failed' said
expect 4 "$flankfilm" run study.yaml -j 1 -o farm
grep -q '^48 of 48 cases done, 48 of them earlier: 12 good, 36 failed' said
echo "one journal for both"

mpirun -n 4 "$flankfilm" run study.yaml -o broken --executor mpi >/dev/null 2>&1 &
job=$!
for _ in $(seq 600); do
    [ "$(cat broken/journal.jsonl 2>/dev/null | wc -l)" -lt 5 ] || break
    sleep 0.01
done
kill -9 $(cat /proc/$job/task/*/children) || true
wait $job || true
before=$(wc -l <broken/journal.jsonl)
echo "all ranks were killed after $before cases"
[ "$before" -lt 48 ]
farm 4 study.yaml -o broken
same broken

farm 4 study.yaml -o parts --shard 2/2
grep -q '^24 of 24 cases done' said
farm 4 study.yaml -o parts --shard 1/2
same parts
expect 4 "$flankfilm" run study.yaml -j 4 -o alone --executor mpi
same alone
echo "in shards, and without mpirun"

# A chain is handed out as a whole.
cat >chains.yaml <<YAML
format: 2
pipeline:
  walk: {use: toy/walk}
outputs: [walk.place]
study:
  sweep:
    walk.foot: [1, 2, 3]
    walk.step: {from: 1 m, to: 5 m, points: 5, follow: both}
YAML
expect 0 "$flankfilm" run chains.yaml -j 1 -o chains-here
farm 0 chains.yaml -o chains-farm
grep -q '^30 of 30 cases done: ' said
cmp chains-here/table.csv chains-farm/table.csv
echo "six chains"

# Every rank has another table of points, and four cases are one for each.
rank() { echo "$flankfilm run four.yaml -o four --executor mpi --set wave.count=$1"; }
sed 's/points: 12/points: 4/; /wave.end/d' study.yaml >four.yaml
expect 0 timeout 60 mpirun -n 1 $(rank 2) : -n 1 $(rank 3) : -n 1 $(rank 4) : -n 1 $(rank 5)
[ "$(ls four/arrays.farm-*.log | wc -l)" -eq 4 ] # one for each
expect 0 "$flankfilm" export four --to csv -o four-csv
[ "$(sed 1d four-csv/wave-t.csv | wc -l)" -eq 14 ] # 2 + 3 + 4 + 5 rows
[ "$(wc -l <four/journal.jsonl)" -eq 4 ]
echo "each rank has worked"

expect 2 "$flankfilm" run study.yaml -o plugins --executor mpi
grep -q 'not results of a study' said
expect 2 "$flankfilm" run study.yaml --executor smoke-signals
grep -q 'there is no model "executor/smoke-signals"' said
expect 2 "$flankfilm" run study.yaml --set study= --executor mpi
grep -q 'has no study' said
echo "and says what it cannot do"
