#!/usr/bin/env python3
"""Judges the tempo that `raks train figure CLIP --once` hears in a clip.

    scripts/judge_once.py make FOLDER [--seed N]        72 clips: six dances at four tempi, cut to 8, 16 and 32 beats
    scripts/judge_once.py judge FOLDER                  how many beats and which tempo each gets, beside what it has
    scripts/judge_once.py clips TABLE FOLDER            the same of clips of others: TABLE has NAME and tempi, by tabs

RAKS names the program, else build/release/bin/raks. A clip is right where its beats are and its
tempo is within 2 %; "said" where the right count is among those that are named. Clips of others
are right within 4 % of a tempo in the table, or an octave of it.
"""
import argparse
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent.parent
RAKS = os.environ.get("RAKS", str(HERE / "build/release/bin/raks"))
# Lowest and highest tempo of each dance, as models/trained/dances.toml has them.
DANCES = {
    "salsa": (160, 220),
    "belly": (90, 150),
    "house": (112, 136),
    "hiphop": (70, 115),
    "rock": (80, 180),
    "waltz": (80, 200),
}
SHARES = (0.1, 0.37, 0.63, 0.9)  # of the range, on a scale of octaves
LENGTHS = (8, 16, 32)
FPS = 60.0
FIRST = 6.0  # seconds of music after which dancing has begun


def raks(*arguments):
    return subprocess.run([RAKS, *map(str, arguments)], capture_output=True, text=True)


def tempi_of(dance, shares=SHARES):
    lowest, highest = DANCES[dance]
    return [round(lowest * (highest / lowest) ** share, 1) for share in shares]


def cut(bvh, to, start, frames):
    """Writes `frames` rows of a BVH from a row on."""
    lines = bvh.read_text().split("\n")
    at = next(i for i, line in enumerate(lines) if line.startswith("Frames:"))
    rows = lines[at + 2 : at + 2 + int(lines[at].split()[1])]
    kept = rows[start : start + frames]
    if len(kept) < frames:
        sys.exit(f"{bvh}: too short")
    to.write_text("\n".join([*lines[:at], f"Frames: {frames}", lines[at + 1], *kept]) + "\n")


def make(folder, seed, shares):
    folder.mkdir(parents=True, exist_ok=True)
    for dance in DANCES:
        for bpm in tempi_of(dance, shares):
            name = f"{dance}_{bpm:g}"
            if all((folder / f"{name}_{n}.bvh").exists() for n in LENGTHS):
                continue
            with tempfile.TemporaryDirectory() as temporary:
                song, danced = (pathlib.Path(temporary) / x for x in ("s.wav", "s.bvh"))
                beats = pathlib.Path(temporary) / "s.beats"
                seconds = FIRST + 64 * 60.0 / bpm + 4.0
                for done in (
                    raks("synth", dance, "--bpm", bpm, "--duration", seconds, "--seed", seed, "-o", song, "--beats", beats),
                    raks("dance", song, "--dance", dance, "--seed", seed, "--fps", FPS, "-o", danced),
                ):
                    if done.returncode:
                        sys.exit(done.stderr)
                downbeats = [float(line.split()[0]) for line in beats.read_text().splitlines() if line.split()[1:] == ["1"]]
                start = next(time for time in downbeats if time >= FIRST)
                for n in LENGTHS:
                    cut(danced, folder / f"{name}_{n}.bvh", round(start * FPS), round(n * 60.0 / bpm * FPS))
                    start += 8 * 60.0 / bpm
            print(name, flush=True)


def heard(clip):
    """(beats, BPM) of all ways that are said, the one that is taken first."""
    with tempfile.TemporaryDirectory() as temporary:
        done = raks("train", "figure", clip, "--once", "-o", pathlib.Path(temporary) / "x.json")
    counts = re.findall(r"(\d+) beats at ([\d.]+) BPM", done.stdout)
    if done.returncode or not counts:
        return [(0, 1.0)], done.stderr
    return [(int(beats), float(bpm)) for beats, bpm in counts], ""


def judge(folder):
    right, said, all_clips = {}, {}, {}
    for clip in sorted(folder.glob("*.bvh")):
        dance, bpm, beats = clip.stem.split("_")
        bpm, beats = float(bpm), int(beats)
        counts, error = heard(clip)
        fits = [n == beats and abs(t / bpm - 1.0) < 0.02 for n, t in counts]
        octaves = [abs(abs(math.log2(t / bpm)) - 1.0) < 0.03 for n, t in counts]
        all_clips[dance] = all_clips.get(dance, 0) + 1
        right[dance] = right.get(dance, 0) + fits[0]
        said[dance] = said.get(dance, 0) + any(fits)
        if not fits[0]:
            print(clip.stem, "heard as", counts, "said" if any(fits) else "NOT SAID", "octave" if octaves[0] else "", error)
    for dance, count in all_clips.items():
        print(f"{dance}: {right[dance]} of {count} right, the others said in {said[dance] - right[dance]}")
    count = sum(all_clips.values())
    print(f"all: {sum(right.values())} of {count} right, {sum(said.values())} of {count} said")


def clips(table, folder):
    right = count = 0
    for line in table.read_text().splitlines():
        name, *tempi = line.split("\t")
        if name.startswith("#"):
            continue
        counts, error = heard(folder / f"{name}.bvh")
        bpm = counts[0][1]
        fits = any(abs(bpm * 2.0**octave / float(t) - 1.0) < 0.04 for t in tempi for octave in (-1, 0, 1))
        count += 1
        right += fits
        print(f"{name}: {bpm} BPM, {'right' if fits else 'wrong'}: {', '.join(tempi)} {error}")
    print(f"all: {right} of {count} within 4 % or an octave")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("make", "judge", "clips"))
    parser.add_argument("paths", nargs="+", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--shares", type=float, nargs="+", default=SHARES, help="of each dance's range of tempi")
    arguments = parser.parse_args()
    if arguments.what == "make":
        make(arguments.paths[0], arguments.seed, arguments.shares)
    elif arguments.what == "judge":
        judge(arguments.paths[0])
    else:
        clips(*arguments.paths)


if __name__ == "__main__":
    main()
