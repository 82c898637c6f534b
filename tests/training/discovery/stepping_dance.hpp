#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "training/figures/figure_trainer.hpp"

namespace raks::motion::test {

/// A dance whose steps are known: repeats of 8 beats with the steps of a mambo, left on 1, 3 and 6,
/// right on 2, 5 and 7, each of which lands on its count.
struct SteppingDance {
    double frames_per_second = 60.0;
    double beat = 0.36;        ///< seconds
    int repeats = 6;           ///< whole ones, the first begins at `start`
    double start = 1.0;        ///< seconds of standing before the first count 1
    double end = 1.0;          ///< seconds of standing after the last repeat
    bool is_mirrored = false;  ///< right begins
    std::vector<int> raised;   ///< repeats with the arms raised: another figure of the same steps

    [[nodiscard]] double count_1(int repeat) const { return start + 8.0 * beat * repeat; }
};

namespace stepping {

struct Step {
    double count;  // beat of the landing, from 0
    double place;  // metres forward
};
constexpr std::array<Step, 3> kFirst = {{{0.0, 0.3}, {2.0, -0.05}, {5.0, 0.1}}};
constexpr std::array<Step, 3> kSecond = {{{1.0, 0.12}, {4.0, -0.3}, {6.0, 0.0}}};
constexpr double kTravel = 0.8;  // beats that a step takes

/// Place of a foot at a beat of the dance, which has `beats` of them.
inline double place_of(const std::array<Step, 3>& steps, double beat, double beats) {
    double place = 0.0;
    for (int cycle = 0; 8 * cycle < beats + 8; ++cycle) {
        for (const Step& step : steps) {
            const double landing = step.count + 8.0 * cycle;
            if (landing >= beats) {
                return place;
            }
            if (beat < landing - kTravel) {
                return place;
            }
            const double t = std::min(1.0, (beat - landing + kTravel) / kTravel);
            place += (step.place - place) * t * t * (3.0 - 2.0 * t);
        }
    }
    return place;
}

}  // namespace stepping

inline TrainingClip stepping_clip(const SteppingDance& dance) {
    TrainingClip clip;
    clip.name = "stepping";
    clip.frames_per_second = dance.frames_per_second;
    clip.hips_height = 0.9;
    const double seconds = dance.count_1(dance.repeats) + dance.end;
    const auto frames = static_cast<std::size_t>(seconds * dance.frames_per_second) + 1;
    for (std::size_t f = 0; f < frames; ++f) {
        const double beat =
            (static_cast<double>(f) / dance.frames_per_second - dance.start) / dance.beat;
        const double beats = 8.0 * dance.repeats;
        std::array<double, 2> z = {stepping::place_of(stepping::kFirst, beat, beats),
                                   stepping::place_of(stepping::kSecond, beat, beats)};
        if (dance.is_mirrored) {
            std::swap(z[0], z[1]);
        }
        Pose pose;
        const double hips = 0.5 * (z[0] + z[1]);
        pose.hips_position = {0.0F, 0.9F, static_cast<float>(hips)};
        const auto bend = [&](Bone bone, double angle) {
            pose.rotation(bone) = glm::angleAxis(static_cast<float>(angle), glm::vec3(1, 0, 0));
        };
        bend(Bone::left_upper_leg, -std::atan((z[0] - hips) / 0.9));
        bend(Bone::right_upper_leg, -std::atan((z[1] - hips) / 0.9));
        const bool is_dancing = beat >= 0.0 && beat < beats;
        const int repeat = is_dancing ? static_cast<int>(beat / 8.0) : -1;
        const double swing = is_dancing ? std::sin(2.0 * M_PI * beat / 8.0) : 0.0;
        bool is_raised = false;
        for (const int raised : dance.raised) {
            is_raised = is_raised || raised == repeat;
        }
        for (const Bone bone : {Bone::left_upper_arm, Bone::right_upper_arm}) {
            const double side = bone == Bone::left_upper_arm ? 1.0 : -1.0;
            const double lift = is_raised ? 1.0 : -1.2;
            pose.rotation(bone) =
                glm::angleAxis(static_cast<float>(side * (lift + 0.2 * swing)), glm::vec3(0, 0, 1));
        }
        clip.poses.push_back(pose);
        std::array<SourceFoot, 2> feet;
        for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
            const double x = side == 0 ? 0.1 : -0.1;
            feet[side] = {{x, 0.08, z[side] - 0.1}, {x, 0.02, z[side]}};
        }
        clip.feet.push_back(feet);
    }
    return clip;
}

}  // namespace raks::motion::test
