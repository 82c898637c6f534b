#!/usr/bin/env python3
"""Writes BlazePose's networks as Raks reads them: models/pretrained/blazepose_*.pose.

    npm pack @mediapipe/pose@0.5.1675469404 && tar xzf mediapipe-pose-0.5.1675469404.tgz
    scripts/convert_pose.py package FOLDER            # detector and full, which Raks ships
    scripts/convert_pose.py package FOLDER lite heavy # for raks capture keypoints --pose-model

Needs numpy. The same sources give the same bytes. Sources (Apache-2.0, see NOTICE.md) are the package's TensorFlow Lite
files; pose_solution_packed_assets.data is the detector. The form of the files is described in docs/reference/files.md:
the graph as ONNX, and its weights beside it as half floats, which OpenCV 4.6 does not read in ONNX. What is left out:
outputs that Raks does not use (the outline of the body, heat maps, joints in metres) and what leads to them alone.
Pictures are channel by channel here (1 x 3 x height x width), outputs are as they were.

OpenCV 4.6 wants the limits of Clip as attributes, and a shape at every output.
"""
import hashlib
import struct
import sys
from pathlib import Path

import numpy as np

# Name: file in the package, its sha256, what its outputs are called by their number.
NETWORKS = {
    "detector": ("pose_solution_packed_assets.data",
                 "a63c614bef30d35947f13be361820b1e4e3bec9cfeebf4d11216a18373108e85", {0: "boxes", 1: "scores"}),
    "lite": ("pose_landmark_lite.tflite",
             "f17bfbecadb61c3be1baa8b8d851cc6619c870a87167b32848ad20db306b9d61", {0: "points", 1: "flag"}),
    "full": ("pose_landmark_full.tflite",
             "e9a5c5cb17f736fafd4c2ec1da3b3d331d6edbe8a0d32395855aeb2cdfd64b9f", {0: "points", 1: "flag"}),
    "heavy": ("pose_landmark_heavy.tflite",
              "59e42d71bcd44cbdbabc419f0ff76686595fd265419566bd4009ef703ea8e1fe", {0: "points", 1: "flag"}),
}


# TensorFlow Lite: a FlatBuffer; field numbers are those of its schema.fbs.

class Table:
    """A table of a FlatBuffer, its fields by their number."""

    def __init__(self, data, place):
        self.data, self.place = data, place
        self.fields = place - struct.unpack_from("<i", data, place)[0]
        self.count = (struct.unpack_from("<H", data, self.fields)[0] - 4) // 2

    def _field(self, number):
        if number >= self.count:
            return 0
        offset = struct.unpack_from("<H", self.data, self.fields + 4 + 2 * number)[0]
        return self.place + offset if offset else 0

    def _target(self, number):
        place = self._field(number)
        return place + struct.unpack_from("<I", self.data, place)[0] if place else 0

    def number(self, number, form="i", default=0):
        place = self._field(number)
        return struct.unpack_from("<" + form, self.data, place)[0] if place else default

    def table(self, number):
        place = self._target(number)
        return Table(self.data, place) if place else None

    def array(self, number, kind=np.int32):
        place = self._target(number)
        count = struct.unpack_from("<I", self.data, place)[0] if place else 0
        return np.frombuffer(self.data, kind, count, place + 4) if count else np.zeros(0, kind)

    def tables(self, number):
        places = self._target(number)
        if not places:
            return []
        count = struct.unpack_from("<I", self.data, places)[0]
        entries = range(places + 4, places + 4 + 4 * count, 4)
        return [Table(self.data, entry + struct.unpack_from("<I", self.data, entry)[0]) for entry in entries]


class Network:
    """The graph of a TensorFlow Lite file."""

    def __init__(self, data):
        model = Table(data, struct.unpack_from("<I", data, 0)[0])
        graph = model.tables(2)[0]
        self.kinds = [max(code.number(0, "b"), code.number(3)) for code in model.tables(1)]
        self.buffers = model.tables(4)
        self.tensors = graph.tables(0)
        self.input = int(graph.array(1)[0])
        self.outputs = [int(tensor) for tensor in graph.array(2)]
        self.operators = graph.tables(3)

    def shape(self, tensor):
        return [int(size) for size in self.tensors[tensor].array(0)]

    def constant(self, tensor):
        """The values of a constant tensor; None: it is computed."""
        table = self.tensors[tensor]
        data = self.buffers[table.number(2, "I")].array(0, np.uint8)
        if not data.size:
            return None
        values = data.view({0: "<f4", 1: "<f2", 2: "<i4"}[table.number(1, "b")])
        sparsity = table.table(6)
        return dense(values, self.shape(tensor), sparsity) if sparsity else values.reshape(self.shape(tensor))


def dense(values, shape, sparsity):
    """A sparse tensor in full: dimensions in turn are dense, or have the places of what is not zero; the last ones may
    be blocks of the first ones."""
    order, blocks, dimensions = sparsity.array(0), sparsity.array(1), sparsity.tables(2)
    kinds = {1: np.int32, 2: np.uint16, 3: np.uint8}
    block_sizes = [dimensions[len(shape) + i].number(1) for i in range(len(blocks))]
    result = np.zeros(shape, values.dtype)
    taken = 0

    def fill(level, position, places):
        nonlocal taken
        if level == len(order):
            index = list(places[:len(shape)])
            for i, dimension in enumerate(blocks):
                index[dimension] = index[dimension] * block_sizes[i] + places[len(shape) + i]
            result[tuple(index)] = values[position]
            taken += 1
            return
        dimension = dimensions[level]
        axis = int(order[level])
        if dimension.number(0, "b") == 0:
            size = dimension.number(1)
            for i in range(size):
                fill(level + 1, position * size + i, places[:axis] + [i] + places[axis + 1:])
            return
        segments = dimension.table(3).array(0, kinds[dimension.number(2, "b")])
        indices = dimension.table(5).array(0, kinds[dimension.number(4, "b")])
        for k in range(int(segments[position]), int(segments[position + 1])):
            fill(level + 1, k, places[:axis] + [int(indices[k])] + places[axis + 1:])

    fill(0, 0, [0] * len(order))
    assert taken == values.size
    return result


# ONNX: a protocol buffer; field numbers are those of its onnx.proto3.

def varint(value):
    out = b""
    value &= 0xffffffffffffffff
    while value > 127:
        out += bytes([value & 127 | 128])
        value >>= 7
    return out + bytes([value])


def field(number, value):
    """A whole number, a text, or bytes that are a message."""
    if isinstance(value, int):
        return varint(number << 3) + varint(value)
    data = value.encode() if isinstance(value, str) else value
    return varint(number << 3 | 2) + varint(len(data)) + data


def attribute(name, value):
    head = field(1, name)
    if isinstance(value, float):
        return head + varint(2 << 3 | 5) + struct.pack("<f", value) + field(20, 1)
    if isinstance(value, int):
        return head + field(3, value) + field(20, 2)
    if isinstance(value, str):
        return head + field(4, value) + field(20, 3)
    return head + b"".join(field(8, one) for one in value) + field(20, 7)


def value_info(name, shape):
    sizes = b"".join(field(1, field(1, size)) for size in shape)
    return field(1, name) + field(2, field(1, field(1, 1) + field(2, sizes)))


def initializer(name, values):
    kind = {"float32": 1, "int64": 7}[values.dtype.name]
    sizes = b"".join(field(1, size) for size in values.shape)
    return sizes + field(2, kind) + field(8, name) + field(9, values.tobytes())


def packed(name, values):
    """Half floats beside the graph: name, kind, sizes, then all values, or a bit for each (the lowest first) that says
    whether it is not zero, and those alone."""
    head = struct.pack("<B", len(name)) + name.encode()
    sizes = struct.pack("<B%dI" % values.ndim, values.ndim, *values.shape)
    flat = values.astype("<f2").reshape(-1)
    if np.count_nonzero(flat) * 2 > flat.size:
        return head + b"h" + sizes + flat.tobytes()
    return head + b"s" + sizes + np.packbits(flat != 0, bitorder="little").tobytes() + flat[flat != 0].tobytes()


class Writer:
    """The same graph as ONNX, from its outputs back to what they need."""

    def __init__(self, network):
        self.network = network
        self.made_by = {int(operator.array(2)[0]): operator for operator in network.operators}
        self.nodes, self.constants, self.names = [], {}, {}

    def node(self, kind, inputs, output, **attributes):
        self.nodes.append(b"".join(field(1, one) for one in inputs) + field(2, output) + field(3, output) + field(4, kind)
                          + b"".join(field(5, attribute(*one)) for one in attributes.items()))
        return output

    def weights(self, tensor):
        """Constant values, through what makes them dense and floats of them."""
        while True:
            values = self.network.constant(tensor)
            if values is not None:
                return values
            operator = self.made_by[tensor]
            assert self.network.kinds[operator.number(0, "I")] in (6, 124)  # DEQUANTIZE, DENSIFY
            tensor = int(operator.array(1)[0])

    def keep(self, name, values):
        self.constants[name] = np.ascontiguousarray(values)
        return name

    def activated(self, name, activation):
        """Behind an operator, its fused function: none, rectified, or rectified and at most 6."""
        if activation == 1:
            return self.node("Relu", [name], name + "r")
        if activation == 3:
            return self.node("Clip", [name], name + "r", min=0.0, max=6.0)
        assert activation == 0
        return name

    def made(self, tensor):
        """Name of a computed tensor; what it needs is written before."""
        if tensor not in self.names:
            self.names[tensor] = "picture" if tensor == self.network.input else self._write(self.made_by[tensor])
        return self.names[tensor]

    def _write(self, operator):
        inputs = [int(tensor) for tensor in operator.array(1)]
        out = int(operator.array(2)[0])
        kind = self.network.kinds[operator.number(0, "I")]
        return getattr(self, WRITERS[kind])(operator.table(4), inputs, out, "t%d" % out)

    def _convolution(self, options, inputs, out, name, depthwise=False):
        kernel = self.weights(inputs[1])
        # Out, height, width, in; of a depthwise one 1, height, width, channels.
        kernel = kernel.transpose(3, 0, 1, 2) if depthwise else kernel.transpose(0, 3, 1, 2)
        shift = 1 if depthwise else 0
        assert options.number(4 + shift, default=1) == 1 and options.number(5 + shift, default=1) == 1
        self.node("Conv", [self.made(inputs[0]), self.keep(name + "k", kernel), self.keep(name + "b", self.weights(inputs[2]))],
                  name, kernel_shape=list(kernel.shape[2:]), strides=[options.number(2), options.number(1)],
                  group=kernel.shape[0] if depthwise else 1,
                  auto_pad="VALID" if options.number(0, "b") else "SAME_UPPER")
        return self.activated(name, options.number(3 + shift, "b"))

    def _depthwise(self, options, inputs, out, name):
        return self._convolution(options, inputs, out, name, depthwise=True)

    def _add(self, options, inputs, out, name):
        self.node("Add", [self.made(tensor) for tensor in inputs], name)
        return self.activated(name, options.number(0, "b") if options else 0)

    def _pad(self, _, inputs, out, name):
        pads = self.network.constant(inputs[1])[[0, 3, 1, 2]]
        return self.node("Pad", [self.made(inputs[0])], name, mode="constant", value=0.0,
                         pads=[int(pad) for pad in pads.T.reshape(-1)])

    def _max_pool(self, options, inputs, out, name):
        assert options.number(5, "b") == 0
        return self.node("MaxPool", [self.made(inputs[0])], name, kernel_shape=[options.number(4), options.number(3)],
                         strides=[options.number(2), options.number(1)],
                         auto_pad="VALID" if options.number(0, "b") else "SAME_UPPER")

    def _resize(self, options, inputs, out, name):
        assert options.number(3, "b") == 1  # half-pixel centres
        height, width = self.network.shape(inputs[0])[1:3]
        new_height, new_width = self.network.constant(inputs[1])
        scales = np.array([1, 1, new_height / height, new_width / width], np.float32)
        region = self.keep(name + "n", np.zeros(0, np.float32))
        return self.node("Resize", [self.made(inputs[0]), region, self.keep(name + "s", scales)], name, mode="linear",
                         coordinate_transformation_mode="half_pixel")

    def _depth_to_space(self, options, inputs, out, name):
        return self.node("DepthToSpace", [self.made(inputs[0])], name, blocksize=options.number(0), mode="DCR")

    def _logistic(self, _, inputs, out, name):
        return self.node("Sigmoid", [self.made(inputs[0])], name)

    def _reshape(self, _, inputs, out, name):
        self.node("Transpose", [self.made(inputs[0])], name + "t", perm=[0, 2, 3, 1])
        return self.node("Reshape", [name + "t", self.keep(name + "s", np.array(self.network.shape(out), np.int64))], name)

    def _concatenation(self, options, inputs, out, name):
        return self.node("Concat", [self.made(tensor) for tensor in inputs], name, axis=options.number(0))

    def model(self, outputs):
        """The whole file. `outputs`: their names by their number."""
        shown = []
        for number, name in outputs.items():
            tensor = self.network.outputs[number]
            self.node("Identity", [self.made(tensor)], name)
            shown.append(value_info(name, self.network.shape(tensor)))
        _, height, width, channels = self.network.shape(self.network.input)
        halves = [one for one in self.constants.items() if one[1].dtype == np.float16]
        others = [one for one in self.constants.items() if one[1].dtype != np.float16]
        graph = (b"".join(field(1, node) for node in self.nodes) + field(2, "blazepose")
                 + b"".join(field(5, initializer(*one)) for one in others)
                 + field(11, value_info("picture", [1, channels, height, width]))
                 + b"".join(field(12, one) for one in shown))
        model = field(1, 6) + field(2, "raks") + field(7, graph) + field(8, field(1, "") + field(2, 11))
        return (b"raks-pose\n" + struct.pack("<HHI", 1, len(halves), len(model)) + model
                + b"".join(packed(*one) for one in halves))


WRITERS = {0: "_add", 2: "_concatenation", 3: "_convolution", 4: "_depthwise", 5: "_depth_to_space", 14: "_logistic",
           17: "_max_pool", 22: "_reshape", 23: "_resize", 34: "_pad"}


def main(package, folder, names):
    for name in names:
        source, hash_of_source, outputs = NETWORKS[name]
        data = (Path(package) / source).read_bytes()
        if hashlib.sha256(data).hexdigest() != hash_of_source:
            sys.exit(f"{package}/{source}: is not the file that this script is for, see its head")
        model = Writer(Network(data)).model(outputs)
        target = Path(folder) / f"blazepose_{name}.pose"
        target.write_bytes(model)
        print(hashlib.sha256(model).hexdigest(), len(model), target)


if __name__ == "__main__":
    if len(sys.argv) < 3 or not set(sys.argv[3:]) <= set(NETWORKS):
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], sys.argv[3:] or ["detector", "full"])
