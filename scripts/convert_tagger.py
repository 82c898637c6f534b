#!/usr/bin/env python3
"""Writes the music tagger's weights as Raks reads them: models/pretrained/msd_musicnn.tagger.

    scripts/convert_tagger.py msd_musicnn.npz models/pretrained/msd_musicnn.tagger

Needs numpy, and is run once: the file that it writes is kept with the sources. msd_musicnn.npz (313 kB, sha256
d1eecdb07190751fdd52ca8b29192c7678fb4a37cfad007228246a526b02e6e2) holds the network MSD_musicnn of PyPI's musicnn 0.1.0
(ISC, see NOTICE.md) without TensorFlow's training variables and without the filters that training left dead, whose
constants are folded into the biases behind them: the outputs are the same. It was made from the wheel's checkpoint
MSD_musicnn/.data-00000-of-00001, sha256 8579734ee6388f799ed0def4bbd0d1fdcbeaf213ef2a9dc860917bd76a303de6.

The form of the file is described in docs/reference/files.md.
"""
import hashlib
import struct
import sys

import numpy as np

SOURCE = "d1eecdb07190751fdd52ca8b29192c7678fb4a37cfad007228246a526b02e6e2"
# In the order of the file; each name has these parts.
LAYERS = ("timbre38", "timbre67", "time128", "time64", "time32", "middle1", "middle2", "middle3")
ARRAYS = (["input.scale", "input.shift"]
          + [layer + part for layer in LAYERS for part in (".kernel", ".bias", ".scale", ".shift")]
          + ["middle1.taps", "middle2.taps", "middle3.taps", "a.constant", "a.index", "b2.constant", "b2.index",
             "c3.constant", "c3.index", "dense.kernel", "dense.bias", "embedding.scale", "embedding.shift",
             "tags.kernel", "tags.bias"])


def fnv(data):
    """FNV-1a, 64 bits, as base/hash.hpp has it."""
    value = 14695981039346656037
    for byte in data:
        value = (value ^ byte) * 1099511628211 & 0xffffffffffffffff
    return value


def packed(name, array):
    """One array: name, kind, sizes, values. Indices are written as floats, which hold them exactly."""
    half = array.dtype == np.float16
    head = struct.pack("<B", len(name)) + name.encode() + (b"h" if half else b"f")
    sizes = struct.pack("<B%dI" % array.ndim, array.ndim, *array.shape)
    return head + sizes + array.astype("<f2" if half else "<f4").tobytes()


def main(source, target):
    with open(source, "rb") as file:
        if hashlib.sha256(file.read()).hexdigest() != SOURCE:
            sys.exit(source + ": is not the file that this script is for, see its head")
    weights = np.load(source)
    data = b"raks-tagger\n" + struct.pack("<HH", 1, len(ARRAYS))
    data += b"".join(packed(name, weights[name]) for name in ARRAYS)
    with open(target, "wb") as file:
        file.write(data + struct.pack("<Q", fnv(data)))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
