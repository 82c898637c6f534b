#include "motion/capture/keypoints/pose_model_file.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/half_float.hpp"
#include "base/packer.hpp"
#include "base/sha256.hpp"

namespace raks::capture {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is little-endian");

constexpr std::string_view kPoseFormat = "raks-pose\n";
constexpr int kPoseVersion = 1;
constexpr std::size_t kMostWeights = std::size_t{1} << 27U;

// What scripts/convert_pose.py makes of @mediapipe/pose 0.5.1675469404.
constexpr std::array<KnownPoseNetwork, 4> kKnownNetworks = {
    {{"detector",
      PoseNetworkKind::detector,
      "54176566f4430776d7f5ba90d29ade6dfd6cf247d717faa2744e0fa8ecfbcaf0"},
     {"lite",
      PoseNetworkKind::joints,
      "6605fb666f5e3547f5e91fe1b82367acbf4af6a9af2d0c64efc6257579d40144"},
     {"full",
      PoseNetworkKind::joints,
      "b1243390724903c3da6336c2a292d9e27aa2c2600e240408022da68f031600d6"},
     {"heavy",
      PoseNetworkKind::joints,
      "b7f0b1dc4cc661659a49c4c3e9ee89d8a583213ccc6155f6b7fc920fe8f6f9ba"}}};

// Protocol buffers: a number of seven bits a byte; a field that is a number; one that is bytes.
void put_varint(std::string& out, std::uint64_t value) {
    for (; value > 127; value >>= 7U) {
        out += static_cast<char>((value & 127U) | 128U);
    }
    out += static_cast<char>(value);
}

void put_number(std::string& out, unsigned field, std::uint64_t value) {
    put_varint(out, field << 3U);
    put_varint(out, value);
}

void put_bytes(std::string& out, unsigned field, std::string_view bytes) {
    put_varint(out, field << 3U | 2U);
    put_varint(out, bytes.size());
    out += bytes;
}

/// Weights of a network.
struct WeightArray {
    std::string name;
    std::vector<std::uint32_t> sizes;
    std::vector<float> values;
};

// All values, or a bit for each that says whether it is not zero, and those alone.
bool take_values(Unpacker& bytes, char kind, std::vector<float>& values) {
    std::vector<std::uint8_t> bits;
    if (kind == 's') {
        bits.resize((values.size() + 7) / 8);
        for (std::uint8_t& byte : bits) {
            byte = bytes.take<std::uint8_t>();
        }
    } else if (kind != 'h') {
        return false;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (bits.empty() || (bits[i / 8] >> i % 8 & 1U) != 0U) {
            values[i] = float_of_half(bytes.take<std::uint16_t>());
        }
    }
    return bytes.is_good();
}

Expected<WeightArray> take_weights(Unpacker& bytes) {
    WeightArray array;
    array.name.resize(bytes.take<std::uint8_t>());
    for (char& letter : array.name) {
        letter = bytes.take<char>();
    }
    const char kind = bytes.take<char>();
    array.sizes.resize(bytes.take<std::uint8_t>());
    std::size_t count = 1;
    for (std::uint32_t& size : array.sizes) {
        size = bytes.take<std::uint32_t>();
        count = size <= kMostWeights ? count * size : kMostWeights + 1;
        if (count > kMostWeights) {
            return fail("has more weights than a pose network has");
        }
    }
    // Each has a bit at least: a damaged size takes no more memory than there are bytes.
    if (!bytes.is_good() || count / 8 > bytes.left()) {
        return fail("is cut off");
    }
    array.values.resize(count);
    if (!take_values(bytes, kind, array.values)) {
        return fail(bytes.is_good() ? "has weights of an unknown kind" : "is cut off");
    }
    return array;
}

// Appends weights to an ONNX model: messages that follow one another are one message. (onnx.proto3:
// ModelProto.graph 7, GraphProto.initializer 5, TensorProto.dims 1, data_type 2, name 8, raw_data
// 9; a float's data_type is 1.)
void put_weights(std::string& onnx, const WeightArray& array) {
    std::string tensor;
    for (const std::uint32_t size : array.sizes) {
        put_number(tensor, 1, size);
    }
    put_number(tensor, 2, 1);
    put_bytes(tensor, 8, array.name);
    put_bytes(
        tensor,
        9,
        {reinterpret_cast<const char*>(array.values.data()), array.values.size() * sizeof(float)});
    std::string graph;
    put_bytes(graph, 5, tensor);
    put_bytes(onnx, 7, graph);
}

Expected<void> check_pose_head(std::string_view file) {
    if (!file.starts_with(kPoseFormat)) {
        return fail("is not a pose network of Raks (scripts/convert_pose.py makes them)");
    }
    const int version = Unpacker(file.substr(kPoseFormat.size())).take<std::uint16_t>();
    if (version != kPoseVersion) {
        return fail(
            fmt::format("is of version {}, this program reads version {}", version, kPoseVersion));
    }
    return {};
}

}  // namespace

Expected<KnownPoseNetwork> known_pose_network(std::string_view file) {
    if (auto checked = check_pose_head(file); !checked) {
        return fail(checked.error());
    }
    const std::string hash = sha256_of(file);
    for (const KnownPoseNetwork& network : kKnownNetworks) {
        if (network.sha256 == hash) {
            return network;
        }
    }
    return fail(
        fmt::format("is cut off, damaged or of other origin: its SHA-256 begins with {}, "
                    "those of detector, lite, full and heavy with {}, {}, {} and {}; "
                    "install Raks again, or make it again with scripts/convert_pose.py",
                    hash.substr(0, 8),
                    kKnownNetworks[0].sha256.substr(0, 8),
                    kKnownNetworks[1].sha256.substr(0, 8),
                    kKnownNetworks[2].sha256.substr(0, 8),
                    kKnownNetworks[3].sha256.substr(0, 8)));
}

Expected<std::string> pose_file_as_onnx(std::string_view file) {
    if (auto checked = check_pose_head(file); !checked) {
        return fail(checked.error());
    }
    Unpacker bytes(file.substr(kPoseFormat.size() + sizeof(std::uint16_t)));
    const int arrays = bytes.take<std::uint16_t>();
    const std::size_t graph_size = bytes.take<std::uint32_t>();
    if (!bytes.is_good() || graph_size > bytes.left()) {
        return fail("is cut off");
    }
    std::string onnx(file.substr(file.size() - bytes.left(), graph_size));
    bytes = Unpacker(file.substr(file.size() - bytes.left() + graph_size));
    for (int i = 0; i < arrays; ++i) {
        const auto array = take_weights(bytes);
        if (!array) {
            return fail(array.error());
        }
        put_weights(onnx, *array);
    }
    if (!bytes.at_end()) {
        return fail("goes on after its last array");
    }
    return onnx;
}

}  // namespace raks::capture
