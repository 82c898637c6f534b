#!/usr/bin/env bash
# Counts in how many drawn captures the board on the floor is found: 3, 4, 6 and 8 cameras, five seeds each,
# films of 1280 x 720 and a board of 96 x 72 cm, drawn as drafts. Several hours of a core.
#   scripts/capture_floors.sh CLIP OUTPUT_FOLDER [CAMERAS ...]    RAKS names the program.
set -euo pipefail
if [ $# -lt 2 ]; then
    sed -n '2,5s/^# *//p' "$0" >&2
    exit 2
fi
here=$(cd "$(dirname "$0")/.." && pwd)
raks=${RAKS:-$here/build/release/bin/raks}
clip=$1 output=$2
shift 2
[ $# -gt 0 ] || set -- 3 4 6 8
mkdir -p "$output"
found=0 all=0
for cameras in "$@"; do
    for seed in 1 2 3 4 5; do
        folder=$output/$cameras-$seed
        if [ ! -e "$folder.txt" ]; then
            rm -rf "$folder"
            "$raks" capture simulate "$clip" -o "$folder" --draft --fps 60 --scale 1.267 --duration 1 --rate 10 \
                --cameras "$cameras" --seed "$seed"
            "$raks" capture calibrate "$folder" > "$folder.txt" 2>&1 || echo "failed" >> "$folder.txt"
            rm -f "$folder"/*_board.mp4
        fi
        all=$((all + 1))
        if grep -q "no floor\|failed" "$folder.txt"; then
            grep "no floor\|a square of\|failed" "$folder.txt" | sed "s/^/$cameras cameras, seed $seed: /"
        else
            found=$((found + 1))
        fi
    done
done
echo "floor found in $found of $all"
