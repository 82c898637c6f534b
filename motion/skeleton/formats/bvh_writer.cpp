#include <cmath>
#include <string>

#include "base/pending_file.hpp"
#include "motion/skeleton/formats/bvh.hpp"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>

namespace raks::motion {
namespace {

struct ZxyDegrees {
    double z = 0.0;
    double x = 0.0;
    double y = 0.0;
};

/// Euler angles in degrees, with rotation = Rz Rx Ry.
ZxyDegrees zxy_of(const glm::quat& rotation) {
    const glm::dmat3 m = glm::mat3_cast(glm::dquat(glm::normalize(glm::dquat(rotation))));
    // glm indexes m[column][row].
    const double sin_x = std::clamp(m[1][2], -1.0, 1.0);
    return {glm::degrees(std::atan2(-m[1][0], m[1][1])),
            glm::degrees(std::asin(sin_x)),
            glm::degrees(std::atan2(-m[0][2], m[2][2]))};
}

// Leaves need an end site.
bool has_child(std::size_t bone) {
    for (std::size_t i = 1; i < kBoneParents.size(); ++i) {
        if (kBoneParents[i] == bone) {
            return true;
        }
    }
    return false;
}

// One joint and, recursively, its children.
void write_joint(const Skeleton& skeleton, std::size_t bone, int depth, std::string& text) {
    const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
    const glm::vec3& offset = skeleton.offsets[bone];
    text += fmt::format("{0}{1} {2}\n{0}{{\n{0}  OFFSET {3:.6f} {4:.6f} {5:.6f}\n",
                        indent,
                        bone == 0 ? "ROOT" : "JOINT",
                        kBoneNames[bone],
                        offset.x,
                        offset.y,
                        offset.z);
    text += indent + (bone == 0 ? "  CHANNELS 6 Xposition Yposition Zposition "
                                  "Zrotation Xrotation Yrotation\n"
                                : "  CHANNELS 3 Zrotation Xrotation Yrotation\n");
    if (!has_child(bone)) {
        // The skeleton has no tips: a leaf ends two thirds of its own bone's length further on.
        text +=
            fmt::format("{0}  End Site\n{0}  {{\n{0}    OFFSET {1:.6f} {2:.6f} {3:.6f}\n{0}  }}\n",
                        indent,
                        offset.x * 0.667F,
                        offset.y * 0.667F,
                        offset.z * 0.667F);
    }
    for (std::size_t child = 1; child < kBoneParents.size(); ++child) {
        if (kBoneParents[child] == bone) {
            write_joint(skeleton, child, depth + 1, text);
        }
    }
    text += indent + "}\n";
}

/// Bones in depth-first order, in which write_joint() writes them: rows must follow it.
void list_depth_first(std::size_t bone, std::vector<std::size_t>& order) {
    order.push_back(bone);
    for (std::size_t child = 1; child < kBoneParents.size(); ++child) {
        if (kBoneParents[child] == bone) {
            list_depth_first(child, order);
        }
    }
}

}  // namespace

Expected<void> write_bvh(const std::filesystem::path& path,
                         const Skeleton& skeleton,
                         std::span<const Pose> poses,
                         double frames_per_second) {
    if (poses.empty()) {
        return fail(path.string() + ": no poses to write");
    }
    if (!(frames_per_second > 0.0) || !std::isfinite(frames_per_second)) {
        return fail(
            fmt::format("{}: {} pictures a second, must be > 0", path.string(), frames_per_second));
    }
    std::vector<std::size_t> order;
    list_depth_first(0, order);
    std::string text = "HIERARCHY\n";
    write_joint(skeleton, 0, 0, text);
    text += fmt::format(
        "MOTION\nFrames: {}\nFrame Time: {:.12g}\n", poses.size(), 1.0 / frames_per_second);
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
        const Pose& pose = poses[frame];
        if (!is_finite(pose)) {
            return fail(fmt::format("{}: pose {} is not finite", path.string(), frame));
        }
        text += fmt::format("{:.6f} {:.6f} {:.6f}",
                            pose.hips_position.x,
                            pose.hips_position.y,
                            pose.hips_position.z);
        for (const std::size_t bone : order) {
            const ZxyDegrees angles = zxy_of(pose.local_rotations[bone]);
            text += fmt::format(" {:.5f} {:.5f} {:.5f}", angles.z, angles.x, angles.y);
        }
        text += '\n';
    }
    return write_file(path, text);
}

}  // namespace raks::motion
