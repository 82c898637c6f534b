#include "motion/skeleton/body/body_finder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace raks::motion {
namespace {

const glm::dquat kNoTurn(1.0, 0.0, 0.0, 0.0);
constexpr double kDoubtful = 0.6;  // confidence below which what was taken is said

}  // namespace

std::string unit_note(double metres_per_unit, const std::string& reason) {
    return fmt::format("one unit is taken for {}: {} (--unit, --height or --scale sets it)",
                       unit_name(metres_per_unit),
                       reason);
}

bool FoundBody::is_unit_doubtful() const noexcept { return size.confidence < kDoubtful; }

std::vector<std::string> FoundBody::notes() const {
    std::vector<std::string> notes;
    if (up.confidence < kDoubtful) {
        notes.push_back(
            fmt::format("{} is taken for up: {} (--up sets it)", axis_name(up.axis), up.reason));
    } else if (up.axis != glm::dvec3(0.0, 1.0, 0.0)) {
        notes.push_back(fmt::format("{} is up: {} (--up sets it)", axis_name(up.axis), up.reason));
    }
    if (rest.kind == RestKind::other) {
        notes.push_back(rest.reason);
    }
    if (is_unit_doubtful()) {
        notes.push_back(unit_note(size.metres_per_unit, size.reason));
    }
    notes.insert(notes.end(), size.notes.begin(), size.notes.end());
    return notes;
}

Expected<FoundBody> find_body(const MotionClip& clip, const BodyOptions& options) {
    if (clip.frame_count == 0) {
        return fail("has no frames");
    }
    auto joints = find_joints(clip);
    if (!joints) {
        return fail(std::move(joints.error()));
    }
    FoundBody found;
    found.joints = std::move(*joints);
    const PosedBody posed(clip, found.mapping());
    if (options.up) {
        found.up = {*options.up, turn_to_y(*options.up), 1.0, "given"};
    } else if (clip.up) {
        found.up = {*clip.up, turn_to_y(*clip.up), 1.0, "as its format has it"};
    } else {
        found.up = find_up(posed);
    }
    found.rest = find_rest_pose(posed, found.up.upright);
    // A height that is given is stronger than the unit of a format.
    const auto unit =
        options.metres_per_unit || options.height ? options.metres_per_unit : clip.metres_per_unit;
    found.size = find_size(posed, found.up.axis, {unit, options.height});
    if (unit && unit == clip.metres_per_unit && !options.metres_per_unit) {
        found.size.reason = "as its format has it";
    }
    if (clip.known && clip.known->height && !options.height) {
        found.size.height = *clip.known->height * found.size.metres_per_unit;
    }
    found.stance =
        find_stance(posed, found.up.upright, found.size.height / found.size.metres_per_unit);
    if (clip.known && clip.known->facing) {
        found.stance.facing = *clip.known->facing;
        found.stance.facing_confidence = 1.0;
    }
    return found;
}

Expected<StandingClip> stand(MotionClip clip, const BodyOptions& options) {
    auto body = find_body(clip, options);
    if (!body) {
        return fail(std::move(body.error()));
    }
    MotionClip turned = stood_up(std::move(clip), *body);
    return StandingClip{std::move(turned), std::move(*body)};
}

MotionClip stood_up(MotionClip clip, const FoundBody& body) {
    const std::vector<glm::dquat>& rest = body.rest.joints;
    const glm::dquat& upright = body.up.upright;
    if (upright == kNoTurn &&
        std::all_of(rest.begin(), rest.end(), [](const glm::dquat& q) { return q == kNoTurn; })) {
        return clip;
    }
    clip.up = glm::dvec3(0.0, 1.0, 0.0);
    const std::size_t joints = clip.joints.size();
    for (std::size_t j = 0; j < joints; ++j) {
        ClipJoint& joint = clip.joints[j];
        // A root's parent is the world.
        const glm::dquat above = joint.parent == j ? upright : rest[joint.parent];
        const glm::dquat below = glm::conjugate(rest[j]);
        // Where positions replace offsets, they are what holds.
        if (joint.parent != j) {
            joint.offset = clip.position(0, j);
        }
        joint.offset = above * joint.offset;
        if (joint.end_site) {
            joint.end_site = rest[j] * *joint.end_site;
        }
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
            glm::dvec3& position = clip.positions[frame * joints + j];
            position = above * position;
            glm::dquat& rotation = clip.rotations[frame * joints + j];
            rotation = glm::normalize(above * rotation * below);
        }
    }
    return clip;
}

}  // namespace raks::motion
