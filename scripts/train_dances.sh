#!/usr/bin/env bash
# Learns the written dances again: config/choreographies/*.toml to models/trained/*.json; belly
# dance, the paper's second, of joint positions, too. The same bits come out.
# Usage: scripts/train_dances.sh [folder to write into]
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
raks=${RAKS:-$root/build/release/bin/raks}
for dance in "$root"/config/choreographies/*.toml; do
    "$raks" train figure "$dance" -o "${1:-$root/models/trained}"
done
"$raks" train figure "$root/config/choreographies/belly.toml" --features positions \
    -o "${1:-$root/models/trained}"
