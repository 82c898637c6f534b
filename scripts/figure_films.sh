#!/usr/bin/env bash
# Films every written figure by itself at its slowest, written and fastest tempo, from the front and
# the side: to be watched after a change. About four CPU-minutes.
# Usage: scripts/figure_films.sh FOLDER [dance ...]
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
raks=${RAKS:-$root/build/release/bin/raks}
out=${1:?usage: scripts/figure_films.sh FOLDER [dance ...]}
shift
mkdir -p "$out"
if [ $# = 0 ]; then
    mapfile -t written < <(basename -s .toml "$root"/config/choreographies/*.toml)
    set -- "${written[@]}"
fi
for name in "$@"; do
    file=$root/config/choreographies/$name.toml
    tempos=$(sed -n 's/^tempo = \[\(.*\)\]/\1/p' "$file" | tr -d ,)
    for figure in $(sed -n 's/^name = "\(.*\)"/\1/p' "$file"); do
        for bpm in $tempos; do
            "$raks" sheet --dance "$name" --figure "$figure" --bpm "$bpm" --quality fast \
                -o "$out/$name.$figure.$bpm.mp4"
        done
    done
done
