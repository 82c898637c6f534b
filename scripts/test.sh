#!/usr/bin/env bash
# Sets up, builds and tests everything: format, clang-tidy on what changed, the address and thread
# sanitizers on the parts that need them, then the release build and all its tests, one at a time
# where they need the machine for themselves. Ends with ctest's summary of the release tests.
set -euo pipefail
cd "$(dirname "$0")/.."

step() { echo "== $* (${SECONDS} s)"; }

# quietly COMMAND...: shows the command's output only when it fails.
quietly() { "$@" >build.log 2>&1 || { cat build.log; exit 1; }; }

# sanitized PRESET PROGRAM...: builds these test programs under the preset and runs their tests.
sanitized() {
    local preset=$1 names
    shift
    step "$preset: $*"
    names=$(IFS='|'; echo "$*")
    quietly cmake --preset "$preset"
    quietly cmake --build --preset "$preset" -j "$(nproc)" --target "${@/#/raks_tests_}"
    # Long computations without memory or threads of their own run in release alone.
    quietly ctest --preset "$preset" -j "$(nproc)" -L "^($names)\$" --no-tests=error \
        -E "OfflineLanding|FigureFromClips|MusicScenes|WrittenFigures|DanceChanges|RealtimeChain"
    tail -n 3 build.log
}

scripts/setup.sh
# Without the network the tests on PipeWire are skipped.
scripts/unpack_pipewire.sh || echo "PipeWire could not be fetched"

step "format"
git ls-files '*.cpp' '*.hpp' | xargs clang-format --dry-run -Werror

step "release: build"
quietly cmake --preset release
cmake --build --preset release -j "$(nproc)"

scripts/tidy.sh --changed

sanitized asan base models skeleton figures choreography training_figures audio_io audio_evaluate \
    audio_models training_files engine_files apps_plots render_video import avatar_rig fuzz
sanitized tsan base engine engine_live

step "release: tests"
ctest --preset release -j "$(nproc)"
