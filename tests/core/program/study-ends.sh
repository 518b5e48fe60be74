#!/bin/sh
# How a study ends whose cases do not end by themselves: a second signal ends it at once, a limit of
# the address space with a sentence, and processes that a plugin has started do not outlive it.
#   study-ends.sh FLANKFILM SANITIZED TOYS...
set -eu
flankfilm=$(realpath "$1") sanitized=$2
shift 2
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
mkdir -p "$lab/plugins/toy"
for toy; do
    name=${toy##*/cli-toy-}
    ln -s "$(realpath "$toy")" "$lab/plugins/toy/$name"
done
cd "$lab"
export FLANKFILM_PLUGIN_PATH="$lab/plugins"
is_gone() { # PID: it has ended, or waits for its parent to notice
    state=$(sed -n 's/^State:\t\(.\).*/\1/p' "/proc/$1/status" 2>/dev/null || true)
    [ -z "$state" ] || [ "$state" = Z ]
}
wait_for() { # FILE
    tries=200
    while [ ! -s "$1" ] && [ "$tries" -gt 0 ]; do
        sleep 0.05
        tries=$((tries - 1))
    done
    [ -s "$1" ]
}
ends() { # PID: within two seconds
    tries=40
    while ! is_gone "$1" && [ "$tries" -gt 0 ]; do
        sleep 0.05
        tries=$((tries - 1))
    done
    is_gone "$1" || { echo "process $1 goes on"; kill -9 "$1"; exit 1; }
}

write_study() { # NAME PARAMETERS LIMIT
    cat >"$1.yaml" <<YAML
format: 2
pipeline: {wave: {use: toy/wave, amplitude: 2 mm, $2}}
outputs: [wave.total]
study: {sweep: {wave.amplitude: [1 mm]}$3}
YAML
}

# a parent that ignores the ends of its children hands that on: the exit code is told all the same
code=0
env --ignore-signal=CHLD "$flankfilm" check absent.yaml >said 2>&1 || code=$?
[ "$code" -eq 2 ] || { echo "with SIGCHLD ignored a file that is not there ends with $code"; cat said; exit 1; }

# a case that takes a minute, and has started a process
write_study long 'work: 60 s, end: spawn' ''
"$flankfilm" run long.yaml -o long -j1 >said 2>&1 &
run=$!
wait_for child
child=$(cat child)
if is_gone "$child"; then exit 1; fi
kill -TERM "$run"
sleep 0.5
if is_gone "$run"; then echo 'the first signal ends it'; exit 1; fi
kill -TERM "$run"
ends "$run"
ends "$child"
grep -q 'press again to end at once' said
code=0
wait "$run" || code=$?
[ "$code" -eq 143 ]
rm child

# a single case, done in a child of the process that is started: signals end both, and so does the end of the first
cat >single.yaml <<YAML
format: 2
pipeline: {wave: {use: toy/wave, amplitude: 2 mm, work: 60 s, end: spawn}}
outputs: [wave.total]
YAML
for signal in 15 9; do
    "$flankfilm" run single.yaml -o single >said 2>&1 &
    run=$!
    wait_for child
    kill "$(cat child)"
    rm child
    worker=$(cat "/proc/$run/task/$run/children")
    [ "$(echo "$worker" | wc -w)" -eq 1 ]
    worker=${worker% }
    kill -"$signal" "$run"
    code=0
    wait "$run" || code=$?
    [ "$code" -eq $((128 + signal)) ]
    ends "$worker"
done
[ ! -s said ]

# likewise at the limit of a case, and at its end
for how in 'work: 60 s/, time_limit: 1 s' 'work: 0 s/'; do
    write_study limit "${how%%/*}, end: spawn" "${how#*/}"
    "$flankfilm" run limit.yaml -o "limit-${#how}" -j1 >said 2>&1 || true
    ends "$(cat child)"
    rm child
done

# a limit below what the program itself takes would fail every case
write_study little 'work: 0 s' ', memory_limit: 8'
code=0
"$flankfilm" run little.yaml -o little >said 2>&1 || code=$?
[ "$code" -eq 2 ]
grep -q '^little.yaml:4:.*expected a number of MiB for each worker, 16 at least' said

# its directory removed while it runs
write_study removed 'work: 1 s' ''
"$flankfilm" run removed.yaml -o removed -j1 >said 2>&1 &
run=$!
wait_for removed/study.json
until rm -r removed; do :; done # a file may come between its listing and its end
code=0
wait "$run" || code=$?
[ "$code" -eq 1 ]
grep -q 'journal.jsonl" was removed with its directory while the study ran' said

# what a killed run had begun to write is gone after the next one, and a missing example is named
touch limit-10/study.json.7.part limit-10/table.csv.12345.part limit-10/own.part
"$flankfilm" run limit.yaml -o limit-10 -j1 >said 2>&1
[ "$(cd limit-10 && ls | grep part)" = own.part ]
# a build outside of the sources knows no examples
if [ -d "${flankfilm%/*}/../configs" ]; then
    printf 'format: 2\ninclude: [../gears/unity-50.yaml]\npipeline: {}\n' >copied.yaml
    if "$flankfilm" check copied.yaml >said 2>&1; then exit 1; fi
    grep -qF 'hint: to include the example, write "gears/unity-50.yaml"' said
fi

[ "$sanitized" = none ] || exit 0 # a sanitizer needs all of the address space
cat >alone.yaml <<YAML
format: 2
pipeline: {wave: {use: toy/wave, amplitude: 2 mm, end: starve}}
outputs: [wave.total]
YAML
says='wave: out of memory: a library that the plugin .*toy/wave.so calls cannot get 134217728 MiB'
code=0
(ulimit -v 2000000 && exec timeout 20 "$flankfilm" run alone.yaml -o alone --json >answer 2>said) || code=$?
[ "$code" -eq 1 ]
grep -q "^error: $says" said
grep -q '"exit": *1,.*"message":"wave: out of memory' answer
write_study starve 'end: starve' ', memory_limit: 300'
code=0
timeout 20 "$flankfilm" run starve.yaml -o starve -j1 >said 2>&1 || code=$?
[ "$code" -eq 4 ]
grep -q "$says; the address space of the process is limited to [0-9]* MiB" starve/table.csv
