#!/usr/bin/env bash
# Holds the audio and the motion thread to their rules: compiles what runs on them with clang 22, for
# which a call that is not known to keep the rules is an error, and runs it under RealtimeSanitizer.
#   scripts/rtsan.sh
# Builds no more than these tests need, in build/rtsan. scripts/setup.sh rtsan installs the compiler.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -eq 0 ] || { echo "usage: scripts/rtsan.sh" >&2; exit 2; }
scripts/setup.sh build run test rtsan
# For names and lines in what it finds.
export RTSAN_SYMBOLIZER_PATH=${RTSAN_SYMBOLIZER_PATH:-$(command -v llvm-symbolizer-14)}
cmake --preset rtsan >/dev/null
cmake --build --preset rtsan -j "$(nproc)" \
    --target raks_tests_engine_live raks_tests_audio_devices raks_tests_audio_io
ctest --preset rtsan -j "$(nproc)" --no-tests=error \
    -R '^(CallbackGate|ClockLine|CountedBlocks|DeviceStream|FilePlayer|GraphOnItsOwnClock|LiveInput|MotionStage|Playback|RealtimeChain|ReplacedDancers)'
