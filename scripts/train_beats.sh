#!/usr/bin/env bash
# Learns the beat networks from nothing, four that are heard together (3 CPU-hours).
#   scripts/train_beats.sh MIDI_PACK FOLDER [options of `raks train beats`, as --soundfont FILE]
# FOLDER/beats.json is what is learnt; what lies in FOLDER already is kept, so that it goes on where it
# was stopped. PERCENT=5 takes 5 % of pieces and steps, to try it; RAKS names the program.
set -euo pipefail
# By the same kernels everywhere (AVX2): another machine's own would round otherwise, and two networks
# that differ by nothing else are up to two points of F apart.
export OPENBLAS_CORETYPE=Haswell
if [ $# -lt 2 ]; then
    sed -n '3,6s/^#  *//p' "$0" >&2
    exit 2
fi
pack=$1 folder=$2
shift 2
raks=${RAKS:-$(dirname "$0")/../build/release/bin/raks}
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
    stage "$name" "$pack" --excerpts "$pieces" "${options[@]}" "$@"
}
network() {  # name seed music...: begins, then goes on at a lower rate
    local name=$1 seed=$2
    shift 2
    learn "${name}_first" "$@" --steps "$(share 4500 10)" --seed "$seed"
    learn "$name" "$@" --from "$folder/${name}_first.json" --rate 0.002 --steps "$(share 3500 10)" \
        --seed $((seed + 10))
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
learn beats "${both[@]}" --from "$folder/four.json" --bar-steps "$(share 1200 10)"
echo "the networks are in $folder/beats.json" >&2
