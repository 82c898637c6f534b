#!/usr/bin/env bash
# Two phones, no markers: a dance is filmed by two simulated phones in a room with its music, captured by
# what a person types, and laid beside the truth; then it is learnt and danced.
#   scripts/capture_two_phones.sh DANCE FOLDER [SECONDS [OPTIONS OF SIMULATE...]]
# DANCE: salsa, belly, ... as `raks dance` has it, for SECONDS (60) of a song of its own. The phones stand
# 85 degrees apart, film 60 and 30 pictures a second, and have clocks of their own. RAKS names the program.
set -euo pipefail
if [ $# -lt 2 ]; then
    sed -n '2,6s/^# *//p' "$0" >&2
    exit 2
fi
here=$(cd "$(dirname "$0")/.." && pwd)
raks=${RAKS:-$here/build/release/bin/raks}
dance=$1 folder=$2 seconds=${3:-60}
shift $(($# > 3 ? 3 : $#))
mkdir -p "$folder"

if [ ! -e "$folder/film/truth/dance.bvh" ]; then
    "$raks" synth "$dance" --duration "$seconds" --seed 1 -o "$folder/song.wav"
    "$raks" dance "$folder/song.wav" --dance "$dance" --seed 1 -o "$folder/danced.bvh"
    "$raks" capture simulate "$folder/danced.bvh" -o "$folder/film" --no-markers --no-board --cameras 2 \
        --camera-angle 85 --rate 30 --rate cam2=60 --music "$folder/song.wav" --clock-error 2 --drift 40 "$@"
fi

# What a person has: two films and the song.
mkdir -p "$folder/phones"
cp -n "$folder"/film/cam?.mp4 "$folder/song.wav" "$folder/phones/"
SECONDS=0
"$raks" capture run "$folder/phones" --markerless --height 1.714 --music "$folder/phones/song.wav" |
    tee "$folder/next.txt" || [ "${PIPESTATUS[0]}" -eq 3 ]
echo "== the whole run took $SECONDS s"
# Where in the song it begins is where in the true dance it begins.
offset=$(sed -n 's/.*--offset \(-\{0,1\}[0-9.]*\) -o .*/\1/p' "$folder/next.txt" | tail -n 1)
"$raks" capture compare "$folder/film/truth/dance.bvh" "$folder/phones/dance.bvh" --align --shift "$offset"
"$raks" stick "$folder/film/truth/dance.bvh" "$folder/phones/dance.bvh" --shift "$offset" --align rigid --side-by-side \
    -o "$folder/pair.png"
export XDG_DATA_HOME=$folder/home
"$raks" train take "$folder/phones/dance.bvh" --music "$folder/phones/song.wav" --offset "$offset" -o filmed
"$raks" dance "$folder/song.wav" --dance filmed -o "$folder/learnt.bvh"
