#!/usr/bin/env bash
# Prints the files that differ from the main branch, a line each: from the merge base with it, and on
# the main branch itself from the commit before this one.
set -euo pipefail
cd "$(dirname "$0")/.."
base=HEAD
for name in origin/main main; do
    if git rev-parse --verify --quiet "$name^{commit}" >/dev/null; then
        base=$(git merge-base HEAD "$name")
        break
    fi
done
if [ "$(git rev-parse "$base")" = "$(git rev-parse HEAD)" ]; then
    base=$(git rev-parse --verify --quiet HEAD^1 || git rev-parse HEAD)
fi
git diff --name-only --diff-filter=d "$base"
