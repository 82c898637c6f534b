#!/usr/bin/env bash
# Learns all figures of salsa that ship, as angles and as positions of joints.
#   scripts/train_salsa.sh LEAD_CLIPS FOLLOW_CLIPS TABLES OUTPUT_FOLDER
# TABLES holds labels_salsa.tsv, salsa_counts.tsv and salsa_glitches.tsv. RAKS names the program.
set -euo pipefail
if [ $# -ne 4 ]; then
    sed -n '2,4s/^# *//p' "$0" >&2
    exit 2
fi
raks=${RAKS:-$(dirname "$0")/../build/release/bin/raks}
tables=$3
output=$4
mkdir -p "$output"
learn() {  # role clips scale features suffix
    for figure in basic cross_body_lead inplace_turn travelling_turn; do
        "$raks" train figure "$2" --labels "$tables/labels_salsa.tsv" \
            --counts "$tables/salsa_counts.tsv" --faults "$tables/salsa_glitches.tsv" \
            --figure "$figure" --dance salsa --role "$1" --split train --fps 60 --scale "$3" \
            --features "$4" --source cmu -o "$output/salsa_${figure}_$1$5.json"
    done
}
for kind in "angles " "positions _positions"; do
    read -r features suffix <<<"$kind"
    learn lead "$1" 1.267 "$features" "$suffix"
    learn follow "$2" 1.17 "$features" "$suffix"
done
