#!/usr/bin/env bash
# Draws a strip of each dance: two bars to Raks' own music, seen from the front, 12 pictures a bar, one
# bar a row. Needs ffmpeg. About two CPU-minutes. docs/pictures/strips was written by it.
# Usage: scripts/dance_strips.sh FOLDER [dance ...]
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
raks=${RAKS:-$root/build/release/bin/raks}
out=${1:?usage: scripts/dance_strips.sh FOLDER [dance ...]}
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"
if [ $# = 0 ]; then
    mapfile -t shipped < <(sed -n 's/^name = "\(.*\)"/\1/p' "$root/models/trained/dances.toml")
    set -- "${shipped[@]}"
fi
for name in "$@"; do
    "$raks" synth "$name" --duration 22 -o "$work/song.wav" --beats "$work/song.beats"
    # The first bar line after 12 s, and the length of a bar: time and place in the bar by line.
    read -r from bar < <(awk '$2 == 1 && $1 >= 12 { if (from) { print from, $1 - from; exit } from = $1 }' \
        "$work/song.beats")
    fps=$(awk -v bar="$bar" 'BEGIN { printf "%.4f", 12 / bar }')
    "$raks" render "$work/song.wav" -o "$work/$name.mp4" --dance "$name" --seed "${SEED:-1}" --fps "$fps" \
        --camera front --theme studio_light --size 360x400 --duration 19 --quality fast --quiet
    ffmpeg -v error -y -ss "$from" -i "$work/$name.mp4" -frames:v 1 -vf \
        "crop=300:392,scale=115:150,tile=12x2,split[a][b];[a]palettegen=max_colors=48[p];[b][p]paletteuse=dither=none" \
        "$out/$name.png"
done
