#!/usr/bin/env bash
# Sets up, builds and dances: scripts/dance.sh [FILE]. Without FILE to a salsa that Raks makes
# itself. Without a display or a loudspeaker it writes a short video with sound and says where.
set -euo pipefail
caller=$PWD
file=()
if [ $# -gt 0 ]; then
    if [ ! -r "$1" ] || [ -d "$1" ]; then
        echo "dance: $1: is not a file that can be read; name a sound file, or none for music that Raks makes" >&2
        exit 2
    fi
    file=("$(realpath -- "$1")")
fi
cd "$(dirname "$0")/.."

scripts/build.sh
raks=$PWD/build/release/bin/raks
echo "the program is $raks; to install it: cmake --install \"$PWD/build/release\" --prefix ~/.local" >&2

if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] && "$raks" devices --has-output; then
    exec "$raks" play "${file[@]}"
fi
# Our own song is past its opening there.
start=0
[ ${#file[@]} -gt 0 ] || start=20
out=$caller/raks-dance.mp4
echo "no display or no loudspeaker here: filming 10 seconds of a couple" >&2
"$raks" render "${file[@]}" -o "$out" --start "$start" --duration 10 --formation couple \
    --theme studio_light --fps 30 --quality fast
echo "the dance is in $out"
