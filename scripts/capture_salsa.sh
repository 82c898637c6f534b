#!/usr/bin/env bash
# From cameras to a dance, with the truth at hand: salsa's training takes are filmed as points, tracked,
# solved and learnt; then salsa is judged and danced with these models and with the shipped ones.
#   scripts/capture_salsa.sh LEAD_CLIPS TABLES OUTPUT_FOLDER [OPTIONS OF SIMULATE...]
# LEAD_CLIPS holds 60_*.bvh; TABLES labels_salsa.tsv, salsa_counts.tsv and salsa_glitches.tsv. RAKS names
# the program; METHOD, positions or angles, how markers are followed (positions).
set -euo pipefail
if [ $# -lt 3 ]; then
    sed -n '2,7s/^# *//p' "$0" >&2
    exit 2
fi
here=$(cd "$(dirname "$0")/.." && pwd)
raks=${RAKS:-$here/build/release/bin/raks}
method=${METHOD:-positions}
clips=$1 tables=$2 output=$3
shift 3
mkdir -p "$output/clips"

# The takes that are learnt from.
takes=$(awk -F'\t' '$9 == "train" && $1 ~ /^60_/ { print $1 }' "$tables/labels_salsa.tsv" | sort -u)
for take in $takes; do
    folder=$output/takes/$take
    if [ ! -e "$output/clips/$take.bvh" ]; then
        rm -rf "$folder"
        mkdir -p "$output/takes"
        "$raks" capture simulate "$clips/$take.bvh" -o "$folder" --points --unique --fps 60 --scale 1.267 "$@"
        "$raks" capture track "$folder" --method "$method" --truth "$folder/truth"
        "$raks" capture solve "$folder"
        "$raks" capture compare "$folder/dance.bvh" "$folder/truth/dance.bvh"
        cp "$folder/dance.bvh" "$output/clips/$take.bvh"
    fi
done

# A second home of the program's data, whose salsa is the captured one.
mkdir -p "$output/data/models"
cp -r "$here/config" "$output/data/"
cp -r "$here/models/trained" "$here/models/pretrained" "$output/data/models/"
for figure in basic cross_body_lead inplace_turn travelling_turn; do
    "$raks" train figure "$output/clips" --labels "$tables/labels_salsa.tsv" \
        --counts "$tables/salsa_counts.tsv" --faults "$tables/salsa_glitches.tsv" --figure "$figure" \
        --dance salsa --role lead --split train --fps 60 --scale 1 --source cmu \
        -o "$output/data/models/trained/salsa_${figure}_lead.json"
done

"$raks" synth salsa --bpm 180 --duration 40 --seed 1 -o "$output/salsa.wav"
for which in captured true; do
    if [ "$which" = captured ]; then export RAKS_DATA=$output/data; else export RAKS_DATA=$here; fi
    "$raks" eval dance --dance salsa --seed 1 > "$output/$which.txt" || true
    "$raks" dance "$output/salsa.wav" --dance salsa --seed 1 -o "$output/$which.bvh"
    echo "$which: $(tail -n 1 "$output/$which.txt")"
done
"$raks" capture compare "$output/captured.bvh" "$output/true.bvh"
