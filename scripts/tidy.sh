#!/usr/bin/env bash
# Runs clang-tidy (.clang-tidy: every finding is an error) with the commands of the dev preset, which
# compiles each file alone. Options that GCC alone knows are passed over.
#   scripts/tidy.sh --changed    the .cpp files that scripts/changed_files.sh names
#   scripts/tidy.sh [FILE...]    these files, or every tracked .cpp file
set -euo pipefail
cd "$(dirname "$0")/.."

if [ "${1:-}" = --changed ]; then
    mapfile -t files < <(scripts/changed_files.sh | grep '\.cpp$' || true)
elif [ $# -gt 0 ]; then
    files=("$@")
else
    mapfile -t files < <(git ls-files '*.cpp')
fi
[ ${#files[@]} -gt 0 ] || exit 0

cmake --preset dev >/dev/null
echo "== clang-tidy: ${#files[@]} files"
printf '%s\0' "${files[@]}" |
    xargs -0 -n 1 -P "$(nproc)" clang-tidy --quiet -p build/dev --extra-arg=-Wno-unused-command-line-argument 2>&1 |
    { grep -v ' warnings\? generated\.$' || true; }
