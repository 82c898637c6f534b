#!/usr/bin/env bash
# Learns a beat network from nothing (70 to 90 CPU-minutes).
#   scripts/train_beats.sh MIDI_PACK FOLDER [options of `raks train beats`, as --soundfont FILE]
# FOLDER/beats.json is what is learnt; what lies in FOLDER already is kept, so that it goes on where it
# was stopped. PERCENT=5 takes 5 % of pieces and steps, to try it; RAKS names the program.
set -euo pipefail
if [ $# -lt 2 ]; then
    sed -n '3,5s/^#  *//p' "$0" >&2
    exit 2
fi
pack=$1 folder=$2
shift 2
raks=${RAKS:-$(dirname "$0")/../build/release/engine/cli/raks}
percent=${PERCENT:-100}
options=("$@")
[[ " $* " == *" --soundfont "* ]] || options+=(--soundfont /usr/share/sounds/sf2/FluidR3_GM.sf2)
mkdir -p "$folder"

share() {  # whole least: this percentage of it
    local part=$(($1 * percent / 100))
    echo $((part > $2 ? part : $2))
}
stage() {  # name arguments: writes FOLDER/name.json, once
    local name=$1
    shift
    [ -f "$folder/$name.json" ] && return
    echo "== $name (${SECONDS} s): raks train beats $*" >&2
    "$raks" train beats "$@" -o "$folder/$name.part.json"
    mv "$folder/$name.part.json" "$folder/$name.json"
}
learn() {  # name arguments
    local name=$1
    shift
    stage "$name" "$pack" --excerpts "$pieces" --corpus "$folder/music_$pieces.bin" "${options[@]}" "$@"
}

pieces=$(share 3000 16)
learn begun --steps "$(share 4500 10)" --seed 12
learn heard --steps "$(share 3500 10)" --seed 22 --from "$folder/begun.json" --rate 0.002
learn beats --bar-steps "$(share 1200 10)" --from "$folder/heard.json"
echo "$folder/beats.json" >&2
