#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "base/smooth_steps.hpp"
#include "motion/figures/label_tables.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "training/figures/figure_trainer.hpp"

namespace raks::motion::test {

/// A take whose beats are known: at each one the body is in a key pose, and goes over to the next.
struct MadeTake {
    std::string name = "made";
    /// By beat; ~key is the mirror image of a key.
    std::vector<int> keys;
    double frames_per_second = 60.0;
    double beat = 0.5;    ///< seconds
    double start = 0.6;   ///< seconds before the first beat, and behind the last one
    double unlike = 0.0;  ///< radians by which a key differs from time to time
    double way = 0.0;     ///< metres forward a second
    double size = 1.0;    ///< of the body against the built-in one
    double steps_late =
        0.0;  ///< beats from a beat to the landing of the left foot, each second one
    bool is_stepping = false;
};

/// Keys drawn at random.
inline std::vector<int> random_keys(std::size_t beats, int alphabet, std::uint64_t seed) {
    const CounterRandom random(seed);
    std::vector<int> keys;
    for (std::size_t i = 0; i < beats; ++i) {
        keys.push_back(static_cast<int>(random.below(i, static_cast<std::uint64_t>(alphabet))));
    }
    return keys;
}

inline Pose key_pose(int key, double unlike, std::uint64_t beat) {
    const bool is_mirrored = key < 0;
    const auto number = static_cast<std::uint64_t>(is_mirrored ? ~key : key);
    const CounterRandom random(number + 1);
    const CounterRandom trembling(77, number + 1);
    std::uint64_t draw = 0;
    const auto angle = [&](double from, double to) {
        const double differs = unlike * (2.0 * trembling.uniform(64 * beat + draw) - 1.0);
        return static_cast<float>(from + (to - from) * random.uniform(draw++) + differs);
    };
    Pose pose;
    for (const Side side : kSides) {
        const float out = side == Side::left ? 1.0F : -1.0F;
        pose.rotation(on_side(Bone::left_upper_arm, side)) =
            glm::angleAxis(out * angle(-1.3, 1.0), glm::vec3(0, 0, 1)) *
            glm::angleAxis(out * angle(-1.0, 0.6), glm::vec3(0, 1, 0));
        pose.rotation(on_side(Bone::left_lower_arm, side)) =
            glm::angleAxis(out * angle(-2.0, -0.2), glm::vec3(0, 1, 0));
        pose.rotation(on_side(Bone::left_lower_leg, side)) =
            glm::angleAxis(angle(0.1, 0.9), glm::vec3(1, 0, 0));
    }
    pose.rotation(Bone::spine) = glm::angleAxis(angle(-0.3, 0.3), glm::vec3(0, 0, 1));
    pose.rotation(Bone::chest) = glm::angleAxis(angle(-0.3, 0.3), glm::vec3(0, 1, 0));
    return is_mirrored ? mirrored(pose) : pose;
}

/// Feet that stand, or of which the left one steps to every other beat.
inline std::array<SourceFoot, 2> made_feet(const MadeTake& take, double beats, double z) {
    std::array<SourceFoot, 2> feet;
    for (std::size_t s = 0; s < 2; ++s) {
        double ahead = z;
        if (take.is_stepping && s == 0) {
            // It goes 30 cm ahead and back within half a beat, so that it lands on each beat.
            const double at = beats - take.steps_late;
            const double share =
                smootherstep(static_cast<float>(2.0 * (at - std::floor(at)) - 1.0));
            const bool is_out = std::fmod(std::floor(at) + 1000.0, 2.0) < 0.5;
            ahead += 0.3 * (is_out ? 1.0 - share : share);
        }
        const double x = s == 0 ? 0.1 : -0.1;
        feet[s] = {{x, 0.08, ahead}, {x, 0.0, ahead + 0.19}};
    }
    return feet;
}

inline TrainingClip made_clip(const MadeTake& take) {
    TrainingClip clip;
    clip.name = take.name;
    clip.frames_per_second = take.frames_per_second;
    const auto hips = static_cast<double>(mannequin_skeleton().hips_height()) * take.size;
    clip.hips_height = hips;
    const auto last = static_cast<double>(take.keys.size() - 1);
    const double seconds = 2.0 * take.start + take.beat * last;
    for (int f = 0; f <= static_cast<int>(seconds * take.frames_per_second); ++f) {
        const double time = f / take.frames_per_second;
        const double beats = (time - take.start) / take.beat;
        const double at = std::min(std::max(beats, 0.0), last - 1e-9);
        const auto key = static_cast<std::size_t>(at);
        Pose pose = interpolate(key_pose(take.keys[key], take.unlike, key),
                                key_pose(take.keys[key + 1], take.unlike, key + 1),
                                smootherstep(static_cast<float>(at - std::floor(at))));
        const double bounce = std::sin(M_PI * beats);
        pose.hips_position = {0.0F,
                              static_cast<float>(hips - 0.06 * take.size * bounce * bounce),
                              static_cast<float>(take.way * time)};
        clip.poses.push_back(pose);
        clip.feet.push_back(made_feet(take, beats, take.way * time));
    }
    return clip;
}

/// Its beats, all used.
inline std::vector<TakeBeat> made_beats(const MadeTake& take) {
    std::vector<TakeBeat> beats;
    for (std::size_t i = 0; i < take.keys.size(); ++i) {
        beats.push_back({take.name,
                         take.start + take.beat * static_cast<double>(i),
                         1 + static_cast<int>(i % 2),
                         true,
                         i + 2});
    }
    return beats;
}

}  // namespace raks::motion::test
