#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/pending_file.hpp"
#include "motion/skeleton/formats/vrma.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

namespace raks::motion {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF's numbers are little-endian");

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126;  // component type of an accessor

// The document and its one buffer of floats.
class VrmaDocument {
 public:
    VrmaDocument(const Skeleton& skeleton, const std::string& name) {
        json_["asset"] = {{"version", "2.0"}, {"generator", "Raks"}};
        json_["extensionsUsed"] = {"VRMC_vrm_animation"};
        json_["scene"] = 0;
        json_["scenes"] = {{{"nodes", {0}}}};
        Json bones = Json::object();
        for (std::size_t bone = 0; bone < kBoneNames.size(); ++bone) {
            json_["nodes"].push_back(node_of(skeleton, bone));
            bones[std::string(kBoneNames[bone])] = {{"node", bone}};
        }
        json_["extensions"]["VRMC_vrm_animation"] = {{"specVersion", "1.0"},
                                                     {"humanoid", {{"humanBones", bones}}}};
        clip_ = {{"name", name}, {"channels", Json::array()}, {"samplers", Json::array()}};
    }

    // Moments of keys; says their accessor.
    std::size_t add_times(const std::vector<float>& times) {
        const std::size_t accessor = add_floats(times, 1);
        json_["accessors"][accessor]["min"] = {times.front()};
        json_["accessors"][accessor]["max"] = {times.back()};
        return accessor;
    }

    // What one bone does; `width` numbers a key.
    void add_channel(std::size_t bone,
                     const char* path,
                     std::size_t times,
                     const std::vector<float>& values,
                     std::size_t width) {
        const std::size_t output = add_floats(values, width);
        clip_["channels"].push_back(
            {{"sampler", clip_["samplers"].size()}, {"target", {{"node", bone}, {"path", path}}}});
        clip_["samplers"].push_back(
            {{"input", times}, {"output", output}, {"interpolation", "LINEAR"}});
    }

    // The container around both.
    [[nodiscard]] Expected<std::string> bytes() {
        json_["animations"] = {clip_};
        json_["buffers"] = {{{"byteLength", binary_.size()}}};
        std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        constexpr std::size_t kHead = 12;
        constexpr std::size_t kChunkHead = 8;
        const std::size_t size = kHead + 2 * kChunkHead + text.size() + binary_.size();
        if (size > std::numeric_limits<std::uint32_t>::max()) {
            return fail("too long for a VRMA: more than 4 GiB");
        }
        std::string file = "glTF";
        add_number(2, file);
        add_number(size, file);
        add_number(text.size(), file);
        file += "JSON";
        file += text;
        add_number(binary_.size(), file);
        file += std::string("BIN\0", 4);
        file += binary_;
        return file;
    }

 private:
    static Json node_of(const Skeleton& skeleton, std::size_t bone) {
        const glm::vec3& offset = skeleton.offsets[bone];
        Json node = {{"name", kBoneNames[bone]}, {"translation", {offset.x, offset.y, offset.z}}};
        for (std::size_t child = bone + 1; child < kBoneParents.size(); ++child) {
            if (kBoneParents[child] == bone) {
                node["children"].push_back(child);
            }
        }
        return node;
    }

    static void add_number(std::size_t number, std::string& file) {
        const auto word = static_cast<std::uint32_t>(number);
        file.append(reinterpret_cast<const char*>(&word), sizeof(word));
    }

    // Appends an accessor with a view of its own.
    std::size_t add_floats(const std::vector<float>& values, std::size_t width) {
        const std::size_t bytes = values.size() * sizeof(float);
        const std::size_t index = json_["accessors"].size();
        json_["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}});
        json_["accessors"].push_back({{"bufferView", index},
                                      {"componentType", kFloat},
                                      {"count", values.size() / width},
                                      {"type",
                                       width == 1   ? "SCALAR"
                                       : width == 3 ? "VEC3"
                                                    : "VEC4"}});
        binary_.append(reinterpret_cast<const char*>(values.data()), bytes);
        return index;
    }

    Json json_;
    Json clip_;
    std::string binary_;
};

Expected<void> check_poses(std::span<const Pose> poses, double poses_per_second) {
    if (poses.empty()) {
        return fail("no poses to write");
    }
    if (!(poses_per_second > 0.0) || !std::isfinite(poses_per_second)) {
        return fail(fmt::format("{} poses a second, must be > 0", poses_per_second));
    }
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (!is_finite(poses[i])) {
            return fail(fmt::format("pose {} is not finite", i));
        }
    }
    return {};
}

// Rotations of one bone as x, y, z, w: unit, and without jumps of the sign.
std::vector<float> rotations_of(std::span<const Pose> poses, std::size_t bone) {
    std::vector<float> values;
    values.reserve(4 * poses.size());
    glm::quat last = kNoRotation;
    for (const Pose& pose : poses) {
        glm::quat q = glm::normalize(pose.local_rotations[bone]);
        q = glm::dot(q, last) < 0.0F ? -q : q;
        last = q;
        values.insert(values.end(), {q.x, q.y, q.z, q.w});
    }
    return values;
}

std::vector<float> travel_of(std::span<const Pose> poses) {
    std::vector<float> values;
    values.reserve(3 * poses.size());
    for (const Pose& pose : poses) {
        const glm::vec3& p = pose.hips_position;
        values.insert(values.end(), {p.x, p.y, p.z});
    }
    return values;
}

bool is_constant(const std::vector<float>& values, std::size_t width) {
    for (std::size_t i = width; i < values.size(); ++i) {
        if (values[i] != values[i - width]) {
            return false;
        }
    }
    return true;
}

}  // namespace

Expected<std::string> vrma_bytes(const Skeleton& skeleton,
                                 std::span<const Pose> poses,
                                 double poses_per_second,
                                 const std::string& name) {
    if (auto checked = check_poses(poses, poses_per_second); !checked) {
        return fail(std::move(checked.error()));
    }
    VrmaDocument document(skeleton, name);
    std::vector<float> moments;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        moments.push_back(static_cast<float>(static_cast<double>(i) / poses_per_second));
    }
    const std::size_t times = document.add_times(moments);
    const std::size_t start = poses.size() == 1 ? times : document.add_times({0.0F});
    const auto add =
        [&](std::size_t bone, const char* path, std::vector<float> values, std::size_t width) {
            const bool stays = is_constant(values, width);
            values.resize(stays ? width : values.size());
            document.add_channel(bone, path, stays ? start : times, values, width);
        };
    add(0, "translation", travel_of(poses), 3);
    for (std::size_t bone = 0; bone < kBoneNames.size(); ++bone) {
        add(bone, "rotation", rotations_of(poses, bone), 4);
    }
    return document.bytes();
}

Expected<void> write_vrma(const std::filesystem::path& path,
                          const Skeleton& skeleton,
                          std::span<const Pose> poses,
                          double poses_per_second) {
    const auto bytes = vrma_bytes(skeleton, poses, poses_per_second, path.stem().string());
    if (!bytes) {
        return fail(path.string() + ": " + bytes.error().message);
    }
    return write_file(path, *bytes);
}

}  // namespace raks::motion
