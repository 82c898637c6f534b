#include "tests/motion/skeleton/formats/motion_writers.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "motion/skeleton/formats/smpl.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::test {
namespace {

std::string little_endian(std::uint64_t value, std::size_t size) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) {
        bytes += i < sizeof(value) ? static_cast<char>((value >> (8 * i)) & 0xFFU) : '\0';
    }
    return bytes;
}

template <typename T>
std::string raw(T value) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    return bytes;
}

// Whole halves and small fractions, which is all that tests write.
std::uint16_t half_bits(double value) {
    if (value == 0.0) {
        return 0;
    }
    int exponent = 0;
    const double mantissa = std::frexp(std::abs(value), &exponent);  // [0.5, 1)
    const auto fraction = static_cast<unsigned>(std::lround((2.0 * mantissa - 1.0) * 1024.0));
    const auto bits = (static_cast<unsigned>(exponent + 14) << 10U) + fraction;
    return static_cast<std::uint16_t>(bits | (value < 0.0 ? 0x8000U : 0U));
}

std::string number_bytes(double value, const std::string& type) {
    const std::string kind = type.substr(1);
    std::string bytes = kind == "f2"   ? raw(half_bits(value))
                        : kind == "f4" ? raw(static_cast<float>(value))
                        : kind == "f8" ? raw(value)
                        : kind == "i4" ? raw(static_cast<std::int32_t>(value))
                                       : raw(static_cast<std::uint8_t>(value));
    if (type[0] == '>') {
        std::reverse(bytes.begin(), bytes.end());
    }
    return bytes;
}

// The place in a row-major array of the n-th number in Fortran order.
std::size_t row_major_index(std::size_t n, const std::vector<std::size_t>& shape) {
    std::vector<std::size_t> index(shape.size());
    for (std::size_t d = 0; d < shape.size(); ++d) {
        index[d] = n % shape[d];
        n /= shape[d];
    }
    std::size_t at = 0;
    for (std::size_t d = 0; d < shape.size(); ++d) {
        at = at * shape[d] + index[d];
    }
    return at;
}

std::string deflated(const std::string& content) {
    z_stream stream{};
    deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
    std::string out(deflateBound(&stream, content.size()), '\0');
    std::string in = content;
    stream.next_in = reinterpret_cast<Bytef*>(in.data());
    stream.avail_in = static_cast<uInt>(in.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

std::vector<double> axis_angle(glm::dquat rotation) {
    if (rotation.w < 0.0) {
        rotation = -rotation;
    }
    const glm::dvec3 axis(rotation.x, rotation.y, rotation.z);
    const double sine = glm::length(axis);
    const glm::dvec3 turn =
        sine < 1e-12 ? 2.0 * axis : axis * (2.0 * std::atan2(sine, rotation.w) / sine);
    return {turn.x, turn.y, turn.z};
}

std::string json_value(const motion::NumberArray& array, std::size_t dimension, std::size_t& next) {
    if (dimension == array.shape.size()) {
        return fmt::format("{:.17g}", array.values[next++]);
    }
    std::string text = "[";
    for (std::size_t i = 0; i < array.shape[dimension]; ++i) {
        text += (i == 0 ? "" : ",") + json_value(array, dimension + 1, next);
    }
    return text + "]";
}

// Numbers as the computers of C3D keep them.
class C3dWriter {
 public:
    explicit C3dWriter(motion::C3dProcessor processor) : processor_(processor) {}

    [[nodiscard]] std::string word(int value) const {
        std::string bytes = little_endian(static_cast<std::uint64_t>(value) & 0xFFFFU, 2);
        if (processor_ == motion::C3dProcessor::mips) {
            std::reverse(bytes.begin(), bytes.end());
        }
        return bytes;
    }
    [[nodiscard]] std::string number(double value) const {
        if (processor_ == motion::C3dProcessor::dec) {
            // Four times as large, the upper half first.
            const std::string bytes = raw(static_cast<float>(4.0 * value));
            return bytes.substr(2) + bytes.substr(0, 2);
        }
        std::string bytes = raw(static_cast<float>(value));
        if (processor_ == motion::C3dProcessor::mips) {
            std::reverse(bytes.begin(), bytes.end());
        }
        return bytes;
    }
    // A record of the parameter section; `group` negative: a group without content.
    [[nodiscard]] std::string record(int group,
                                     const std::string& name,
                                     std::string content) const {
        content += '\0';  // no description
        return std::string(1, static_cast<char>(name.size())) + static_cast<char>(group) + name +
               word(static_cast<int>(content.size()) + 2) + content;
    }
    [[nodiscard]] std::string words(const std::string& name,
                                    const std::vector<std::string>& list) const {
        std::size_t longest = 1;
        for (const std::string& each : list) {
            longest = std::max(longest, each.size());
        }
        std::string content = {
            '\xFF', 2, static_cast<char>(longest), static_cast<char>(list.size())};
        for (std::string each : list) {
            each.resize(longest, ' ');
            content += each;
        }
        return record(1, name, content);
    }

 private:
    motion::C3dProcessor processor_;
};

void fill_block(std::string& bytes) {
    bytes.resize((bytes.size() + motion::kC3dBlock - 1) / motion::kC3dBlock * motion::kC3dBlock,
                 '\0');
}

}  // namespace

std::string c3d_bytes(const motion::PointClip& clip, const C3dForm& form) {
    const C3dWriter to(form.processor);
    const auto points = static_cast<int>(clip.names.size());
    const double scale = form.is_float ? -form.scale : form.scale;
    std::string parameters = to.record(-1, "POINT", "");
    parameters += to.record(1, "USED", std::string{2, 0} + to.word(points));
    parameters += to.record(1, "SCALE", std::string{4, 0} + to.number(scale));
    parameters += to.record(1, "RATE", std::string{4, 0} + to.number(clip.frames_per_second));
    parameters += to.words("LABELS", clip.names);
    parameters += to.words("UNITS", {form.unit});
    parameters += to.words("Y_SCREEN", {form.up});
    parameters = std::string{1, 'P', 4, static_cast<char>(form.processor)} + parameters;
    fill_block(parameters);
    const int begin = 2 + static_cast<int>(parameters.size() / motion::kC3dBlock);
    std::string file = std::string{2, 'P'} + to.word(points) +
                       to.word(static_cast<int>(form.analogue)) + to.word(1) +
                       to.word(static_cast<int>(clip.frame_count)) + to.word(0) + to.number(scale) +
                       to.word(begin) + to.word(1) + to.number(clip.frames_per_second);
    fill_block(file);
    file += parameters;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        for (std::size_t point = 0; point < clip.names.size(); ++point) {
            const glm::dvec3& place = clip.position(frame, point);
            const bool is_seen = !std::isnan(place.x);
            for (int axis = 0; axis < 3; ++axis) {
                const double value = is_seen ? place[axis] : 0.0;
                file += form.is_float ? to.number(value)
                                      : to.word(static_cast<int>(std::lround(value / form.scale)));
            }
            file += form.is_float ? to.number(is_seen ? 0.5 : -1.0) : to.word(is_seen ? 1 : -1);
        }
        for (std::size_t i = 0; i < form.analogue; ++i) {
            file += form.is_float ? to.number(7.0) : to.word(7);
        }
    }
    fill_block(file);
    return file;
}

std::string npy_bytes(const motion::NumberArray& array, const NpyForm& form) {
    std::string head = fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': {}, }}",
                                   form.type,
                                   form.is_fortran ? "True" : "False",
                                   motion::shape_text(array.shape));
    head.resize((10 + head.size() + 1 + 63) / 64 * 64 - 10 - 1, ' ');
    head += '\n';
    std::string bytes = "\x93NUMPY" + std::string("\x01\x00", 2) + little_endian(head.size(), 2);
    bytes += head;
    for (std::size_t i = 0; i < array.values.size(); ++i) {
        const std::size_t at = form.is_fortran ? row_major_index(i, array.shape) : i;
        bytes += number_bytes(array.values[at], form.type);
    }
    return bytes;
}

std::string zip_bytes(const std::vector<std::pair<std::string, std::string>>& files,
                      Packing packing) {
    std::string archive;
    std::string directory;
    for (const auto& [name, content] : files) {
        const std::string packed = packing == Packing::deflated ? deflated(content) : content;
        const auto checksum = crc32_z(
            crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(content.data()), content.size());
        // What both heads have: version, flags, method, time, date, checksum, sizes, lengths.
        const std::string common =
            little_endian(20, 2) + little_endian(0, 2) +
            little_endian(packing == Packing::deflated ? 8 : 0, 2) + little_endian(0, 4) +
            little_endian(checksum, 4) + little_endian(packed.size(), 4) +
            little_endian(content.size(), 4) + little_endian(name.size(), 2) + little_endian(0, 2);
        directory += "PK\x01\x02" + little_endian(20, 2) + common + little_endian(0, 10) +
                     little_endian(archive.size(), 4) + name;
        archive += "PK\x03\x04" + common + name + packed;
    }
    return archive + directory + "PK\x05\x06" + little_endian(0, 4) +
           little_endian(files.size(), 2) + little_endian(files.size(), 2) +
           little_endian(directory.size(), 4) + little_endian(archive.size(), 4) +
           little_endian(0, 2);
}

std::string npz_bytes(const motion::NumberArrays& arrays, Packing packing) {
    std::vector<std::pair<std::string, std::string>> files;
    for (const auto& [name, array] : arrays) {
        files.emplace_back(name + ".npy", npy_bytes(array));
    }
    return zip_bytes(files, packing);
}

motion::NumberArrays smpl_arrays(const motion::MotionClip& clip) {
    const auto& joints = motion::smpl_joints();
    constexpr double kHipsHeight = 0.985;  // of the mean SMPL body, with soles of 3 cm
    std::vector<std::optional<std::size_t>> source(joints.size());
    for (std::size_t j = 0; j < joints.size(); ++j) {
        for (std::size_t i = 0; i < clip.joints.size(); ++i) {
            if (clip.joints[i].name == joints[j].name) {
                source[j] = i;
            }
        }
    }
    motion::NumberArray poses{{clip.frame_count, 72}, {}};
    motion::NumberArray trans{{clip.frame_count, 3}, {}};
    const double scale = kHipsHeight / clip.joints[source[0].value_or(0)].offset.y;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const motion::ClipWorldPose world = motion::world_pose(clip, frame);
        std::vector<glm::dquat> turns(joints.size());
        for (std::size_t j = 0; j < joints.size(); ++j) {
            const bool is_root = joints[j].parent == j;
            const glm::dquat parent =
                is_root ? glm::dquat(1.0, 0.0, 0.0, 0.0) : turns[joints[j].parent];
            turns[j] = source[j] ? world.rotations[*source[j]] : parent;
            const std::vector<double> turn = axis_angle(glm::inverse(parent) * turns[j]);
            poses.values.insert(poses.values.end(), turn.begin(), turn.end());
        }
        const glm::dvec3 hips = scale * world.positions[source[0].value_or(0)];
        trans.values.insert(trans.values.end(), {hips.x, hips.y, hips.z});
    }
    return {{"poses", std::move(poses)},
            {"trans", std::move(trans)},
            {"mocap_framerate", {{}, {clip.frames_per_second}}}};
}

std::string json_text(const motion::NumberArrays& arrays) {
    std::string text = "{";
    for (const auto& [name, array] : arrays) {
        std::size_t next = 0;
        text += fmt::format(
            "{}\"{}\": {}", text.size() == 1 ? "" : ", ", name, json_value(array, 0, next));
    }
    return text + "}\n";
}

}  // namespace raks::test
