#!/usr/bin/env bash
# Learns the dances of people's takes that ship: config/takes/DANCE.tsv, whose beats were labelled
# by eye, and the clips that it names, to models/trained/DANCE.cells. The same bits come out.
#   scripts/train_takes.sh CLIPS [folder to write into]
# CLIPS: the folder of the g1-moves clips as BVH. RAKS names the program.
set -euo pipefail
if [ $# -lt 1 ]; then
    sed -n '2,5s/^# *//p' "$0" >&2
    exit 2
fi
root=$(cd "$(dirname "$0")/.." && pwd)
raks=${RAKS:-$root/build/release/bin/raks}
licence='CC BY 4.0 (https://creativecommons.org/licenses/by/4.0/): g1-moves by M. Chaiet,
M. Maguire and Jasmine Coro (https://github.com/experientialtech/g1-moves).
Changed: cut, mirrored, learnt as states.'
for table in "$root"/config/takes/*.tsv; do
    # The motion passed over a robot, whose home pose the arms have in a tenth to a quarter of it.
    "$raks" train take "$1" --counts "$table" --dance "$(basename "$table" .tsv)" --lay-arms \
        --licence "${licence//$'\n'/ }" -o "${2:-$root/models/trained}"
done
