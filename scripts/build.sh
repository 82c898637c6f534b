#!/usr/bin/env bash
# Installs what is needed and builds Raks in build/release: the programs that dance, or, with `learn`,
# also those of `raks train` and `raks capture`; with `stream`, pictures go to other programs through
# PipeWire, too; with `remote`, a page for phones and HTTP are served. Says on stderr how far it is.
#   scripts/build.sh [learn|stream|remote]
set -euo pipefail
cd "$(dirname "$0")/.."

targets=(raks manual-raks)
lists=(build run)
chosen=()
case "${1:-}" in
    "") # A folder that was set up otherwise, as for the tests, keeps what it has.
        [ -e build/release/CMakeCache.txt ] ||
            chosen=(-DRAKS_TESTS=OFF -DRAKS_TRAIN=OFF -DRAKS_CAPTURE=OFF) ;;
    learn)
        targets+=(raks-train manual-train raks-capture manual-capture)
        lists+=(learn)
        chosen=(-DRAKS_TRAIN=ON -DRAKS_CAPTURE=ON)
        [ -e build/release/CMakeCache.txt ] || chosen+=(-DRAKS_TESTS=OFF) ;;
    stream)
        targets+=(raks-pipewire)
        lists+=(stream)
        chosen=(-DRAKS_PIPEWIRE=ON)
        [ -e build/release/CMakeCache.txt ] ||
            chosen+=(-DRAKS_TESTS=OFF -DRAKS_TRAIN=OFF -DRAKS_CAPTURE=OFF) ;;
    remote)
        lists+=(remote)
        chosen=(-DRAKS_REMOTE=ON)
        [ -e build/release/CMakeCache.txt ] ||
            chosen+=(-DRAKS_TESTS=OFF -DRAKS_TRAIN=OFF -DRAKS_CAPTURE=OFF) ;;
    *)
        echo "usage: scripts/build.sh [learn|stream|remote]" >&2
        exit 2 ;;
esac
scripts/setup.sh "${lists[@]}"

log=build/build.log
give_up() {
    echo "build: $*; the whole log is $log" >&2
    exit 1
}
# The first line that names a fault, or the last one.
fault() { grep -m 1 -E 'No space left|[Kk]illed|fatal error|error:|CMake Error' "$log" || tail -n 1 "$log"; }

mkdir -p build
cmake --preset release "${chosen[@]}" >"$log" 2>&1 || give_up "it cannot be configured: $(fault)"

# The largest unit takes 1.4 GB of memory while it is compiled.
memory=$(awk '/^MemAvailable:/ {print int($2 / 1400000)}' /proc/meminfo)
jobs=$(nproc)
[ "$memory" -ge "$jobs" ] || jobs=$((memory > 1 ? memory : 1))

# show_progress: from ninja's lines "[12/345] ..." how far the build is and how long it still takes: at
# first by four seconds a step, which an ordinary computer needs, then by what it took so far.
show_progress() {
    local announced= line finished total left
    while IFS= read -r line; do
        [[ "$line" =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
        finished=${BASH_REMATCH[1]} total=${BASH_REMATCH[2]}
        # Ninja's first steps may be to look whether there is anything to do.
        [ "$total" -gt 2 ] || continue
        left=$((4 * (total - finished) / jobs))
        [ $((finished * 10)) -lt "$total" ] || left=$((SECONDS * (total - finished) / finished))
        left=$(((left + 59) / 60))
        [ -n "$announced" ] || echo "building: $total steps, $jobs at a time, about $left min (log: $log)" >&2
        announced=1
        [ -t 2 ] && printf '\r\033[Kbuilding: %d of %d, about %d min left' "$finished" "$total" "$left" >&2
    done
    [ -t 2 ] && printf '\r\033[K' >&2 || true
}
SECONDS=0
cmake --build --preset release -j "$jobs" --target "${targets[@]}" 2>&1 | tee -a "$log" | show_progress ||
    give_up "it cannot be built: $(fault)"
