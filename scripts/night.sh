#!/usr/bin/env bash
# A night in short: `raks play` plays clicks and `raks live` hears them, on a PulseAudio server of their
# own, while every minute something goes wrong: the server is killed and comes back, the default
# changes, a sink is removed, the programs are stopped for 5 s, the processor is busy, who is told of the
# beats is killed and comes back, the disk that beats are written to is full, the default sink is 300 ms
# late. At the end both must be there, with no thread or descriptor more than at the start, no growing
# memory, and the tempo of the music. A last minute without a fault counts the beats that each target
# gets, and measures how far from the clicks they arrive.
#   scripts/night.sh [MINUTES]     30 when not given; 6 at least
# Needs the packages of scripts/setup.sh. Prints a line a minute; exit code 1 when something is wrong.
set -euo pipefail
cd "$(dirname "$0")/.."
minutes=${1:-30}
raks=$PWD/build/release/bin/raks
folder=$(mktemp -d)
pids=()
stop() {
    for pid in "${pids[@]}" ${server:-} ${receiver:-} ${far_server:-}; do kill "$pid" 2>/dev/null || true; done
    wait 2>/dev/null || true
    rm -rf "$folder"
}
trap stop EXIT

bpm=128
"$raks" synth clicks -o "$folder/clicks.wav" --bpm $bpm --duration 600
export PULSE_RUNTIME_PATH=$folder XDG_RUNTIME_DIR=$folder PULSE_SERVER=unix:$folder/native
export JACK_NO_START_SERVER=1
unset DISPLAY
add_sink() {  # NAME DESCRIPTION RATE
    pactl load-module module-null-sink sink_name="$1" rate="$3" \
        sink_properties="device.description='$2'" >/dev/null
}
start_server() {
    rm -f "$folder/native"
    pulseaudio -n --daemonize=no --exit-idle-time=-1 --realtime=no --high-priority=no \
        --disable-shm=yes --use-pid-file=no -L "module-native-protocol-unix socket=$folder/native" \
        -L "module-null-sink sink_name=speakers rate=$1 sink_properties=device.description=Speakers" \
        >>"$folder/server.log" 2>&1 &
    server=$!
    until pactl info >/dev/null 2>&1; do sleep 0.1; done
    add_sink headphones Headphones 44100
    pactl set-default-sink speakers
}
start_server 48000
# A server of JACK for the MIDI clock alone: no sound goes through it.
export JACK_DEFAULT_SERVER=raks-night-$$
jackd -n "$JACK_DEFAULT_SERVER" --no-realtime -d dummy -p 256 >>"$folder/server.log" 2>&1 &
pids+=($!)
jack_wait -s "$JACK_DEFAULT_SERVER" -w -t 10 >/dev/null 2>&1
"$raks" live --headless --audio-system pulse 2>"$folder/live.err" &
live=$!
# Beats by all protocols, to a receiver that counts them and to peers that are not there.
hear_beats() {
    python3 tests/receivers/count_beats.py --listen $bpm 17791 17792 17793 17794 >>"$folder/beats" &
    receiver=$!
}
hear_beats
"$raks" play "$folder/clicks.wav" --headless --repeat --audio-system pulse --lines /dev/null --osc 127.0.0.1:17791,rate=50 \
    --wled 127.0.0.1:17792 --os2l 127.0.0.1:17793 --vmc 127.0.0.1:17794 --midi-clock mclk_in --osc 127.0.0.1:17795 --osc no-such-host.invalid:9000 --os2l 127.0.0.1:1 2>"$folder/play.err" &
play=$!
pids+=($live $play)

kilobytes() { awk '/^VmRSS/ { print $2 }' "/proc/$1/status"; }
count() { find "/proc/$1/$2" -mindepth 1 -maxdepth 1 | wc -l; }
state() { echo "$(count "$1" task) threads, $(count "$1" fd) files, $(kilobytes "$1") kB"; }
# A sink behind a second server, which sounds 300 ms late.
add_far_sink() {
    pulseaudio -n --daemonize=no --exit-idle-time=-1 --realtime=no --high-priority=no --disable-shm=yes \
        --use-pid-file=no -L "module-native-protocol-unix socket=$folder/far" \
        -L "module-null-sink sink_name=far rate=48000" >>"$folder/server.log" 2>&1 &
    far_server=$!
    until pactl --server="unix:$folder/far" info >/dev/null 2>&1; do sleep 0.1; done
    far_module=$(pactl load-module module-tunnel-sink server="unix:$folder/far" sink=far sink_name=late \
        latency_msec=300)
}
faults=(kill switch remove stop busy peer disk late)
wreck() {
    case $1 in
        kill)
            kill -KILL "$server"
            wait "$server" 2>/dev/null || true
            sleep 3
            start_server $((RANDOM % 2 ? 44100 : 48000)) ;;
        switch)
            pactl set-default-sink headphones
            sleep 20
            pactl set-default-sink speakers ;;
        remove)
            pactl unload-module "$(pactl list short modules | awk '/sink_name=speakers/ { print $1 }')"
            sleep 10
            add_sink speakers Speakers 96000
            pactl set-default-sink speakers ;;
        stop)
            kill -STOP $live $play
            sleep 5
            kill -CONT $live $play ;;
        peer)
            kill -KILL $receiver
            wait $receiver 2>/dev/null || true
            sleep 20
            hear_beats ;;
        disk)
            timeout -s INT 20 "$raks" play "$folder/clicks.wav" --headless --volume 0 --lines /dev/full \
                2>"$folder/disk.err" || [ $? -eq 124 ] || disk_trouble="it ends"
            [ "$(grep -c "No space left" "$folder/disk.err")" -eq 1 ] || disk_trouble="it is not said once" ;;
        late)
            add_far_sink
            pactl set-default-sink late
            sleep 20
            pactl set-default-sink speakers
            pactl unload-module "$far_module"
            kill "$far_server"
            wait "$far_server" 2>/dev/null || true ;;
        busy)
            for i in 1 2 3 4; do timeout 15 sh -c 'while :; do :; done' & done
            sleep 15 ;;
    esac
}

sleep 30  # until all is loaded
first_live=$(state $live) first_play=$(state $play)
echo "start: live $first_live; play $first_play"
for ((minute = 1; minute <= minutes; ++minute)); do
    next=$((SECONDS + 60))
    fault=${faults[$(((minute - 1) % ${#faults[@]}))]}
    wreck "$fault"
    sleep $((next > SECONDS ? next - SECONDS : 0))
    for pid in $live $play; do
        kill -0 $pid 2>/dev/null || { echo "a program is gone after '$fault'"; cat "$folder"/*.err; exit 1; }
    done
    echo "$minute ($fault): live $(state $live); play $(state $play)"
    echo "$minute $(kilobytes $live) $(kilobytes $play)" >>"$folder/memory"
done

last_live=$(state $live) last_play=$(state $play)
# A minute without a fault, heard by receivers that see nothing else.
kill $receiver
wait $receiver || true
hear_beats
(timeout 30 stdbuf -oL jack_mclk_dump -n >"$folder/clock" 2>&1 || true) &
sleep 10
PULSE_RUNTIME_PATH=$folder python3 tests/receivers/late_sink.py --running speakers 17795 40 >"$folder/landing"
kill $receiver
wait $receiver || true
kill -INT $live $play
live_code=0 play_code=0
wait $live || live_code=$?
wait $play || play_code=$?
fault=0
wrong() { echo "WRONG: $*"; fault=1; }
echo "beats of the last minute: $(tail -n 1 "$folder/beats")"
python3 - "$(tail -n 1 "$folder/beats")" <<'EOF' || wrong "a target misses beats, or gets one twice"
import json, sys
told = json.loads(sys.argv[1])
sys.exit(not all(told[name]["came"] > 80 and told[name]["left_out"] == told[name]["twice"] == 0
                 for name in ("osc", "os2l", "wled")) or told["vmc_frames"] < 2000)
EOF
echo "OSC against the clicks at the monitor, which hears them some milliseconds late: $(cat "$folder/landing")"
python3 -c 'import json, sys; sys.exit(json.load(open(sys.argv[1]))["deviation_p99_ms"] > 10)' "$folder/landing" ||
    wrong "beats arrive at changing distances from the clicks"
echo "MIDI clocks: $(grep -c "^CLK" "$folder/clock"), the last: $(tail -n 2 "$folder/clock" | head -n 1)"
grep -o "cur: *[0-9.]*" "$folder/clock" | awk '{ near += $2 > 125 && $2 < 131 } END { exit near < 0.9 * NR }' ||
    wrong "the MIDI clock is not that of the music"
[ -z "$(grep "nobody listens there\|closed the connection\|reset by peer" "$folder/play.err" | sort | uniq -d)" ] ||
    wrong "a lost peer is said more than once"
[ -z "${disk_trouble:-}" ] || wrong "with a full disk $disk_trouble"
[ $live_code -eq 130 ] && [ $play_code -eq 130 ] || wrong "exit codes $live_code and $play_code, not 130"
[ "${last_live%,*}" = "${first_live%,*}" ] || wrong "live had $first_live, has $last_live"
[ "${last_play%,*}" = "${first_play%,*}" ] || wrong "play had $first_play, has $last_play"
# Memory: the median slope between any two minutes of the second half, where caches are filled. One step
# is no growth.
python3 - "$folder/memory" <<'EOF' || wrong "memory grows by more than 1 MB an hour"
import statistics, sys
rows = [list(map(int, line.split())) for line in open(sys.argv[1])]
rows = rows[len(rows) // 2:]
slopes = {name: statistics.median([60 * (b[i] - a[i]) / (b[0] - a[0]) for a in rows for b in rows if a[0] < b[0]] or [0])
          for i, name in ((1, "live"), (2, "play"))}
for name, slope in slopes.items():
    print(f"{name}: {slope:+.0f} kB an hour")
sys.exit(max(slopes.values()) > 1024)
EOF
grep "tempo" "$folder/live.err"
grep -q "tempo 12[78]" "$folder/live.err" || wrong "live has lost the tempo, 128 BPM"
grep -v "device\|sound goes to\|listening to\|playing\|tempo\|gone" "$folder/live.err" "$folder/play.err" || true
exit $fault
