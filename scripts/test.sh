#!/usr/bin/env bash
# Sets up, builds and tests everything: format, the release build and all its tests, one at a time
# where they need the machine for themselves, clang-tidy on what changed, the address and thread
# sanitizers on the parts that need them. Many tests wait for real time: meanwhile clang-tidy and the
# builds under sanitizers get the processors, where nothing else wants them. Ends with ctest's summary
# of the release tests.
set -euo pipefail
cd "$(dirname "$0")/.."

asan=(base models skeleton formats figures choreography training_figures audio_io audio_evaluate
    audio_models training_files engine_files apps_plots render_video import avatar_rig fuzz)
tsan=(base engine engine_live)

step() { echo "== $* (${SECONDS} s)"; }

# quietly LOG COMMAND...: shows the command's output only when it fails.
quietly() {
    local log=build/$1.log
    shift
    "$@" >"$log" 2>&1 || { cat "$log"; exit 1; }
}

# build_programs PRESET PROGRAM...: these test programs under a sanitizer.
build_programs() {
    local preset=$1
    shift
    step "$preset: build"
    quietly "$preset" cmake --preset "$preset"
    quietly "$preset" cmake --build --preset "$preset" -j "$(nproc)" --target "${@/#/raks_tests_}"
}

# test_programs PRESET PROGRAM...: runs their tests.
test_programs() {
    local preset=$1 names
    shift
    step "$preset: $*"
    names=$(IFS='|'; echo "$*")
    # Long computations without memory or threads of their own run in release alone.
    quietly "$preset" ctest --preset "$preset" -j "$(nproc)" -L "^($names)\$" --no-tests=error \
        -E "OfflineLanding|FigureFromClips|MusicScenes|WrittenFigures|DanceChanges|RealtimeChain"
    tail -n 3 "build/$preset.log"
}

# What no test waits for, where nothing else wants the processors.
compute_in_gaps() {
    chrt --idle --pid 0 "$BASHPID"
    build_programs asan "${asan[@]}"
    build_programs tsan "${tsan[@]}"
    step "clang-tidy"
    scripts/tidy.sh --changed
}

scripts/setup.sh
# Without the network the tests on PipeWire are skipped.
scripts/unpack_pipewire.sh || echo "PipeWire could not be fetched"

step "format"
git ls-files '*.cpp' '*.hpp' | xargs clang-format --dry-run -Werror

step "release: build"
mkdir -p build
quietly release cmake --preset release
cmake --build --preset release -j "$(nproc)"

set -m  # a process group of its own, which ends as a whole
compute_in_gaps >build/gaps.log 2>&1 &
gaps=$!
set +m
trap 'kill -- -$gaps 2>/dev/null || true' EXIT

step "release: tests"
ctest --preset release -j "$(nproc)" | tee build/tests.log

step "what was computed in the gaps"
# Nothing else wants the processors from here.
wait $gaps || { cat build/gaps.log; exit 1; }
cat build/gaps.log
trap - EXIT

test_programs asan "${asan[@]}"
test_programs tsan "${tsan[@]}"

step "release: what the tests said"
sed -n '/tests passed/,$p' build/tests.log
