#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "base/random.hpp"
#include "motion/figures/figure_model.hpp"
#include "training/figures/figure_trainer.hpp"

namespace raks::motion::test {

/// A known dance: 8 beats of 20 frames at 60 frames a second (180 BPM), repeated. The hips go
/// forward and back 0.2 m once a figure and turn by `turn` radians a figure, the knees and one arm
/// swing, every repeat by a slightly other amplitude.
inline TrainingClip known_dance(int figures, double turn = 0.0) {
    constexpr int kFrames = 160;
    TrainingClip clip;
    clip.name = "known";
    clip.hips_height = 0.9;
    for (int f = 0; f < figures * kFrames + 1; ++f) {
        const double phase = 2.0 * M_PI * f / kFrames;
        const int figure = f / kFrames;
        const double size = 1.0 + 0.05 * std::sin(1.7 * figure);
        const double heading = turn * f / kFrames;
        Pose pose;
        pose.rotation(Bone::hips) =
            glm::angleAxis(static_cast<float>(heading), glm::vec3(0, 1, 0)) *
            glm::angleAxis(static_cast<float>(0.05 * size * std::sin(phase)), glm::vec3(0, 0, 1));
        const auto bend = [&](Bone bone, double angle) {
            pose.rotation(bone) =
                glm::angleAxis(static_cast<float>(size * angle), glm::vec3(1, 0, 0));
        };
        bend(Bone::left_lower_leg, 0.5 + 0.4 * std::sin(phase));
        bend(Bone::right_lower_leg, 0.5 - 0.4 * std::sin(phase));
        bend(Bone::left_upper_arm, 0.3 * std::cos(2 * phase));
        bend(Bone::chest, 0.1 * std::cos(phase));
        pose.hips_position = {0.0F, 0.9F, static_cast<float>(0.2 * size * std::sin(phase))};
        clip.poses.push_back(pose);

        // The left foot rests on the first half of the figure, then steps; the right the reverse.
        std::array<SourceFoot, 2> feet;
        const double t = std::fmod(f, kFrames) / kFrames;
        const auto foot = [&](double when) {
            const double u = std::fmod(t + when, 1.0);
            const double z = u < 0.5 ? 0.0 : 0.3 * std::sin(2.0 * M_PI * (u - 0.5));
            return SourceFoot{{0.0, 0.08, z - 0.1}, {0.0, 0.02, z}};
        };
        feet[0] = foot(0.0);
        feet[1] = foot(0.5);
        clip.feet.push_back(feet);
    }
    return clip;
}

inline std::vector<FigureRepeat> known_repeats(int figures) {
    std::vector<FigureRepeat> repeats;
    for (int r = 0; r < figures; ++r) {
        FigureRepeat repeat;
        for (int b = 0; b <= 8; ++b) {
            repeat.beat_frames.push_back(160.0 * r + 20.0 * b);
        }
        repeats.push_back(repeat);
    }
    return repeats;
}

inline FigureTrainingOptions known_options(int states = 16) {
    FigureTrainingOptions options;
    options.name = "known";
    options.dance = "salsa";
    options.attribution = "made by rule";
    options.states = states;
    return options;
}

/// What is learnt from so many figures of one clip.
inline FigureTrainingResult learnt(const TrainingClip& clip,
                                   int figures,
                                   const FigureTrainingOptions& options) {
    const std::vector<TrainingClip> clips = {clip};
    return train_figure(clips, known_repeats(figures), options).value();
}

/// A small valid model: 4 states of the known dance.
inline FigureModel small_figure() { return learnt(known_dance(3), 3, known_options(4)).model; }

/// A figure's file, cut off and with three bytes changed, 300 times each: refused in one line, or
/// read as a valid figure.
inline void expect_survives_damage(const std::string& good, std::uint64_t seed) {
    constexpr std::uint64_t kTimes = 300;
    const CounterRandom random(seed);
    for (std::uint64_t i = 0; i < kTimes; ++i) {
        const std::size_t length = random.below(i, good.size() - 2);
        EXPECT_FALSE(parse_figure(std::string_view(good).substr(0, length), "x")) << length;
    }
    for (std::uint64_t i = 0; i < kTimes; ++i) {
        std::string text = good;
        for (std::uint64_t j = 0; j < 3; ++j) {
            const std::uint64_t at = 1000 + 6 * i + 2 * j;
            text[random.below(at, text.size())] = static_cast<char>(random.below(at + 1, 256));
        }
        const Expected<FigureModel> model = parse_figure(text, "x");
        if (model) {
            EXPECT_TRUE(validate(*model)) << i;
        } else {
            EXPECT_EQ(model.error().message.find('\n'), std::string::npos) << i;
        }
    }
}

}  // namespace raks::motion::test
