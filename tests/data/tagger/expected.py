#!/usr/bin/env python3
"""Writes expected.tsv: what the reference (numpy) of the music tagger says of the sound that music_tagger_test.cpp makes.

    tests/data/tagger/expected.py FOLDER >tests/data/tagger/expected.tsv

FOLDER holds reference.py and msd_musicnn.npz (see scripts/convert_tagger.py). One line a patch: 200 numbers of the
embedding, then 50 logits. The sound is made of whole numbers, so that both programs have the same.
"""
import sys

import numpy as np

sys.path.insert(0, sys.argv[1])
import reference  # noqa: E402

SECONDS, BLOCK = 7, 256


def sound():
    """Buzzing tones, one a half second, with a hiss between them; twice as loud from 3 s on."""
    samples = np.zeros(SECONDS * reference.RATE, np.float32)
    state = 1
    for i in range(len(samples)):
        state = (state * 1664525 + 1013904223) % 2**32
        beat = i % 8000
        tone = (i * (1 + i // 8000 % 5)) % 219 * 128 - 13952
        value = tone * max(1000, 6000 - beat) // 6000
        if 4000 <= beat < 5000:
            value += ((state >> 16) - 32768) // 4
        samples[i] = np.float32(value * (2 if i >= 48000 else 1)) / np.float32(65536)
    return samples


def main():
    samples = sound()
    power = (samples[:len(samples) // BLOCK * BLOCK].reshape(-1, BLOCK).astype(np.float64) ** 2).mean(1)
    tagger, mean = reference.Tagger(), 0.0
    for i, value in enumerate(power):  # every block sounds
        mean += (value - mean) / min(i + 1, 625)
        if i % reference.PATCH == reference.PATCH - 1:
            first = i - reference.PATCH + 1
            # log_mel() pads with zeros; a block before and behind keeps them out of the patch's frames.
            start = max(0, first - 1) * BLOCK
            mel = reference.log_mel(samples[start:(i + 2) * BLOCK] * np.float32(np.sqrt(10 ** -1.8 / mean)))
            skipped = first - start // BLOCK
            logits, embedding = tagger(mel[skipped:skipped + reference.PATCH])
            print("\t".join("%.5f" % x for x in np.concatenate([embedding, logits])))


main()
