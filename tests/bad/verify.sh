#!/bin/sh
# `flankfilm verify` finds the one fault of each plugin, in the test and for the reason that
# faults.txt names.   verify.sh FLANKFILM PLUGIN_DIRECTORY FAULTS_TXT [watched]
# A program that sanitizers watch over has no count of its memory, and takes three times as long: there
# one fault of each test is tried, which runs the same code of the program.
set -u
flankfilm=$1 plugins=$2 faults=$3 watched=${4:-}
# what a list of wrong models is about: the check that finds each
only() {
    case $faults in *wrong.txt) [ "$test" = - ] && echo "--only $reason" || echo "--only $test" ;; esac
}
failed=0 seen=0 tests=' '
# a crash is to look like one under AddressSanitizer, too; tests verify-* look for leaks
export ASAN_OPTIONS="${ASAN_OPTIONS:-}:handle_segv=0:detect_leaks=0"
last=
while read -r fault test reason; do
    [ "$fault" != '#' ] || continue
    reason=${reason%%[ ]#*}
    reason=${reason%"${reason##*[! ]}"}
    if [ -n "$watched" ]; then
        [ "$fault" != viscosity/leak ] || continue
        case $tests in *" $test "*) continue ;; esac
        tests="$tests$test "
    fi
    seen=$((seen + 1)) last=$fault
    said=$(FLANKFILM_VERIFY_LIMIT=$([ "$fault" = viscosity/hang ] && echo 0.5 || echo 30) \
        "$flankfilm" verify "$plugins/$fault.so" $(only))
    code=$?
    first=$(printf '%s\n' "$said" | sed -n '/^not ok/ { s/^not ok [0-9]* - //; s/:.*//; p; q; }')
    why=$(printf '%s\n' "$said" | sed -n '/^# faulty: / { s///; p; q; }')
    if [ "$test" = all ]; then
        # memory cannot be counted under a sanitizer
        [ $code -eq 0 ] && ! printf '%s\n' "$said" | grep '^# untried' |
            grep -v 'the allocator of this program does not count' && continue
    elif [ "$test" = - ]; then
        [ $code -eq 0 ] && [ -z "$first" ] && continue
    elif [ $code -eq 3 ] && [ "$first" = "$test" ]; then
        case $why in *"$reason"*) continue ;; esac
    fi
    echo "$fault: wanted \"$test\" to fail with \"$reason\"; exit code $code, \"$first\": $why"
    failed=$((failed + 1))
done <"$faults"
# a test that is not there is named, also beside one that is
said=$("$flankfilm" verify "$plugins/$last.so" --only "descriptor, nonsense,blather" 2>&1) && failed=$((failed + 1))
case $said in *'has no test "nonsense"'*'has no test "blather"'*) ;; *) failed=$((failed + 1)) && printf '%s\n' "$said" ;; esac
echo "$failed of $seen faults were not found, or not for their reason"
[ $failed -eq 0 ] && [ $seen -gt 0 ]
