#!/usr/bin/env bash
# Fuzzes the readers of files, one after the other at the lowest priority, each for the same share
# of the time; builds the preset fuzz first.
#   scripts/fuzz.sh HOURS [READER...]     HOURS may be a fraction: 0.1
# What a fuzzer learns lies in build/fuzz/corpus/READER, what broke a reader in build/fuzz/finds. A
# find goes into tests/fuzz/corpus/READER together with its mending; the test of the corpus keeps it.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -ge 1 ] || { echo "usage: scripts/fuzz.sh HOURS [READER...]" >&2; exit 2; }
hours=$1
shift
cmake --preset fuzz >/dev/null
readers=("$@")
if [ ${#readers[@]} -eq 0 ]; then
    mapfile -t readers < <(ls tests/fuzz/corpus)
fi
cmake --build --preset fuzz --target "${readers[@]/#/raks_fuzz_}"
seconds=$(awk -v h="$hours" -v n="${#readers[@]}" 'BEGIN { s = int(h * 3600 / n); print (s > 0 ? s : 1) }')
mkdir -p build/fuzz/finds
status=0
for reader in "${readers[@]}"; do
    learnt=build/fuzz/corpus/$reader
    mkdir -p "$learnt"
    echo "fuzz: $reader, $seconds s" >&2
    # The shipped files that are seeds.
    mapfile -t seeds < <(awk -v row="{\"$reader\"," 'index($0, row) { on = 1 } on { print } on && /},$/ { exit }' \
        tests/fuzz/readers.cpp | { grep -o '"[a-z]*/[^"]*"' || true; } | tr -d '"')
    [ ${#seeds[@]} -eq 0 ] || cp "${seeds[@]}" "$learnt/"
    # Every seed must fit whole, with room to grow: shipped networks have megabytes.
    longest=$(find "tests/fuzz/corpus/$reader" "${seeds[@]}" -type f -printf '%s\n' |
        awk '{ if ($1 > most) most = $1 } END { most += int(most / 8); print (most > 65536 ? most : 65536) }')
    # -timeout: CPU seconds of one input; memory: far more than any file of a person needs.
    nice -n 19 "build/fuzz/tests/fuzz/raks_fuzz_$reader" "$learnt" "tests/fuzz/corpus/$reader" \
        -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2000 -max_len="$longest" \
        -artifact_prefix="build/fuzz/finds/$reader-" -print_final_stats=1 -verbosity=1 \
        2>"build/fuzz/$reader.log" || { status=1; echo "fuzz: $reader broke, see build/fuzz/$reader.log" >&2; }
    grep -h "stat::number_of_executed_units" "build/fuzz/$reader.log" >&2 || true
done
exit "$status"
