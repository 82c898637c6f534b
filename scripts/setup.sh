#!/usr/bin/env bash
# Installs the Debian 12 packages of the lists that are asked for; without a name those that building
# and dancing need. Idempotent: when all is there it asks dpkg once and leaves. Uses sudo when not
# root. It never removes or replaces a package.
#   scripts/setup.sh [build] [run] [learn] [stream] [remote] [test] [ci] [receivers] [fuzz] [rtsan] [soundfonts]
#   scripts/setup.sh --list [LIST...]    prints the packages of the lists and installs nothing
set -euo pipefail
cd "$(dirname "$0")/.."

declare -A lists=(
    # The compiler, and the libraries of the programs raks, raks-decode and raks-import.
    [build]="g++ cmake ninja-build pkg-config
        portaudio19-dev libjack-jackd2-dev libpulse-dev libasound2-dev libdbus-1-dev libsndfile1-dev libspeexdsp-dev
        libkissfft-dev libavcodec-dev libavformat-dev libavutil-dev libswscale-dev
        libswresample-dev libeigen3-dev libglm-dev libglfw3-dev libepoxy-dev libegl-dev libopengl-dev
        libx11-dev libimgui-dev libstb-dev libpng-dev libjpeg62-turbo-dev libwebp-dev zlib1g-dev
        libmeshoptimizer-dev libassimp-dev libdraco-dev nlohmann-json3-dev libsimdjson-dev
        libtomlplusplus-dev libpugixml-dev libcli11-dev libfmt-dev libexpected-dev libseccomp-dev liboscpack-dev"
    # OpenGL and letters.
    [run]="libegl1 libegl-mesa0 libgl1 libgl1-mesa-dri libopengl0 fonts-dejavu-core"
    # raks-train (MIDI, matrices) and raks-capture (cameras, networks).
    [learn]="libfluidsynth-dev libopenblas-dev libopencv-calib3d-dev libopencv-imgproc-dev
        libopencv-dnn-dev libopencv-contrib-dev libceres-dev"
    # Pictures through PipeWire: play and live --video-out pipewire.
    [stream]="libpipewire-0.3-dev"
    # HTTP and a page for phones (play and live --remote), what players play (--now-playing), MIDI
    # through ALSA (--midi-clock, --midi-in).
    [remote]="libcivetweb-dev libqrencode-dev libsystemd-dev librtmidi-dev"
    # What the tests need that open no window and no sound device.
    [test]="git ccache mold libgtest-dev libgmock-dev libebur128-dev sox flac lame opus-tools ffmpeg imagemagick valgrind"
    # Sound servers, a display, checkers of code and of packages: all that CI runs.
    [ci]="jackd2 pulseaudio pulseaudio-utils libasound2-plugins dbus xvfb xdotool x11-utils picom
        gstreamer1.0-tools gstreamer1.0-plugins-base
        dpkg-dev lintian desktop-file-utils appstream shared-mime-info libglib2.0-bin man-db zsh fish
        clang-format clang-tidy clang-14 libclang-rt-14-dev"
    # Programs that are told of the music, for the tests with the label receivers.
    [receivers]="liblo-tools qlcplus python3 curl chromium mpv mpv-mpris playerctl jack-midi-clock
        ableton-link-utils"
    # scripts/fuzz.sh and scripts/rtsan.sh
    [fuzz]="clang-14 libclang-rt-14-dev"
    [rtsan]="clang-22 libclang-rt-22-dev llvm-14"
    # What `raks train beats` and `raks train genre` render music with.
    [soundfonts]="fluid-soundfont-gm musescore-general-soundfont-small
        musescore-general-soundfont-lossless opl3-soundfont csound-soundfont timgm6mb-soundfont
        aubio-tools"
)
log=build/setup.log

say() { echo "setup: $*" >&2; }
give_up() {
    say "$*"
    exit 1
}

only_list=
if [ "${1:-}" = --list ]; then
    only_list=1
    shift
fi
[ $# -gt 0 ] || set -- build run
packages=()
for name in "$@"; do
    if [ -z "${lists[$name]:-}" ]; then
        say "there is no list \"$name\"; the lists are build, run, learn, stream, remote, test, ci, receivers, fuzz, rtsan, soundfonts"
        exit 2
    fi
    read -r -d '' -a words <<<"${lists[$name]}" || true
    packages+=("${words[@]}")
done
if [ -n "$only_list" ]; then
    printf '%s\n' "${packages[@]}"
    exit 0
fi

command -v apt-get >/dev/null && command -v dpkg-query >/dev/null ||
    give_up "apt-get is not here; install by hand what \"scripts/setup.sh --list $*\" prints"
missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
    [ "$status" = "install ok installed" ] || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

system=$(. /etc/os-release 2>/dev/null && echo "${ID:-} ${VERSION_ID:-}" || true)
[ "$system" = "debian 12" ] ||
    say "Raks is made for Debian 12; on \"${system:-this system}\" some packages may have other names or versions"

mkdir -p build && : >"$log" || give_up "$log cannot be written; is the disk full?"
as_root=(env DEBIAN_FRONTEND=noninteractive)
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
        give_up "installing packages needs root, and sudo is not here; as root: apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo env DEBIAN_FRONTEND=noninteractive)
fi
# sudo forgets the environment, so DEBIAN_FRONTEND comes behind it; without it a package could ask a
# question that nobody sees, as without the terminal as its input.
apt_as_root() {
    "${as_root[@]}" apt-get -o DPkg::Lock::Timeout=600 -o Dpkg::Use-Pty=0 "$@" </dev/null >>"$log" 2>&1
}

# what_apt_would_do PACKAGE...: as text; needs no root.
what_apt_would_do() {
    LC_ALL=C apt-get -s -o Debug::NoLocking=1 --no-install-recommends install "$@" 2>&1
}
# would_remove PACKAGE...: the packages that would go.
would_remove() { what_apt_would_do "$@" | sed -n 's/^Remv \([^ ]*\).*/\1/p' | sort -u | tr '\n' ' '; }
# sizes PACKAGE...: apt's own words on downloads and disk, "Need to get 86.1 MB ... will be used."
sizes() {
    LC_ALL=C apt-get --assume-no -o Debug::NoLocking=1 --no-install-recommends install "$@" 2>/dev/null |
        grep -E '^(Need to get|After this)' | sed 's/\.$//' | paste -sd ';' | sed 's/;After/; after/' || true
}

say "Raks needs ${#missing[@]} Debian packages that are not here: ${missing[*]}"
[ "$(id -u)" -eq 0 ] ||
    say "installing them needs root, so sudo may ask for your password; nothing is removed or replaced, what apt says goes to $log"
if [ "$(id -u)" -ne 0 ] && ! sudo true; then
    give_up "sudo refused; as root: apt-get install --no-install-recommends ${missing[*]}"
fi
apt_as_root update ||
    give_up "the lists of packages could not be fetched (is there a network?): $(grep -m 1 '^[EW]:' "$log" || tail -n 1 "$log")"
plan=$(what_apt_would_do "${missing[@]}") || true
unknown=$(sed -n 's/^E: Unable to locate package //p; s/^E: Package .\([^ ]*\). has no installation candidate/\1/p' <<<"$plan" | tr '\n' ' ')
[ -z "$unknown" ] || give_up "this system's lists do not have ${unknown% }; nothing was installed"

# What would put out something that is installed stays away: of Debian's sound servers only one can
# be installed, and a desktop has its own.
if grep -q '^Remv' <<<"$plan"; then
    kept=()
    for package in "${missing[@]}"; do
        [[ " ${lists[ci]} " == *[[:space:]]$package[[:space:]]* ]] || kept+=("$package")
    done
    gone=$([ ${#kept[@]} -eq 0 ] || would_remove "${kept[@]}")
    [ -z "$gone" ] || give_up "apt would remove ${gone% } for them; nothing was installed"
    for package in ${lists[ci]}; do
        [[ " ${missing[*]} " == *" $package "* ]] || continue
        gone=$(would_remove "$package")
        if [ -z "$gone" ]; then
            kept+=("$package")
        else
            say "$package is left out, as apt would remove ${gone% } for it; the tests that need it are skipped"
        fi
    done
    [ ${#kept[@]} -gt 0 ] || exit 0
    missing=("${kept[@]}")
fi

said=$(sizes "${missing[@]}")
[ -z "$said" ] || say "$said"
apt_as_root -y --no-remove --no-install-recommends install "${missing[@]}" ||
    give_up "apt could not install them: $(grep -m 1 '^E:\|No space left' "$log" || tail -n 1 "$log") (whole log: $log)"
say "done"
