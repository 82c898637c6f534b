#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/gltf/glb_document.hpp"
#include "base/pending_file.hpp"
#include "motion/skeleton/formats/vrma.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

using Json = GlbDocument::Json;

Json node_of(const Skeleton& skeleton, std::size_t bone) {
    const glm::vec3& offset = skeleton.offsets[bone];
    Json node = {{"name", kBoneNames[bone]}, {"translation", {offset.x, offset.y, offset.z}}};
    for (std::size_t child = bone + 1; child < kBoneParents.size(); ++child) {
        if (kBoneParents[child] == bone) {
            node["children"].push_back(child);
        }
    }
    return node;
}

// The document with one clip in it.
class VrmaDocument {
 public:
    VrmaDocument(const Skeleton& skeleton, const std::string& name) {
        Json& json = glb_.json();
        glb_.use_extension("VRMC_vrm_animation");
        json["scene"] = 0;
        json["scenes"] = {{{"nodes", {0}}}};
        Json bones = Json::object();
        for (std::size_t bone = 0; bone < kBoneNames.size(); ++bone) {
            json["nodes"].push_back(node_of(skeleton, bone));
            bones[std::string(kBoneNames[bone])] = {{"node", bone}};
        }
        json["extensions"]["VRMC_vrm_animation"] = {{"specVersion", "1.0"},
                                                    {"humanoid", {{"humanBones", bones}}}};
        clip_ = {{"name", name}, {"channels", Json::array()}, {"samplers", Json::array()}};
    }

    // An expression: a node beside the bones; says which.
    std::size_t add_expression(const ExpressionTrack& track) {
        Json& json = glb_.json();
        const std::size_t node = json["nodes"].size();
        json["nodes"].push_back({{"name", track.name}});
        json["scenes"][0]["nodes"].push_back(node);
        json["extensions"]["VRMC_vrm_animation"]["expressions"]
            [track.is_preset ? "preset" : "custom"][track.name] = {{"node", node}};
        return node;
    }

    // Moments of keys; says their accessor.
    std::size_t add_times(const std::vector<float>& times) {
        return glb_.add_floats(times, GlbType::scalar, GlbUse::values, true);
    }

    // What one node does.
    void add_channel(std::size_t node,
                     const char* path,
                     std::size_t times,
                     const std::vector<float>& values,
                     GlbType type) {
        const std::size_t output = glb_.add_floats(values, type);
        clip_["channels"].push_back(
            {{"sampler", clip_["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
        clip_["samplers"].push_back(
            {{"input", times}, {"output", output}, {"interpolation", "LINEAR"}});
    }

    [[nodiscard]] Expected<std::string> bytes() {
        glb_.json()["animations"] = {clip_};
        return glb_.bytes();
    }

 private:
    GlbDocument glb_;
    Json clip_;
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

// Weights of an expression as places along x.
std::vector<float> places_of(const ExpressionTrack& track, std::size_t poses) {
    std::vector<float> values(3 * poses, 0.0F);
    for (std::size_t i = 0; i < std::min(poses, track.weights.size()); ++i) {
        values[3 * i] = track.weights[i];
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
                                 const std::string& name,
                                 std::span<const ExpressionTrack> face) {
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
        [&](std::size_t node, const char* path, std::vector<float> values, GlbType type) {
            const std::size_t width = glb_width(type);
            const bool stays = is_constant(values, width);
            values.resize(stays ? width : values.size());
            document.add_channel(node, path, stays ? start : times, values, type);
        };
    add(0, "translation", travel_of(poses), GlbType::vec3);
    for (std::size_t bone = 0; bone < kBoneNames.size(); ++bone) {
        add(bone, "rotation", rotations_of(poses, bone), GlbType::vec4);
    }
    for (const ExpressionTrack& track : face) {
        add(document.add_expression(track),
            "translation",
            places_of(track, poses.size()),
            GlbType::vec3);
    }
    return document.bytes();
}

Expected<void> write_vrma(const std::filesystem::path& path,
                          const Skeleton& skeleton,
                          std::span<const Pose> poses,
                          double poses_per_second,
                          std::span<const ExpressionTrack> face) {
    const auto bytes = vrma_bytes(skeleton, poses, poses_per_second, path.stem().string(), face);
    if (!bytes) {
        return fail(path.string() + ": " + bytes.error().message);
    }
    return write_file(path, *bytes);
}

}  // namespace raks::motion
