#!/usr/bin/env bash
# Puts Debian's PipeWire, with WirePlumber and its PulseAudio server, into build/pipewire, for the
# tests that run Raks on it. It is unpacked and not installed, as Debian lets only one of PulseAudio
# and pipewire-pulse be installed. Idempotent. Needs the network once.
set -euo pipefail
cd "$(dirname "$0")/.."

[ -x build/pipewire/usr/bin/wireplumber ] && exit 0
packages=(pipewire pipewire-bin pipewire-pulse wireplumber libwireplumber-0.4-0
    libpipewire-0.3-0 libpipewire-0.3-modules libspa-0.2-modules liblua5.3-0
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
