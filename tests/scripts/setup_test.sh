#!/usr/bin/env bash
# scripts/setup.sh on simulated systems: apt's real solver over the stored states of a Debian 12 with a
# GNOME desktop and of a bare one (`dpkg` status files, without what the solver does not read).
# Exit code 77: skipped, as apt's lists of packages are not here.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
setup=$here/../../scripts/setup.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/cache/archives/partial"
# Solving costs half as much where apt keeps what it has read.
cat >"$work/apt.conf" <<APT
Dir::Cache "$work/cache";
Dir::Cache::pkgcache "pkgcache.bin";
Dir::Cache::srcpkgcache "srcpkgcache.bin";
APT
export APT_CONFIG=$work/apt.conf
failures=0

fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}

[[ "$(apt-cache policy gnome-core 2>/dev/null)" == *'Candidate: '[0-9]* ]] || {
    echo "apt's lists are not here (apt-get update brings them)"
    exit 77
}

# simulate SYSTEM PACKAGE...: what apt would do there, into $work/plan.
simulate() {
    local system=$1
    shift
    xz -dc "$here/debian_12_$system.status.xz" >"$work/$system"
    apt-cache gencaches -o Dir::State::status="$work/$system" >/dev/null
    apt-get -s -o Dir::State::status="$work/$system" --no-install-recommends install "$@" >"$work/plan" 2>&1
}
removed() { sed -n 's/^Remv \([^ ]*\).*/\1/p' "$work/plan" | tr '\n' ' '; }
installed() { grep -c '^Inst' "$work/plan"; }
megabytes() {
    sed -n 's/^Inst \([^ ]*\).*/\1/p' "$work/plan" | xargs -n 300 apt-cache show --no-all-versions |
        awk '/^Installed-Size:/ {sum += $2} END {print int(sum / 1024)}'
}

# The state is that of a desktop which would lose something.
simulate gnome pulseaudio
[[ "$(removed)" == *gnome-core* ]] || fail "pulseaudio should cost this desktop gnome-core; it costs \"$(removed)\""

# at_most SYSTEM PACKAGES MEGABYTES: what building and dancing need there.
at_most() {
    simulate "$1" $("$setup" --list build run) || fail "$1: apt refuses: $(tail -n 1 "$work/plan")"
    [ -z "$(removed)" ] || fail "$1: would remove $(removed)"
    [ "$(installed)" -le "$2" ] || fail "$1: $(installed) packages, at most $2"
    local size
    size=$(megabytes)
    [ "$size" -le "$3" ] || fail "$1: $size MB, at most $3"
    echo "$1: $(installed) packages, $size MB"
}
at_most gnome 150 450
at_most bare 320 900

# run_setup SYSTEM LIST...: the script itself there. Its apt-get simulates and notes how it was called;
# `update` alone does what the test asks for. No call of sudo leaves this folder. Of the packages that the
# script tries one by one most are there already, as each costs a solution.
mkdir "$work/bin"
cat >"$work/bin/apt-get" <<'APT'
#!/usr/bin/env bash
echo "DEBIAN_FRONTEND=${DEBIAN_FRONTEND:-} $*" >>"$SETUP_TEST/calls"
[[ " $* " == *" update "* ]] && exit "$(cat "$SETUP_TEST/update")"
[[ " $* " == *" --assume-no "* ]] || set -- -s "$@"
exec /usr/bin/apt-get -o Dir::State::status="$SETUP_TEST/status" "$@"
APT
printf '#!/bin/sh\nexec "$@"\n' >"$work/bin/sudo"
chmod +x "$work/bin/apt-get" "$work/bin/sudo"
run_setup() {
    local system=$1
    shift
    xz -dc "$here/debian_12_$system.status.xz" >"$work/status"
    printf 'Package: %s\nStatus: install ok installed\nMaintainer: nobody\nArchitecture: amd64\nVersion: 999\nDescription: there\n\n' \
        jackd2 xdotool clang-format clang-tidy clang-14 libclang-rt-14-dev dpkg-dev lintian zsh fish >>"$work/status"
    apt-cache gencaches -o Dir::State::status="$work/status" >/dev/null
    : >"$work/calls"
    mkdir -p "$work/tree/scripts" "$work/info" "$work/updates"
    cp "$setup" "$work/tree/scripts/"
    SETUP_TEST=$work DPKG_ADMINDIR=$work PATH=$work/bin:$PATH "$work/tree/scripts/setup.sh" "$@" >"$work/said" 2>&1
}

echo 0 >"$work/update"
run_setup gnome ci || fail "gnome, ci: $(cat "$work/said")"
grep -q 'pulseaudio is left out' "$work/said" || fail "nothing is said of pulseaudio: $(cat "$work/said")"
grep -q '^Remv' "$work/tree/build/setup.log" && fail "it removes: $(grep '^Remv' "$work/tree/build/setup.log")"
grep -q '^Inst xvfb' "$work/tree/build/setup.log" || fail "it does not install xvfb"
grep -E ' -y ' "$work/calls" | grep -qv -- '--no-remove' && fail "a call without --no-remove: $(cat "$work/calls")"
grep -E ' -y ' "$work/calls" | grep -qv '^DEBIAN_FRONTEND=noninteractive' && fail "a call that may ask: $(cat "$work/calls")"
grep -q 'Need to get' "$work/said" || fail "it does not say how much: $(cat "$work/said")"

# Faults end in one line and exit code 1.
echo 100 >"$work/update"
if run_setup bare build; then fail "it goes on without a network"; fi
[[ "$(tail -n 1 "$work/said")" == *"is there a network?"* ]] || fail "no network: $(tail -n 1 "$work/said")"
if run_setup bare nosuch; then fail "it takes a list that there is not"; fi
[[ "$(cat "$work/said")" == *'there is no list "nosuch"'* ]] || fail "no such list: $(cat "$work/said")"

[ "$failures" -eq 0 ]
