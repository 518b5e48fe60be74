#!/bin/bash
# Runs a test and says how many seconds of CPU time it and its children took: of the user, of the system.
#   cpu.sh COMMAND...
TIMEFORMAT='cpu %U %S'
time "$@"
