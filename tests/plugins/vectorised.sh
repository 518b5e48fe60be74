#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every loop that FF_SIMD promises to vectorise is a loop of packed arithmetic.   vectorised.sh OBJECT=FUNCTIONS...
# OBJECT is disassembled, and has at least so many functions compiled for AVX2.
set -eu
failed=0
for pair; do
    object=${pair%=*} least=${pair##*=}
    objdump -d --no-show-raw-insn "$object" | awk -v object="$object" -v least="$least" '
        /^[0-9a-f]+ <.*\.avx2(\.[a-z0-9.]*)?>:$/ { on = 1; name = ++count " " $2; packed[name] = 0; next }
        /^$/ { on = 0 }
        on && /ymm/ { packed[name]++ }
        END {
            for (f in packed) {
                print object ": " f " " packed[f] " packed instructions"
                bad += packed[f] < 3
            }
            if (count < least) print "FAIL " object ": " count + 0 " functions for AVX2, not " least
            if (bad) print "FAIL " object ": " bad " are not vectorised"
            exit bad > 0 || count < least
        }' || failed=1
done
exit $failed
