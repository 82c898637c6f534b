#!/usr/bin/env bash
# Writes each excerpt six times, begun elsewhere and a little faster or slower, for `raks eval beats`:
# whether one excerpt is heard in another octave is luck, and of six begins less of it.
#   scripts/vary_excerpts.sh EXCERPTS FOLDER
set -euo pipefail
if [ $# -ne 2 ]; then
    sed -n '4s/^#  *//p' "$0" >&2
    exit 2
fi
excerpts=$1 folder=$2
# seconds cut off:speed
variants=(0.3:0.95 0.6:1 1.1:1.05 1.5:0.97 2.1:1.03 2.7:1)
rate=44100

mkdir -p "$folder"
printf 'name\tclass\n' >"$folder/index.tsv"
tail -n +2 "$excerpts/index.tsv" | cut -f 1,2 | while IFS=$'\t' read -r name class; do
    for number in "${!variants[@]}"; do
        cut=${variants[$number]%:*} speed=${variants[$number]#*:}
        varied=${name}_$number
        played=$(awk -v rate=$rate -v speed="$speed" 'BEGIN { print int(rate * speed) }')
        ffmpeg -nostdin -v error -y -ss "$cut" -i "$excerpts/$name.ogg" \
            -af "aresample=$rate,asetrate=$played,aresample=$rate" -c:a libvorbis -q:a 6 \
            "$folder/$varied.ogg"
        awk -v cut="$cut" -v speed="$speed" \
            '$1 >= cut { printf "%.4f\t%s\n", ($1 - cut) / speed, $2 }' "$excerpts/$name.beats" \
            >"$folder/$varied.beats"
        printf '%s\t%s\n' "$varied" "$class" >>"$folder/index.tsv"
    done
done
