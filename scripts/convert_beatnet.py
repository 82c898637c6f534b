#!/usr/bin/env python3
"""Writes BeatNet's weights as Raks reads them: models/pretrained/beatnet.weights.

    scripts/convert_beatnet.py beatnet_f16.npz models/pretrained/beatnet.weights

Needs numpy, and is run once: the file that it writes is kept with the sources. beatnet_f16.npz (2.2 MB, sha256
b74bf9bb5beff60d08c6f4fa170dff7c968f1bba51a16881023711434813039b) holds the three networks of PyPI's BeatNet 1.1.3
(CC BY 4.0, see NOTICE.md) with their large arrays as half floats. Network 1 is taken, which its authors trained without
GTZAN (model_1_weights.pt, sha256 619091bc317ca3e83b45591d46f6de3d5a41588bcb39fe9fe7be30cffa6aca84).

The form of the file is described in docs/reference/files.md.
"""
import hashlib
import struct
import sys

import numpy as np

from convert_tagger import fnv, packed

SOURCE = "b74bf9bb5beff60d08c6f4fa170dff7c968f1bba51a16881023711434813039b"
NETWORK = 1
# In the order of the file.
ARRAYS = ["conv.kernel", "conv.bias", "dense.kernel", "dense.bias", "lstm1.input", "lstm1.state", "lstm1.bias",
          "lstm2.input", "lstm2.state", "lstm2.bias", "out.kernel", "out.bias"]


def filters(bank):
    """First bin and number of bins of each filter, and the weights of all, one after the other.

    BeatNet was trained on sound resampled to 22.05 kHz, which falls off towards 11 kHz. Raks' spectrum does not: the
    weights do instead. Without it the three highest bands are .03 too high, and beats differ by up to .4 from BeatNet's."""
    bank = bank / (1 + np.exp((np.arange(len(bank)) - 690) / 25))[:, None]
    first, count, weights = [], [], []
    for column in bank.T:
        used = np.flatnonzero(column)
        first.append(used[0])
        count.append(used[-1] + 1 - used[0])
        weights.append(column[used[0]:used[-1] + 1])
    return np.float32(first), np.float32(count), np.float32(np.concatenate(weights))


def main(source, target):
    with open(source, "rb") as file:
        if hashlib.sha256(file.read()).hexdigest() != SOURCE:
            sys.exit(source + ": is not the file that this script is for, see its head")
    kept = np.load(source)
    arrays = list(zip(["bank.first", "bank.count", "bank.weights"], filters(kept["bank"])))
    arrays += [(name, kept["%d/%s" % (NETWORK, name)]) for name in ARRAYS]
    data = b"raks-beatnet\n" + struct.pack("<HH", 1, len(arrays))
    data += b"".join(packed(name, array) for name, array in arrays)
    with open(target, "wb") as file:
        file.write(data + struct.pack("<Q", fnv(data)))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
