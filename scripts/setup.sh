#!/usr/bin/env bash
# Installs every Debian 12 package that Raks needs to build, test and run. Idempotent: when all is
# there it asks dpkg once and leaves. Uses sudo when not root.
#   scripts/setup.sh            build, run and test
#   scripts/setup.sh --training also the soundfonts that `raks train beats` and `raks train genre` render music with
#   scripts/setup.sh --rtsan    also clang 22 for the RealtimeSanitizer build
set -euo pipefail

packages=(
    # build
    g++ cmake ninja-build ccache mold pkg-config git ca-certificates
    # libraries
    portaudio19-dev libjack-jackd2-dev libsndfile1-dev libspeexdsp-dev libkissfft-dev libebur128-dev libpulse-dev
    libasound2-dev libeigen3-dev libglm-dev libglfw3-dev libepoxy-dev libegl-dev libopengl-dev
    libx11-dev libimgui-dev libstb-dev libpng-dev zlib1g-dev libavcodec-dev libavformat-dev libavutil-dev
    libswscale-dev libswresample-dev nlohmann-json3-dev libtomlplusplus-dev libcli11-dev libfmt-dev
    libsimdjson-dev libmeshoptimizer-dev libwebp-dev libjpeg62-turbo-dev libexpected-dev libpugixml-dev libseccomp-dev libassimp-dev libdraco-dev libgtest-dev libgmock-dev
    # learning to hear beats: MIDI rendered, matrices
    libfluidsynth-dev libopenblas-dev
    # calibrating the cameras of a capture
    libopencv-calib3d-dev libopencv-imgproc-dev libopencv-contrib-dev libceres-dev
    # what the program and its tests run on
    libegl1 libegl-mesa0 libgl1 libgl1-mesa-dri libopengl0 jackd2 pulseaudio pulseaudio-utils
    libasound2-plugins dbus sox flac lame opus-tools xvfb xdotool x11-utils imagemagick ffmpeg fonts-dejavu-core
    # checks
    clang-format clang-tidy
    # fuzzing: scripts/fuzz.sh
    clang-14 libclang-rt-14-dev
)
if [ "${1:-}" = --rtsan ]; then
    packages+=(clang-22 libclang-rt-22-dev llvm-14)
elif [ "${1:-}" = --training ]; then
    packages+=(fluid-soundfont-gm musescore-general-soundfont-small musescore-general-soundfont-lossless
        opl3-soundfont csound-soundfont timgm6mb-soundfont aubio-tools)
elif [ $# -gt 0 ]; then
    echo "usage: scripts/setup.sh [--training|--rtsan]" >&2
    exit 2
fi

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
    [ "$status" = "install ok installed" ] || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

run=()
[ "$(id -u)" -eq 0 ] || run=(sudo)
echo "setup: installing ${#missing[@]} Debian packages: ${missing[*]}" >&2
export DEBIAN_FRONTEND=noninteractive
"${run[@]}" apt-get -qq -o DPkg::Lock::Timeout=600 update
"${run[@]}" apt-get -qq -o DPkg::Lock::Timeout=600 -o Dpkg::Use-Pty=0 install -y \
    --no-install-recommends "${missing[@]}" >/dev/null
echo "setup: done" >&2
