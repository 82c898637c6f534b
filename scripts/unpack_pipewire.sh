#!/usr/bin/env bash
# Puts Debian's PipeWire, with WirePlumber, its PulseAudio server and its plug-in for GStreamer, into
# build/pipewire, for the tests that run Raks on it. It is unpacked and not installed, as Debian lets only one of PulseAudio
# and pipewire-pulse be installed. Idempotent. Needs the network once.
set -euo pipefail
cd "$(dirname "$0")/.."

plugin=build/pipewire/usr/lib/x86_64-linux-gnu/gstreamer-1.0/libgstpipewire.so
[ -x build/pipewire/usr/bin/wireplumber ] && [ -e "$plugin" ] && exit 0
packages=(pipewire pipewire-bin pipewire-pulse wireplumber libwireplumber-0.4-0
    libpipewire-0.3-0 libpipewire-0.3-modules libspa-0.2-modules gstreamer1.0-pipewire liblua5.3-0
    liblilv-0-0 libserd-0-0 libsord-0-0 libsratom-0-0 libwebrtc-audio-processing1)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p build
(cd "$folder" && apt-get -qq download "${packages[@]}" 2>/dev/null)
for package in "$folder"/*.deb; do
    dpkg -x "$package" "$folder/pipewire"
done
rm -rf build/pipewire
mv "$folder/pipewire" build/pipewire
