#!/usr/bin/env bash
# Test programs under the address (and undefined-behaviour) and the thread sanitizer.
#   scripts/sanitize.sh all      builds and runs every one
#   scripts/sanitize.sh build    builds those whose sources changed since the main branch, and of the
#                                others every eighth, another eighth with each commit
#   scripts/sanitize.sh run      runs the same
# What a program tests stands in build/release/test_files.txt, which configuring writes.
set -euo pipefail
cd "$(dirname "$0")/.."

# Those that neither start the program raks nor need a server or a display.
asan=(base motion capture audio audio_io avatar render training_figures engine_files engine_show apps
    fuzz)
# Those with threads.
tsan=(base engine engine_live engine_outputs)

# What is not ours.
export TSAN_OPTIONS="suppressions=$PWD/scripts/tsan_suppressions.txt${TSAN_OPTIONS:+ $TSAN_OPTIONS}"

what=${1:?usage: scripts/sanitize.sh all|build|run}
commits=$(git rev-list --count HEAD)
# A header counts as the source of its name.
changed=$(scripts/changed_files.sh | sed 's/\.hpp$/.cpp/')

# is_changed PROGRAM: one of the files that it tests, or of its own, has changed.
is_changed() {
    local files
    files=$(sed -n "s/^$1 //p" build/release/test_files.txt | tr ' ' '\n')
    [ -n "$(comm -12 <(sort <<<"$files") <(sort <<<"$changed"))" ]
}

# chosen PRESET: of its programs, those that are to run.
chosen() {
    local -n programs=$1
    local i
    for i in "${!programs[@]}"; do
        if [ "$what" = all ] || [ $(((i + commits) % 8)) -eq 0 ] || is_changed "${programs[$i]}"; then
            echo "${programs[$i]}"
        fi
    done
}

for preset in asan tsan; do
    mapfile -t names < <(chosen "$preset")
    [ ${#names[@]} -gt 0 ] || continue
    if [ "$what" != run ]; then
        echo "== $preset: build ${names[*]} ($SECONDS s)"
        cmake --preset "$preset" >"build/$preset.log" 2>&1 &&
            cmake --build --preset "$preset" -j "$(nproc)" --target "${names[@]/#/raks_tests_}" \
                >>"build/$preset.log" 2>&1 || { cat "build/$preset.log"; exit 1; }
    fi
    if [ "$what" != build ]; then
        echo "== $preset: ${names[*]} ($SECONDS s)"
        # Long computations without memory or threads of their own run in release alone, and so does what
        # compares with another program or a cage.
        ctest --preset "$preset" -j "$(nproc)" -L "^($(IFS='|'; echo "${names[*]}"))\$" --no-tests=error \
            -E "OfflineLanding|FigureFromClips|MusicScenes|WrittenFigures|DanceChanges|RealtimeChain|SoundZoo|Unpacking" \
            >"build/$preset.log" 2>&1 || { cat "build/$preset.log"; exit 1; }
        tail -n 3 "build/$preset.log"
    fi
done
