#!/usr/bin/env bash
# scripts/dance.sh and scripts/build.sh refuse what cannot work before they install or build anything.
set -euo pipefail
scripts=$(cd "$(dirname "$0")/../../scripts" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

# expect_refusal CODE WORDS COMMAND...: ends with the code, and with one line that has the words.
expect_refusal() {
    local code=$1 words=$2 got=0
    shift 2
    "$@" >"$work/said" 2>&1 || got=$?
    if [ "$got" -ne "$code" ] || [ "$(wc -l <"$work/said")" -ne 1 ] || ! grep -qF -- "$words" "$work/said"; then
        echo "FAILED: $* ended with $got and said: $(cat "$work/said")" >&2
        failures=$((failures + 1))
    fi
}

# A copy, so that a fault of the scripts builds nothing here; a path with spaces is one as well.
mkdir -p "$work/a tree"
cp -r "$scripts" "$work/a tree/scripts"
cd "$work"
expect_refusal 2 "nosuch.mp3: is not a file that can be read" "a tree/scripts/dance.sh" nosuch.mp3
expect_refusal 2 "is not a file that can be read" "a tree/scripts/dance.sh" "$work"
expect_refusal 2 "usage: scripts/build.sh" "a tree/scripts/build.sh" everything
expect_refusal 2 "usage: scripts/test.sh" "a tree/scripts/test.sh" --most
[ ! -e "a tree/build" ] || { echo "FAILED: something was built" >&2; failures=$((failures + 1)); }

# What was skipped is counted by its reason.
printf '%s\n' 'x_test.cpp:12: Skipped' 'no clips in /a/b' '' '[  SKIPPED ] Clips.one (0 ms)' \
    'y_test.cpp:3: Skipped' 'strace is not there' '' '[  SKIPPED ] Disks.two (1 ms)' \
    'x_test.cpp:12: Skipped' 'no pictures in ../shared' '' '[  SKIPPED ] Clips.three (0 ms)' >"$work/log"
counted=$("$scripts/count_skips.sh" "$work/log")
for words in "skipped: 3" "2: data that is not in the repository" "1: strace is not there"; do
    [[ "$counted" == *"$words"* ]] || { echo "FAILED: $counted" >&2; failures=$((failures + 1)); }
done
[ "$failures" -eq 0 ]
