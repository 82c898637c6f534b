#include "apps/raks/clip_document.hpp"

#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "base/json.hpp"
#include "base/printable.hpp"

namespace raks::apps {
namespace {

constexpr std::array<std::string_view, 3> kRestNames = {"t-pose", "turned t-pose", "other"};

// Numbers as people read them.
double rounded(double value) { return std::round(value * 1e4) / 1e4; }

Json joints_of(const motion::MotionClip& clip, const motion::FoundJoints& found) {
    Json joints = Json::object();
    for (std::size_t bone = 0; bone < found.mapping.joints.size(); ++bone) {
        if (const auto joint = found.mapping.joints[bone]) {
            joints[std::string(motion::kBoneNames[bone])] = {
                {"joint", printable(clip.joints[*joint].name)},
                {"reason", found.reasons[bone]},
                {"confidence", rounded(found.confidence[bone])}};
        }
    }
    return joints;
}

Json rest_of(const motion::RestPose& rest) {
    Json turns = Json::object();
    for (std::size_t bone = 0; bone < rest.bones.size(); ++bone) {
        const glm::dquat& q = rest.bones[bone];
        turns[std::string(motion::kBoneNames[bone])] = {
            rounded(q.w), rounded(q.x), rounded(q.y), rounded(q.z)};
    }
    return {{"kind", kRestNames[static_cast<std::size_t>(rest.kind)]},
            {"reason", rest.reason},
            {"confidence", rounded(rest.confidence)},
            {"to_t_pose", turns}};
}

}  // namespace

std::string clip_document(const std::string& file,
                          const motion::MotionClip& clip,
                          const render::ClipBodies& recorded) {
    Json document = {{"format", "raks-clip"},
                     {"version", 1},
                     {"file", printable(file)},
                     {"frames", clip.frame_count},
                     {"frames_per_second", clip.frames_per_second},
                     {"metres_per_unit", recorded.metres_per_unit()}};
    if (const auto& body = recorded.body()) {
        document["joints"] = joints_of(clip, body->joints);
        document["up"] = {{"axis", motion::axis_name(body->up.axis)},
                          {"reason", body->up.reason},
                          {"confidence", rounded(body->up.confidence)}};
        document["rest"] = rest_of(body->rest);
        document["unit"] = {{"name", motion::unit_name(body->size.metres_per_unit)},
                            {"reason", body->size.reason},
                            {"confidence", rounded(body->size.confidence)}};
        document["height"] = rounded(body->size.height);
        document["floor"] = {{"metres", rounded(body->stance.floor * body->size.metres_per_unit)},
                             {"confidence", rounded(body->stance.floor_confidence)}};
        document["facing"] = {{"degrees", rounded(body->stance.facing)},
                              {"confidence", rounded(body->stance.facing_confidence)}};
    }
    document["notes"] = recorded.notes();
    return document.text(2);
}

}  // namespace raks::apps
