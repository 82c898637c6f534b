#!/usr/bin/env bash
# Sets up, builds and tests.
#   scripts/test.sh               the release build, and all tests that need no sound server, no
#                                 display and no sanitizer
#   scripts/test.sh --all         also those, in real time on servers and displays of their own; the
#                                 format; clang-tidy on what changed; the address and thread sanitizers
#                                 on what changed and an eighth of the rest: what CI runs
#   scripts/test.sh --sanitizers  every test program that can run under them, under the sanitizers
# Ends with what was skipped and why, and with ctest's summary. Tests that read data too large for the
# repository look for it in $RAKS_SHARED (docs/contributing.md).
set -euo pipefail
cd "$(dirname "$0")/.."

mode=${1:-}
case "$mode" in
    ""|--all|--sanitizers) ;;
    *) echo "usage: scripts/test.sh [--all|--sanitizers]" >&2; exit 2 ;;
esac
mkdir -p build
step() { echo "== $* (${SECONDS} s)"; }

# quietly LOG COMMAND...: shows the command's output only when it fails.
quietly() {
    local log=build/$1.log
    shift
    "$@" >"$log" 2>&1 || { cat "$log"; exit 1; }
}

if [ "$mode" = --sanitizers ]; then
    scripts/setup.sh build run learn stream remote test ci
    exec scripts/sanitize.sh all
fi

lists=(build run learn test)
[ "$mode" != --all ] || lists+=(stream remote ci)
scripts/setup.sh "${lists[@]}"
if [ "$mode" = --all ]; then
    # Without the network the tests on PipeWire are skipped.
    scripts/unpack_pipewire.sh || echo "PipeWire could not be fetched; the tests that need it are skipped"
    step "format"
    git ls-files '*.cpp' '*.hpp' | xargs clang-format --dry-run -Werror
fi

step "release: build"
quietly release cmake --preset release -DRAKS_TESTS=ON -DRAKS_TRAIN=ON -DRAKS_CAPTURE=ON
cmake --build --preset release -j "$(nproc)" | { grep -vE '^\[[0-9]+/[0-9]+\] (Building|Linking)' || true; }

# run_tests LOG ARGUMENTS...: of ctest; its output is shown and kept.
run_tests() {
    local log=build/$1.log
    shift
    # Not by the preset, whose filter would take the place of these.
    ctest --test-dir build/release --output-on-failure "$@" | tee "$log"
}

failed=
step "release: tests"
# One more than there are processors: some wait for a file or a child.
run_tests tests -j "$(($(nproc) + 1))" -LE '^(soak|servers|display)$' || failed=1
logs=(build/tests.log)
cp build/release/Testing/Temporary/LastTest.log build/tests.output

if [ "$mode" = --all ]; then
    # Windows wait for each other, live tests for real time: meanwhile what no test waits for gets the
    # processors, where nothing else wants them.
    set -m  # a process group of its own, which ends as a whole
    (chrt --idle --pid 0 "$BASHPID"; scripts/tidy.sh --changed; scripts/sanitize.sh build) >build/gaps.log 2>&1 &
    gaps=$!
    set +m
    trap 'kill -- -$gaps 2>/dev/null || true' EXIT
    step "release: tests with a display"
    run_tests display -j "$(nproc)" -L '^display$' || failed=1
    cat build/release/Testing/Temporary/LastTest.log >>build/tests.output
    step "release: tests with sound servers, two at a time"
    if ! run_tests servers -j 2 -L '^servers$'; then
        # A machine that stands still says nothing about the program.
        log=build/release/Testing/Temporary/LastTest.log
        failures=$(sed -n 's/^.*\*\*\*Failed.*//; s/^\t *[0-9]* - \([^ ]*\) (.*/\1/p' build/servers.log)
        stalls=$(grep -c 'the machine stood still for .* during this test' "$log" || true)
        if [ "$stalls" -gt 0 ] && [ "$stalls" -eq "$(wc -w <<<"$failures")" ]; then
            step "again, alone, as the machine stood still: $(tr '\n' ' ' <<<"$failures")"
            run_tests servers_again --rerun-failed -j 1 || failed=1
        else
            failed=1
        fi
    fi
    cat build/release/Testing/Temporary/LastTest.log >>build/tests.output
    logs+=(build/display.log build/servers.log)

    step "what was computed in the gaps"
    wait $gaps || { cat build/gaps.log; exit 1; }  # nothing else wants the processors from here
    cat build/gaps.log
    trap - EXIT
    scripts/sanitize.sh run
fi

step "what the tests said"
# Each skip stands in the output as its line, followed by its reason, then by "Skipped" lines.
scripts/count_skips.sh build/tests.output
if [ "$mode" != --all ]; then
    echo "left out: tests with sound servers or a display, clang-format, clang-tidy, sanitizers; scripts/test.sh --all runs them"
fi
for log in "${logs[@]}"; do
    sed -n '/tests passed/p; /The following tests FAILED/,/Errors while/p' "$log"
done
[ -z "$failed" ]
