#include "motion/dance/key_moment.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr int kSamples = 8;  // between which the calmest moment is looked for

/// How far the body goes from one pose to another: radians of all bones, and the hips' way.
float way_between(const Pose& from, const Pose& to) noexcept {
    constexpr float kPerMetre = 4.0F;  // a hip's way weighs as much as that turn of one bone
    float way = kPerMetre * glm::distance(from.hips_position, to.hips_position);
    for (std::size_t bone = 0; bone < from.local_rotations.size(); ++bone) {
        const float cosine =
            std::abs(glm::dot(from.local_rotations[bone], to.local_rotations[bone]));
        way += 2.0F * std::acos(std::min(cosine, 1.0F));
    }
    return way;
}

}  // namespace

Beats key_moment(const DanceSequence& sequence, Beats from, Beats to) noexcept RAKS_NONBLOCKING {
    const Beats step((to - from).count() / kSamples);
    Beats best = to;
    float least = INFINITY;
    Pose before = sequence.at(from - step);
    for (int sample = 0; sample <= kSamples; ++sample) {
        const Beats at = from + Beats(step.count() * sample);
        const Pose pose = sequence.at(at);
        const bool stands = pose.foot_contact[0] && pose.foot_contact[1];
        constexpr float kOnOneFoot = 100.0F;
        const float way = way_between(before, pose) + (stands ? 0.0F : kOnOneFoot);
        if (way < least) {
            least = way;
            best = at;
        }
        before = pose;
    }
    return best;
}

Beats stands_until(const DanceSequence& sequence, Beats from, Beats to) noexcept RAKS_NONBLOCKING {
    constexpr Beats kStep(0.2);
    Beats stood = from;
    for (Beats at = from; at <= to; at = at + kStep) {
        const Pose pose = sequence.at(at);
        if (!pose.foot_contact[0] || !pose.foot_contact[1]) {
            return stood;
        }
        stood = at;
    }
    return stood;
}

}  // namespace raks::motion
