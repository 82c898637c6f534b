#!/usr/bin/env bash
# Sets up, builds and runs all the tests. Ends with ctest's summary.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh
cmake --preset release >build.log 2>&1 || { cat build.log; exit 1; }
cmake --build --preset release
ctest --preset release -j "$(nproc)"
