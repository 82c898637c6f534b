#!/usr/bin/env bash
# The packages on an empty Debian 12, as scripts/package.sh tries them. For the night: it takes minutes, and
# fetches some 700 MB.
# Exit code 77: skipped, as it needs root and debootstrap.
set -euo pipefail
[ "$(id -u)" -eq 0 ] || { echo "skipped: an empty system needs root"; exit 77; }
command -v debootstrap ffprobe >/dev/null || { echo "skipped: debootstrap or ffprobe is not here"; exit 77; }
exec "$(dirname "$0")/../../scripts/package.sh" --try-all
