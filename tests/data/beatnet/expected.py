#!/usr/bin/env python3
"""Writes expected.tsv: what the reference (numpy) of BeatNet's network says of the bands that beatnet_test.cpp makes.

    tests/data/beatnet/expected.py FOLDER >tests/data/beatnet/expected.tsv

FOLDER holds reference.py and beatnet_f16.npz (see scripts/convert_beatnet.py). One line a frame: probability of a beat,
downbeats included, and of a downbeat. The bands are made of whole numbers, so that both programs have the same.
"""
import sys

import numpy as np

sys.path.insert(0, sys.argv[1])
import reference  # noqa: E402

FRAMES = 200


def bands():
    """A loud frame every 25, a softer one every 12 or 13, over a floor that moves a little."""
    rows = np.zeros((FRAMES, reference.BANDS), np.float32)
    for t in range(FRAMES):
        since = t % 25
        hit = max(0, 40 - 12 * since) if since < 12 else max(0, 24 - 12 * (since - 12))
        for b in range(reference.BANDS):
            rows[t, b] = np.float32((t * 7 + b * 13) % 29 + hit * (1 + (b + t // 25) % 3)) / np.float32(64)
    return rows


def main():
    levels = bands()
    rise = np.zeros_like(levels)
    rise[1:] = np.maximum(0, levels[1:] - levels[:-1])
    for row in reference.BeatNet(1)(np.concatenate([levels, rise], 1)):
        print("%.6f\t%.6f" % (row[0] + row[1], row[1]))


main()
