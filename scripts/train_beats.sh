#!/usr/bin/env bash
# Learns the beat networks from nothing, three that are heard together (3 to 6 CPU-hours).
#   scripts/train_beats.sh MIDI_PACK FOLDER [options of `raks train beats`, as --soundfont FILE]
# FOLDER/beats.json is what is learnt; what lies in FOLDER already is kept, so that it goes on where it
# was stopped; a six.json that lies there is heard in the place of the first network. PERCENT=5 takes 5 %
# of pieces and steps, to try it; RAKS names the program.
set -euo pipefail
if [ $# -lt 2 ]; then
    sed -n '3,6s/^#  *//p' "$0" >&2
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
    stage "$name" "$pack" --excerpts "$pieces" "${options[@]}" "$@"
}
on() {  # name from steps arguments: goes on at a lower rate
    local name=$1 from=$2 steps=$3
    shift 3
    learn "$name" --from "$folder/$from.json" --rate 0.002 --steps "$(share "$steps" 10)" "$@"
}
mean() {  # name of...: of networks that went on from one
    local name=$1
    shift
    local files=("${@/#/$folder/}")
    stage "$name" --average "${files[@]/%/.json}"
}

pieces=$(share 3000 16)
begin=$(share 4500 10)
music=(--corpus "$folder/music_$pieces.bin")
machines=(--with-machines --corpus "$folder/machines_$pieces.bin")
both=("${music[@]}" --also "$folder/machines_$pieces.bin")

learn_six() {  # of the usual music
    learn first "${music[@]}" --steps "$begin"
    on a first 1500 "${music[@]}" --cuts 0
    on b first 2600 "${music[@]}" --cuts 0 --seed 2
    on c first 2200 "${music[@]}" --cuts 0 --seed 3
    mean four first a b c
    on d four 3500 "${music[@]}" --seed 5
    on e four 3500 "${music[@]}" --seed 6
    on f four 3500 "${music[@]}" --seed 7
    mean six a b c d e f
}
[ -f "$folder/six.json" ] || learn_six

learn machines_first "${machines[@]}" --steps "$begin" --seed 12
on machines_on machines_first 3500 "${machines[@]}" --seed 22
on machines_a machines_on 1500 "${machines[@]}" --seed 31
on machines_b machines_on 1500 "${machines[@]}" --seed 32
mean machines machines_a machines_b

learn both_first "${both[@]}" --steps "$begin" --seed 13
on both both_first 3500 "${both[@]}" --seed 23

stage three --trust 0.95 --together "$folder"/{six,machines,both}.json
learn beats "${both[@]}" --from "$folder/three.json" --bar-steps "$(share 1200 10)"
echo "$folder/beats.json" >&2
