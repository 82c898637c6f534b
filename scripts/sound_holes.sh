#!/usr/bin/env bash
# How many holes does the sound of `raks play` have on a busy machine? Plays a piece in a window of
# 1280x720 (in an Xvfb of its own, drawn in software) beside two busy loops, on a PulseAudio null
# sink, and the same piece by paplay with the same buffer on a second one, both recorded from the
# sinks' monitors at the same time. A hole is 3 ms of silence in music that has none.
#   scripts/sound_holes.sh [SECONDS] [BUFFER_MS] [LOOPS]     60, 40, 2 when not given
# Needs the packages of scripts/setup.sh. Prints one line for each player.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60} buffer=${2:-40} loops=${3:-2}
raks=$PWD/build/release/bin/raks
folder=$(mktemp -d)
pids=()
# Only what this script started, each by its number.
stop() {
    for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
    wait 2>/dev/null || true
    rm -rf "$folder"
}
trap stop EXIT

"$raks" synth house -o "$folder/house.wav" --duration "$((seconds + 5))"
# A hum under the music, so that no moment of it is silent.
ffmpeg -loglevel error -i "$folder/house.wav" -f lavfi -i "sine=frequency=110:sample_rate=48000" \
    -filter_complex "[1]volume=0.3,aformat=channel_layouts=stereo[hum];[0][hum]amix=2:duration=first" \
    "$folder/piece.wav"

export PULSE_RUNTIME_PATH=$folder XDG_RUNTIME_DIR=$folder PULSE_SERVER=unix:$folder/native
export JACK_NO_START_SERVER=1 LIBGL_ALWAYS_SOFTWARE=1
# As on a desktop: the server itself is real-time where that is allowed.
pulseaudio -n --daemonize=no --exit-idle-time=-1 --realtime=yes --high-priority=yes \
    --disable-shm=yes --use-pid-file=no \
    -L "module-native-protocol-unix socket=$folder/native" \
    -L "module-null-sink sink_name=raks rate=48000" \
    -L "module-null-sink sink_name=paplay rate=48000" >"$folder/pulse.log" 2>&1 &
pids+=($!)
until pactl info >/dev/null 2>&1; do sleep 0.1; done
pactl set-default-sink raks
Xvfb -displayfd 7 -screen 0 1280x720x24 -nolisten tcp 7>"$folder/display" 2>/dev/null &
pids+=($!)
until [ -s "$folder/display" ]; do sleep 0.1; done
export DISPLAY=:$(cat "$folder/display")

real_time=()
chrt -f 40 true 2>/dev/null && real_time=(chrt -f 40)
for sink in raks paplay; do
    "${real_time[@]}" parec --device=$sink.monitor --rate=48000 --channels=2 --format=s16le \
        --latency-msec=100 --raw >"$folder/$sink.raw" &
    pids+=($!)
done
for ((i = 0; i < loops; ++i)); do
    (while :; do :; done) &
    pids+=($!)
done
paplay --device=paplay --latency-msec="$buffer" "$folder/piece.wav" &
pids+=($!)
"$raks" play "$folder/piece.wav" --size 1280x720 --quit --duration "$seconds" --buffer "$buffer" \
    >"$folder/raks.log" 2>&1 || cat "$folder/raks.log"
grep -v "playing\|sound goes to" "$folder/raks.log" || true

# Holes of the part that both played: from 2 s after the start of sound to 2 s before raks ended.
for sink in raks paplay; do
    ffmpeg -loglevel info -f s16le -ar 48000 -ac 2 -i "$folder/$sink.raw" \
        -af "silenceremove=start_periods=1:start_threshold=-60dB,atrim=2:$((seconds - 2)),silencedetect=noise=-60dB:duration=0.003" \
        -f null - 2>&1 | tr '\r' '\n' |
        awk -v name=$sink -v buffer="$buffer" '
            /silence_duration/ { ++holes; ms += 1000 * $NF; where = where sprintf(" %.1f", $(NF - 3)) }
            END { printf "%s, buffer %d ms: %d holes over 3 ms, %.0f ms in all%s\n", name, buffer, holes, ms, where == "" ? "" : ", at" where " s" }'
done
