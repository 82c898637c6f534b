#!/usr/bin/env bash
# Makes sound files of every kind that people have: formats by rates, channels, tags and damage. What
# Raks reads of them is compared with what ffmpeg decodes by the test program raks_tests_audio_io.
#   scripts/sound_zoo.sh FOLDER [short]     short: about a fifth of them
# Needs ffmpeg, sox, flac, lame and opus-tools. Names say what a file is; `late-` and `gap-` mark
# those whose time line has silence that no sample holds, `cut-` those that end in the middle.
set -euo pipefail
folder=$1 short=${2:-}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# source_wav RATE-CHANNELS makes $work/RATE-CHANNELS.wav where it is not there yet. 6 s: two tones that
# rise, a click twice a second and some noise; each channel another pitch.
source_wav() {
    local rate=${1%-*} channels=${1#*-} expression="" i
    [ ! -f "$work/$1.wav" ] || return 0
    for ((i = 0; i < channels; ++i)); do
        expression+="${expression:+|}0.3*sin(2*PI*t*($((180 + 70 * i))+60*t))+0.3*lt(mod(t\,0.5)\,0.004)+0.05*(random($i)-0.5)"
    done
    ffmpeg -v error -y -f lavfi -i "aevalsrc=exprs='$expression':s=$rate:d=6" -c:a pcm_s24le "$work/$1.wav"
}
for name in 22050-1 44100-2 48000-2; do  # others when `ff` needs them
    source_wav "$name"
done
ffmpeg -v error -y -f lavfi -i "testsrc=size=96x64:rate=10:d=6" -c:v libx264 -pix_fmt yuv420p "$work/film.mp4"
ffmpeg -v error -y -f lavfi -i "testsrc=size=600x600:rate=1:d=1" -frames:v 1 "$work/cover.png"

count=0
# keep: whether this one is made; of a short zoo every fifth.
keep() { count=$((count + 1)); [ "$short" != short ] || [ $((count % 5)) -eq 1 ]; }
ff() {  # NAME SOURCE OPTIONS...
    local name=$1 source=$2
    shift 2
    keep || return 0
    source_wav "$source"
    ffmpeg -v error -y -i "$work/$source.wav" "$@" "$folder/$name"
}

# WAV and its relatives.
for codec in pcm_u8 pcm_s16le pcm_s24le pcm_s32le pcm_f32le pcm_f64le pcm_alaw pcm_mulaw adpcm_ms adpcm_ima_wav; do
    ff "wav-$codec.wav" 44100-2 -c:a $codec
    ff "wav-$codec-mono-16k.wav" 16000-1 -c:a $codec
done
for rate in 8000 11025 22050 32000 48000 96000 192000; do
    ff "wav-$rate.wav" "$rate-2" -c:a pcm_s16le
done
ff "wav-six.wav" 48000-6 -c:a pcm_s16le
ff "wav-tagged.wav" 44100-2 -c:a pcm_s16le -metadata title=Rita -metadata artist=Nobody
ff "wav-rf64.wav" 44100-2 -c:a pcm_s16le -rf64 always
ff "wav-mp3.wav" 44100-2 -c:a libmp3lame
ff "w64.w64" 48000-2 -c:a pcm_s24le
ff "aiff.aiff" 44100-2 -c:a pcm_s16be
ff "aiff-24.aiff" 48000-2 -c:a pcm_s24be
ff "aiff-float.aiff" 48000-1 -c:a pcm_f32be
ff "au.au" 44100-2 -c:a pcm_s16be
ff "caf.caf" 48000-2 -c:a pcm_s16le
ff "caf-alac.caf" 48000-2 -c:a alac
# Lossless.
for rate in 16000 22050 44100 48000 96000 192000; do
    ff "flac-$rate.flac" "$rate-2" -c:a flac
done
ff "flac-mono.flac" 44100-1 -c:a flac -sample_fmt s16
ff "flac-six.flac" 48000-6 -c:a flac
ff "flac-ogg.ogg" 48000-2 -c:a flac
ff "alac.m4a" 44100-2 -c:a alac
ff "wavpack.wv" 44100-2 -c:a wavpack
ff "tta.tta" 44100-2 -c:a tta -sample_fmt s16
# MP3 and MP2.
for rate in 8000 11025 16000 22050 32000 44100 48000; do
    ff "mp3-$rate.mp3" "$rate-2" -c:a libmp3lame -b:a 64k
    ff "mp3-vbr-$rate.mp3" "$rate-1" -c:a libmp3lame -q:a 4
done
ff "mp3-noxing.mp3" 44100-2 -c:a libmp3lame -b:a 128k -write_xing 0
ff "mp3-id3v1.mp3" 44100-2 -c:a libmp3lame -write_id3v1 1 -metadata title=Rita
ff "mp3-untagged.mp3" 44100-2 -c:a libmp3lame -id3v2_version 0
ff "mp2.mp2" 48000-2 -c:a mp2
# AAC.
for rate in 16000 22050 44100 48000; do
    ff "aac-$rate.m4a" "$rate-2" -c:a aac -b:a 128k
    ff "aac-adts-$rate.aac" "$rate-2" -c:a aac -b:a 128k
done
ff "aac-mono.m4a" 44100-1 -c:a aac
ff "aac-six.m4a" 48000-6 -c:a aac -b:a 256k
ff "aac-fragmented.mp4" 48000-2 -c:a aac -movflags frag_keyframe+empty_moov
ff "aac-faststart.m4a" 48000-2 -c:a aac -movflags +faststart
# Vorbis and Opus.
for rate in 8000 16000 22050 44100 48000; do
    ff "vorbis-$rate.ogg" "$rate-2" -c:a libvorbis -q:a 5
done
ff "vorbis-mono.ogg" 44100-1 -c:a libvorbis
ff "vorbis-six.ogg" 48000-6 -c:a libvorbis
ff "vorbis.webm" 48000-2 -c:a libvorbis
ff "vorbis.mkv" 44100-2 -c:a libvorbis
for rate in 8000 16000 24000 48000; do
    ff "opus-$rate.opus" 48000-2 -c:a libopus -ar "$rate"
done
ff "opus-mono.opus" 48000-1 -c:a libopus
ff "opus-six.opus" 48000-6 -c:a libopus -mapping_family 1
ff "opus.webm" 48000-2 -c:a libopus
ff "opus.mkv" 48000-2 -c:a libopus
# Others.
ff "wma2.wma" 44100-2 -c:a wmav2
ff "wma1.wma" 44100-2 -c:a wmav1
ff "ac3.ac3" 48000-6 -c:a ac3
ff "eac3.eac3" 48000-2 -c:a eac3
ff "amr.3gp" 8000-1 -c:a pcm_alaw -f mov
ff "matroska-pcm.mka" 48000-2 -c:a pcm_s16le
ff "matroska-flac.mka" 48000-2 -c:a flac
# Films, with the sound from their beginning on.
for name in "mp4-aac.mp4 aac" "mov-pcm.mov pcm_s16le" "avi-mp3.avi libmp3lame" "mkv-opus.mkv libopus" \
    "ts-aac.ts aac" "ts-mp2.ts mp2" "flv-mp3.flv libmp3lame" "mkv-vorbis.mkv libvorbis" "mpeg-mp2.mpg mp2"; do
    read -r file codec <<<"$name"
    video=copy
    [[ $file == *.mpg ]] && video=mpeg1video
    [[ $file == *.mpg ]] && rate=(-r 25) || rate=()
    keep && ffmpeg -v error -y -i "$work/film.mp4" -i "$work/44100-2.wav" -map 0:v -map 1:a -c:v $video \
        "${rate[@]}" -c:a "$codec" "$folder/film-$file"
done
# Films whose sound begins late.
for name in "mkv libopus" "mp4 aac" "mkv libvorbis" "mkv pcm_s16le"; do
    read -r ending codec <<<"$name"
    keep && ffmpeg -v error -y -i "$work/film.mp4" -itsoffset 1.7 -i "$work/48000-2.wav" -map 0:v -map 1:a \
        -c:v copy -c:a "$codec" "$folder/late-$codec.$ending"
done
# A film that was cut in time: 1.5 s of packets are not there.
for name in "mkv libopus" "mkv pcm_s16le" "mp4 aac"; do
    read -r ending codec <<<"$name"
    ffmpeg -v error -y -i "$work/48000-2.wav" -c:a "$codec" "$work/whole.$ending"
    keep && ffmpeg -v error -y -i "$work/whole.$ending" -c copy \
        -bsf:a "noise=drop='between(pts*tb\,2\,3.5)'" "$folder/gap-$codec.$ending"
done
# By other programs.
keep && lame --quiet -V 2 "$work/44100-2.wav" "$folder/lame-v2.mp3"
keep && lame --quiet --preset insane --tt Rita --ti "$work/cover.png" "$work/48000-2.wav" "$folder/lame-cover.mp3"
keep && lame --quiet --abr 120 -m j "$work/44100-2.wav" "$folder/lame-abr.mp3"
keep && opusenc --quiet --bitrate 96 "$work/44100-2.wav" "$folder/opusenc-44100.opus"
keep && opusenc --quiet --picture "$work/cover.png" "$work/48000-2.wav" "$folder/opusenc-cover.opus"
keep && flac --silent -8 --picture "$work/cover.png" -T TITLE=Rita "$work/44100-2.wav" -o "$folder/flac-cover.flac"
keep && flac --silent -0 --ogg "$work/48000-2.wav" -o "$folder/flac-0.oga"
for ending in aiff au 8svx voc; do
    keep && sox -V1 -D "$work/22050-1.wav" -b 16 "$folder/sox.$ending" 2>/dev/null
done
keep && sox -V1 -D "$work/48000-2.wav" -e floating-point -b 32 "$folder/sox-float.wav"
keep && sox -V1 -D "$work/48000-2.wav" "$folder/sox-gsm.wav" rate 8000 channels 1 >/dev/null 2>&1

# Lengths that no header tells, and ends that are not one.
keep && ffmpeg -v error -i "$work/44100-2.wav" -c:a pcm_s16le -f wav - >"$folder/piped.wav"
keep && sox -V1 -D "$work/44100-2.wav" -b 16 -t wav - 2>/dev/null >"$folder/sox-piped.wav"
keep && flac --silent -c - <"$work/44100-2.wav" >"$folder/flac-piped.flac"
ends() {  # NAME SOURCE OPTIONS...: joined, cut and with something behind it
    local name=$1 source=$2 ending=${1##*.}
    shift 2
    ffmpeg -v error -y -i "$work/$source.wav" "$@" "$work/$name"
    keep && head -c "$(($(stat -c %s "$work/$name") * 6 / 10))" "$work/$name" >"$folder/cut-$name"
    case $ending in
        mp3 | ogg | opus | aac)
            keep && cat "$work/$name" "$work/$name" >"$folder/joined-$name" ;;
    esac
    case $ending in
        wav | mp3 | flac)
            keep && { cat "$work/$name"; head -c 128 /dev/zero; } >"$folder/zeros-$name" ;;
    esac
    return 0  # also where none is kept
}
ends pcm.wav 44100-2 -c:a pcm_s16le
ends cbr.mp3 44100-2 -c:a libmp3lame -b:a 128k
ends vbr.mp3 44100-2 -c:a libmp3lame -q:a 3
ends vorbis.ogg 44100-2 -c:a libvorbis
ends opus.opus 48000-2 -c:a libopus
ends flac.flac 44100-2 -c:a flac
ends adts.aac 44100-2 -c:a aac
ends opus.mkv 48000-2 -c:a libopus
ends wma.wma 44100-2 -c:a wmav2
ends fragmented.mp4 48000-2 -c:a aac -movflags frag_keyframe+empty_moov -frag_duration 500000
