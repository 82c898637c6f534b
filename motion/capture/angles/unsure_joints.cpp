#include "motion/capture/angles/unsure_joints.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

namespace raks::capture {
namespace {

constexpr double kShortestUnsure = 0.1;  // seconds of a flag

// Of the variable of a joint that is least sure; radians.
double deviation_at(const AngleTrack& track, const TurningJoint& joint, std::size_t frame) {
    const auto first = track.deviations[frame].begin() + static_cast<std::ptrdiff_t>(joint.first);
    return *std::max_element(first, first + static_cast<std::ptrdiff_t>(joint.size()));
}

bool bone_hangs_on(motion::Bone bone, motion::Bone other) {
    std::size_t at = index_of(bone);
    while (at != index_of(other) && at != 0) {
        at = motion::kBoneParents[at];
    }
    return at == index_of(other);
}

// The marker that tells of a joint.
std::optional<std::size_t> marker_telling_of(const TurningJoint& joint,
                                             const std::vector<motion::Bone>& marker_bones) {
    std::optional<std::size_t> hanging;
    for (std::size_t marker = 0; marker < marker_bones.size(); ++marker) {
        for (std::size_t i = 0; i < joint.count; ++i) {
            if (marker_bones[marker] == joint.bones[i]) {
                return marker;
            }
        }
        if (!hanging && bone_hangs_on(marker_bones[marker], joint.bones[0])) {
            hanging = marker;
        }
    }
    return hanging;
}

}  // namespace

std::vector<JointSureness> joint_sureness(const AngleTrack& track, const BodyModel& model) {
    std::vector<JointSureness> all;
    for (const TurningJoint& joint : model.joints()) {
        std::vector<double> deviations;
        for (std::size_t frame = 0; frame < track.states.size(); ++frame) {
            if (!track.is_lost[frame]) {
                deviations.push_back(deviation_at(track, joint, frame));
            }
        }
        JointSureness sureness{joint.name};
        if (!deviations.empty()) {
            std::sort(deviations.begin(), deviations.end());
            sureness.median = deviations[deviations.size() / 2];
            sureness.high = deviations[deviations.size() * 19 / 20];
            const auto sure =
                std::upper_bound(deviations.begin(), deviations.end(), kUnsureDeviation);
            sureness.unsure = static_cast<double>(deviations.end() - sure) /
                              static_cast<double>(deviations.size());
        }
        all.push_back(sureness);
    }
    return all;
}

void flag_unsure_joints(const AngleTrack& track,
                        const BodyModel& model,
                        const std::vector<motion::Bone>& marker_bones,
                        Tracks& tracks) {
    for (const TurningJoint& joint : model.joints()) {
        const auto marker = marker_telling_of(joint, marker_bones);
        std::size_t first = 0;
        for (std::size_t frame = 0; marker && frame <= track.states.size(); ++frame) {
            if (frame < track.states.size() && !track.is_lost[frame] &&
                deviation_at(track, joint, frame) > kUnsureDeviation) {
                continue;
            }
            if (static_cast<double>(frame - first) >= kShortestUnsure * tracks.frames_per_second) {
                tracks.flags.push_back({Doubt::unsure, *marker, first, frame - 1});
            }
            first = frame + 1;
        }
    }
    sort_flags(tracks);
    tracks.flags.erase(std::unique(tracks.flags.begin(), tracks.flags.end()), tracks.flags.end());
}

}  // namespace raks::capture
