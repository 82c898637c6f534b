#!/usr/bin/env bash
# Sets up, builds and dances: scripts/dance.sh [FILE]. Without FILE to a salsa that Raks makes
# itself. Without a display or a loudspeaker it writes a short video with sound and says where.
set -euo pipefail
caller=$PWD
cd "$(dirname "$0")/.."

scripts/setup.sh
log=build/dance.log
mkdir -p build
echo "building (log in $log)" >&2
{ cmake --preset release -DRAKS_TESTS=OFF >"$log" 2>&1; } || { tail -n 20 "$log" >&2; exit 1; }
# One line of progress: ninja's [12/345], rewritten in place on a terminal.
if [ -t 2 ]; then
    cmake --build --preset release --target raks 2>&1 | tee -a "$log" |
        while IFS= read -r line; do
            case "$line" in "["*) printf '\r\033[K%.100s' "$line" >&2 ;; esac
        done
    printf '\r\033[K' >&2
else
    cmake --build --preset release --target raks >>"$log" 2>&1 || true
fi
raks=build/release/bin/raks
[ -x $raks ] && cmake --build --preset release --target raks >>"$log" 2>&1 ||
    { tail -n 20 "$log" >&2; exit 1; }

file=()
if [ $# -gt 0 ]; then
    file=("$(cd "$caller" && realpath -- "$1")")
fi
if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] && $raks devices --has-output; then
    exec $raks play "${file[@]}"
fi
out=$caller/raks-dance.mp4
echo "no display or no loudspeaker here: writing a video of 20 seconds" >&2
$raks render "${file[@]}" -o "$out" --duration 20
echo "the dance is in $out"
