#!/usr/bin/env bash
# Two phones, no markers: a dance is filmed by two simulated phones in a room with its music, captured by
# what a person types, and laid beside the truth; then both are learnt and danced, and laid beside each other.
#   scripts/capture_two_phones.sh DANCE FOLDER [SECONDS [OPTIONS OF SIMULATE...]]
# DANCE: as `raks dance --dance` takes it (salsa, belly, or a folder), for SECONDS (60) of a song of its own,
# whose style STYLE names (DANCE). The phones stand 85 degrees apart, film 60 and 30 pictures a second, and
# have clocks of their own. RAKS names the program. Films that are there are not drawn again. Needs ffmpeg
# and python3. Fails where a figure is beyond what is wanted.
set -euo pipefail
if [ $# -lt 2 ]; then
    sed -n '2,8s/^# *//p' "$0" >&2
    exit 2
fi
here=$(cd "$(dirname "$0")/.." && pwd)
raks=${RAKS:-$here/build/release/bin/raks}
dance=$1 folder=$2 seconds=${3:-60}
style=${STYLE:-$dance}
shift $(($# > 3 ? 3 : $#))
mkdir -p "$folder"
song=$folder/song.wav truth=$folder/film/truth/dance.bvh phones=$folder/phones

"$raks" synth "$style" --duration "$seconds" --seed 1 --beats "$folder/song.beats" -o "$song"
if [ ! -e "$truth" ]; then
    "$raks" dance "$song" --dance "$dance" --seed 1 -o "$folder/danced.bvh"
    "$raks" capture simulate "$folder/danced.bvh" -o "$folder/film" --no-markers --no-board --cameras 2 \
        --camera-angle 85 --rate 30 --rate cam2=60 --music "$song" --clock-error 2 --drift 40 "$@"
fi

# What a person has: two films and the song.
mkdir -p "$phones"
cp -n "$folder"/film/cam?.mp4 "$song" "$phones/"
begun=$(cut -d ' ' -f 14-17 /proc/$$/stat)
SECONDS=0
"$raks" capture run "$phones" --markerless --height 1.714 --music "$phones/song.wav" |
    tee "$folder/next.txt" || [ "${PIPESTATUS[0]}" -eq 3 ]
# Of this shell and of what it waited for, in hundredths of a second.
worked=$(echo "$begun $(cut -d ' ' -f 14-17 /proc/$$/stat)" | awk '{ print ($5 + $6 + $7 + $8 - $1 - $2 - $3 - $4) / 100 }')
echo "== the whole run took $SECONDS s, of the processors $worked s"

# Where in the song it begins is where in the true dance it begins.
offset=$(sed -n 's/.*--offset \(-\{0,1\}[0-9.]*\) -o .*/\1/p' "$folder/next.txt" | tail -n 1)
"$raks" capture compare "$truth" "$phones/dance.bvh" --align --shift "$offset"
"$raks" capture compare "$truth" "$phones/dance.bvh" --align --shift "$offset" --json > "$folder/captured.json"
"$raks" stick "$truth" "$phones/dance.bvh" --shift "$offset" --align rigid --side-by-side -o "$folder/pair.png" |
    tail -n 1

# The printed line learns it. So does the true motion, which begins with the song; of a figure by the same
# repeats, since a dancer who varies gives a choice.
export XDG_DATA_HOME=$folder/home
rm -rf "$XDG_DATA_HOME"
line=$(tail -n 1 "$folder/next.txt")
echo "== $line"
eval "\"$raks\"${line#raks}"
kind=$(cut -d ' ' -f 3 <<< "$line")
labels=()
if [ "$kind" = figure ]; then
    eval "\"$raks\"${line#raks}" --propose "$folder/repeats.tsv" > /dev/null
    # Both may have rates of their own. Beats are not heard to the very end of the song.
    frame_time() { sed -n 's/^Frame Time: *//p' "$1"; }
    awk -F'\t' -v OFS='\t' -v shift="$offset" -v all="$seconds" \
        -v from="$(frame_time "$phones/dance.bvh")" -v to="$(frame_time "$truth")" '
        function moved(frame) { return int((frame * from + shift) / to + .5) }
        /^#/ { next }
        !names { names = 1; for (i = 1; i <= NF; ++i) at[$i] = i; print; next }
        { $at["start"] = moved($at["start"]); $at["end"] = moved($at["end"]) }
        $at["end"] * to < all - 3 { print }
    ' "$folder/repeats.tsv" > "$folder/true_repeats.tsv"
    labels=(--labels "$folder/true_repeats.tsv")
fi
"$raks" train "$kind" "$truth" --music "$song" --offset 0 "${labels[@]}" -o true
for which in mine true; do
    "$raks" dance "$song" --dance "$which" --seed 1 -o "$folder/dances_$which.bvh"
done
"$raks" capture compare "$folder/dances_true.bvh" "$folder/dances_mine.bvh" --json > "$folder/danced.json"

# Twelve seconds of truth, capture and dance, side by side, for the report: 15 frames a second of each.
cut_bvh() { # FILE FROM OUTPUT
    awk -v from="$2" '
        /^Frames:/ { next }
        /^Frame Time:/ { time = $3; first = int(from / time + .5); step = int(1 / (15 * time) + .5); body = 1; next }
        !body { print; next }
        { frame = row++ - first; if (frame >= 0 && frame % step == 0 && count < 180) kept[count++] = $0 }
        END { print "Frames: " count; print "Frame Time: " step * time; for (i = 0; i < count; ++i) print kept[i] }
    ' "$1" > "$3"
}
mkdir -p "$folder/parts"
from=$(awk -v all="$seconds" -v begins="$offset" 'BEGIN { at = all / 3; print (at > begins ? at : begins) }')
cut_bvh "$truth" "$from" "$folder/parts/truth.bvh"
cut_bvh "$phones/dance.bvh" "$(awk "BEGIN { print $from - $offset }")" "$folder/parts/capture.bvh"
cut_bvh "$folder/dances_mine.bvh" "$from" "$folder/parts/dance.bvh"
"$raks" stick "$folder/parts/truth.bvh" "$folder/parts/capture.bvh" --side-by-side --align rigid --size 848x480 \
    -o "$folder/parts/two.mp4" | tail -n 1
"$raks" stick "$folder/parts/dance.bvh" --size 424x480 -o "$folder/parts/third.mp4"
ffmpeg -v error -y -i "$folder/parts/two.mp4" -i "$folder/parts/third.mp4" -filter_complex hstack "$phones/side_by_side.mp4"
"$raks" capture report "$phones"

# What came of it beside what is wanted; fails where something is beyond. A dance of takes keeps the tempo of
# the song by itself: its table says it in whole beats a minute.
python3 - "$folder" << 'END'
import glob, json, re, sys
folder = sys.argv[1]
captured = json.load(open(folder + "/captured.json"))
danced = json.load(open(folder + "/danced.json"))
beats = [float(line.split()[0]) for line in open(folder + "/song.beats")]
song = 60 * (len(beats) - 1) / (beats[-1] - beats[0])
mine = folder + "/home/raks/dances/mine/"
models = [json.load(open(name))["learnt_tempo"] for name in glob.glob(mine + "*.json")]
listed = float(re.search(r"likely_tempo = (.*)", open(mine + "dances.toml").read()).group(1))
tempo = models[0] if models else listed
rows = [
    ("joints in the world, mm", 1e3 * captured["world"], 60),
    ("up, degrees off", captured["alignment"]["up_off"], 3),
    ("scale, % off", 100 * abs(captured["alignment"]["scale"] - 1), 3),
    ("legs, degrees", captured["legs_angle"], 7),
    ("arms, degrees", captured["arms_angle"], 14),
    ("planted toes, m/s (p90)", captured["planted_toes"], 0.2),
    ("learnt tempo, % off", 100 * abs(tempo / song - 1), 1),
    ("danced, mm from the hips from what the truth teaches", 1e3 * danced["from_hips"], 70),
]
for name, value, most in rows:
    print(f"== {name}: {value:.2f} (wanted {most}){'' if value <= most else '  BEYOND'}")
sys.exit(any(value > most for _, value, most in rows))
END
