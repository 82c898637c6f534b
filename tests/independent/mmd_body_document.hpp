// The standard body of MikuMikuDance and the poses that a motion gives it, for another reader.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "motion/skeleton/formats/mmd/vmd.hpp"

namespace raks::test {

/// A place in the file's own axes and units.
inline nlohmann::json in_mmd_axes(const glm::dvec3& place) {
    const glm::dvec3 units = place / motion::kMmdMetres;
    return {units.x, units.y, -units.z};
}

/// What check_vmd.mjs reads: the table of bones, and every `step`-th frame of a motion as we pose
/// it.
inline nlohmann::json mmd_body_document(const motion::MmdMotion& motion, std::uint32_t step) {
    using motion::MmdBone;
    const motion::MmdBody body;
    nlohmann::json document;
    for (const motion::MmdBoneRow& row : motion::mmd_bone_rows()) {
        nlohmann::json bone;
        bone["name"] = motion::mmd_name(row.bone);
        bone["parent"] = row.parent ? static_cast<int>(index_of(*row.parent)) : -1;
        bone["rest"] = in_mmd_axes(body.offset(row.bone));
        bone["level"] = row.level;
        if (row.share != 0.0) {
            bone["append"] = {{"bone", index_of(row.source)}, {"share", row.share}};
        }
        const auto side = side_of(row.bone);
        if (row.turns_about_arm) {
            const double along = side == motion::Side::left ? 1.0 : -1.0;
            bone["axis"] = in_mmd_axes(body.arm_at_rest(*side) * glm::dvec3(along, 0.0, 0.0));
        }
        const auto at = [&](MmdBone left) { return index_of(on_side(left, *side)); };
        if (left_of(row.bone) == MmdBone::left_leg_ik) {
            bone["ik"] = {{"target", at(MmdBone::left_ankle)},
                          {"rounds", 40},
                          {"step", 2.0},
                          {"links",
                           {{{"bone", at(MmdBone::left_knee)}, {"knee", true}},
                            {{"bone", at(MmdBone::left_leg)}, {"knee", false}}}}};
        } else if (left_of(row.bone) == MmdBone::left_toe_ik) {
            nlohmann::json links = nlohmann::json::array();
            links.push_back({{"bone", at(MmdBone::left_ankle)}, {"knee", false}});
            bone["ik"] = {
                {"target", at(MmdBone::left_toe)}, {"rounds", 3}, {"step", 4.0}, {"links", links}};
        }
        document["bones"].push_back(bone);
    }
    motion::MmdSampler sampler(motion);
    for (std::uint32_t frame = 0; frame <= motion.last_frame(); frame += step) {
        const motion::MmdWorld world = body.world(sampler.pose_at(frame));
        nlohmann::json places;
        for (const glm::dvec3& place : world.places) {
            places.push_back(in_mmd_axes(place));
        }
        document["frames"].push_back({{"frame", frame}, {"places", places}});
    }
    return document;
}

}  // namespace raks::test
