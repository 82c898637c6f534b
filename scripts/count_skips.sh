#!/usr/bin/env bash
# Counts the tests that were skipped, by their reason, in one line.
#   scripts/count_skips.sh LOG    LOG: what the tests printed (ctest's LastTest.log)
set -euo pipefail
# GoogleTest prints "FILE:LINE: Skipped", the reason, an empty line, and the test's last line.
awk '
    /: Skipped$/ { getline reason; next }
    /^\[  SKIPPED \] .* \([0-9]+ ms\)$/ {
        if (reason ~ /shared|no clip|no capture|no sample|no table|no picture|no film|no rig|no hostile/)
            reason = "data that is not in the repository (RAKS_SHARED)"
        sub(/^skipped: /, "", reason)
        count[reason]++; all++
    }
    END {
        line = "skipped: " all + 0
        for (reason in count) line = line "; " count[reason] ": " reason
        print line
    }' "$1"
