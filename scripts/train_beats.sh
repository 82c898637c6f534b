#!/usr/bin/env bash
# Learns the beat networks from nothing: four that are heard together beside BeatNet, those for bars and for
# the metre, and how sure beats are (3 CPU-hours).
#   scripts/train_beats.sh MIDI_PACK FOLDER [options of `raks train beats`, as --soundfont FILE]
# FOLDER/beats.json is what is learnt; what lies in FOLDER already is kept, so that it goes on where it
# was stopped. PERCENT=5 takes 5 % of pieces and steps, to try it; RAKS names the program; HELD_OUT is a
# soundfont that no network hears: how sure beats are is learnt from music that it plays.
set -euo pipefail
# By the same kernels everywhere (AVX2): another machine's own would round otherwise, and two networks
# that differ by nothing else are up to two points of F apart.
export OPENBLAS_CORETYPE=Haswell
if [ $# -lt 2 ]; then
    sed -n '4,8s/^#  *//p' "$0" >&2
    exit 2
fi
pack=$1 folder=$2
shift 2
raks=${RAKS:-$(dirname "$0")/../build/release/bin/raks}
percent=${PERCENT:-100}
fonts=/usr/share/sounds/sf2
held_out=${HELD_OUT:-$fonts/TimGM6mb.sf2}
options=("$@")
metres=("$@")
if [[ " $* " != *" --soundfont "* ]]; then
    options+=(--soundfont "$fonts/FluidR3_GM.sf2")
    for font in FluidR3_GM MuseScore_General_Full OPL-3_FM_128M; do
        metres+=(--soundfont "$fonts/$font.sf2")
    done
fi
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
    stage "$name" "$pack" --excerpts "$pieces" "${options[@]}" "$@"
}
network() {  # name seed music...: begins, then goes on at a lower rate
    local name=$1 seed=$2
    shift 2
    learn "${name}_first" "$@" --steps "$(share 4500 10)" --seed "$seed"
    learn "$name" "$@" --from "$folder/${name}_first.json" --rate 0.002 --steps "$(share 3500 10)" \
        --seed $((seed + 10))
}

play_held_out() {  # writes FOLDER/judged, once
    [ -d "$folder/judged" ] && return
    rm -rf "$folder/judged.part"
    "$raks" train beats "$pack" --excerpts "$(share 400 16)" --with-machines --with-metres \
        --corpus-seed 8 --soundfont "$held_out" --write "$folder/judged.part"
    mv "$folder/judged.part" "$folder/judged"
}

pieces=$(share 3000 16)
music=(--corpus "$folder/music_$pieces.bin")
machines=(--with-machines --corpus "$folder/machines_$pieces.bin")
both=("${music[@]}" --also "$folder/machines_$pieces.bin")

network music 42 "${music[@]}"
network machines 43 "${machines[@]}"
network both 41 "${both[@]}"
network both_again 44 "${both[@]}"

stage four --trust 0.95 --together "$folder"/{music,machines,both,both_again}.json
learn bars "${both[@]}" --from "$folder/four.json" --bar-steps "$(share 1200 10)"
# The metre is learnt from music of all metres that other soundfonts play, too.
many=$(share 4000 16)
stage pulses "$pack" --excerpts "$many" --with-machines --with-metres --corpus-seed 7 \
    --corpus "$folder/metres_$many.bin" "${metres[@]}" --from "$folder/bars.json" --pulse-steps "$(share 1500 10)" --seed 1
play_held_out
# Last: it is learnt from what all networks say together.
stage beats --from "$folder/pulses.json" --judge "$folder/judged"
echo "the networks are in $folder/beats.json" >&2
