#!/usr/bin/env bash
# Trains the beat network once more for each class of annotated music, without the families of
# training music that are like it, and prints both tables: as shipped, and each class heard by the
# network that never met it. Hours of CPU; what lies in FOLDER already is kept.
#   scripts/leave_class_out.sh EXCERPTS MIDI_PACK SOUNDFONT FOLDER [options of `raks train beats`]
set -euo pipefail
if [ $# -lt 4 ]; then
    sed -n 's/^#  *\(scripts.*\)/usage: \1/p' "$0" >&2
    exit 2
fi
excerpts=$1 pack=$2 soundfont=$3 folder=$4
shift 4
raks=${RAKS:-$(dirname "$0")/../build/release/bin/raks}

declare -A families=(
    [rock]="pop" [electronic]="electronic hiphop game" [drums]="latin jazz groove free"
    [piano]="piano" [salsa]="salsa own" [mideast]="belly own" [tempo]="own ballroom"
)
mkdir -p "$folder"
for class in rock electronic drums piano salsa mideast tempo; do
    [ -f "$folder/$class.json" ] && continue
    echo "== without ${families[$class]}: $folder/$class.json (${SECONDS} s)" >&2
    # shellcheck disable=SC2086 # several families
    "$raks" train beats "$pack" --soundfont "$soundfont" --corpus "$folder/corpus.bin" "$@" \
        --leave-out ${families[$class]} -o "$folder/$class.part.json"
    mv "$folder/$class.part.json" "$folder/$class.json"
done
"$raks" eval beats "$excerpts" --leave-class-out "$folder"
