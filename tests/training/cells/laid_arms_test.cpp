#include "training/cells/laid_arms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

constexpr double kLaidRate = 60.0;
constexpr double kLaidBeat = 0.5;  // seconds
constexpr std::size_t kLaidBeats = 17;

/// Seventeen beats; arms go up and down once a beat by an angle that grows from beat to beat, but
/// hang still in beats 5 to 8.
struct HangingArms {
    PreparedTake take;
    std::vector<TakeBeat> beats;
    std::vector<BeatFate> fates;
};

float laid_angle_at(double beat) {
    const double phase = beat - std::floor(beat);
    return static_cast<float>((0.4 + 0.05 * std::floor(beat)) * std::sin(M_PI * phase));
}

bool hangs(std::size_t beat) { return beat >= 5 && beat < 9; }

HangingArms hanging_arms() {
    HangingArms made;
    TrainingClip clip;
    clip.name = "made";
    clip.frames_per_second = kLaidRate;
    clip.hips_height = 0.95;
    const auto frames = static_cast<std::size_t>(kLaidBeats * kLaidBeat * kLaidRate) + 1;
    for (std::size_t frame = 0; frame < frames; ++frame) {
        const double beat = static_cast<double>(frame) / kLaidRate / kLaidBeat;
        Pose pose;
        pose.hips_position = {0.0F, 0.95F, 0.0F};
        const bool still = hangs(static_cast<std::size_t>(beat));
        for (const Bone arm : {Bone::left_upper_arm, Bone::right_upper_arm}) {
            pose.rotation(arm) =
                glm::angleAxis(still ? 0.0F : laid_angle_at(beat), glm::vec3(1.0F, 0.0F, 0.0F));
        }
        pose.rotation(Bone::left_upper_leg) =
            glm::angleAxis(static_cast<float>(0.1 * beat), glm::vec3(1.0F, 0.0F, 0.0F));
        clip.poses.push_back(pose);
        clip.feet.emplace_back();
    }
    made.take.clip = clip;
    made.take.postures.is_home.assign(frames, false);
    for (std::size_t beat = 0; beat <= kLaidBeats; ++beat) {
        TakeBeat row;
        row.take = "made";
        row.time = kLaidBeat * static_cast<double>(beat);
        row.half = beat % 2 == 0 ? 1 : 2;
        row.is_used = beat < kLaidBeats;
        made.beats.push_back(row);
        made.fates.push_back(beat == kLaidBeats ? BeatFate::unused
                             : hangs(beat)      ? BeatFate::home
                                                : BeatFate::danced);
    }
    for (std::size_t frame = 0; frame < frames; ++frame) {
        made.take.postures.is_home[frame] =
            hangs(static_cast<std::size_t>(static_cast<double>(frame) / kLaidRate / kLaidBeat));
    }
    return made;
}

float arm_at(const PreparedTake& take, double beat) {
    const auto frame = static_cast<std::size_t>(std::lround(beat * kLaidBeat * kLaidRate));
    return glm::angle(take.clip.poses[frame].rotation(Bone::left_upper_arm));
}

TEST(LaidArms, are_those_of_other_beats_of_the_same_half) {
    HangingArms made_up = hanging_arms();
    const PreparedTake before = made_up.take;
    EXPECT_EQ(lay_arms(made_up.take, made_up.beats, made_up.fates), 4U);
    const PreparedTake& take = made_up.take;
    // In the middle of each beat the arms are those of some other beat there, the next one's in the
    // next beat; the first of them has the same half.
    const auto donor_of = [&](std::size_t beat) {
        return std::lround(
            (static_cast<double>(arm_at(take, static_cast<double>(beat) + 0.5)) - 0.4) / 0.05);
    };
    const long first = donor_of(5);
    EXPECT_EQ(first % 2, 1);
    for (std::size_t beat = 5; beat < 9; ++beat) {
        EXPECT_EQ(donor_of(beat), first + static_cast<long>(beat) - 5) << beat;
        EXPECT_FALSE(hangs(static_cast<std::size_t>(donor_of(beat)))) << beat;
    }
    for (std::size_t frame = 0; frame < take.clip.poses.size(); ++frame) {
        EXPECT_FALSE(take.postures.is_home[frame]) << frame;
        EXPECT_EQ(take.clip.poses[frame].rotation(Bone::left_upper_leg),
                  before.clip.poses[frame].rotation(Bone::left_upper_leg));
    }
    // What was danced stays.
    for (const double beat : {2.5, 4.5, 9.5, 12.5}) {
        EXPECT_EQ(arm_at(take, beat), arm_at(before, beat)) << beat;
    }
}

TEST(LaidArms, change_nothing_where_there_are_no_others) {
    HangingArms made_up = hanging_arms();
    std::fill(made_up.fates.begin(), made_up.fates.end(), BeatFate::home);
    const std::vector<Pose> before = made_up.take.clip.poses;
    EXPECT_EQ(lay_arms(made_up.take, made_up.beats, made_up.fates), 0U);
    for (std::size_t frame = 0; frame < before.size(); ++frame) {
        EXPECT_EQ(made_up.take.clip.poses[frame].rotation(Bone::left_upper_arm),
                  before[frame].rotation(Bone::left_upper_arm));
    }
}

}  // namespace
}  // namespace raks::motion
