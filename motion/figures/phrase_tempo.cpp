#include "motion/figures/phrase_tempo.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace raks::motion {
namespace {

constexpr double kSlowest = 40.0;  // BPM
constexpr double kFastest = 240.0;
constexpr double kShortest = 1.5;  // seconds
constexpr int kMostBeats = 1024;

// Weights of the features: of a logistic regression over all counts of a phrase, learnt on six
// dances of ours (docs/measurements/clips.md), whose phrases had the penalties below.
constexpr std::array<double, kPhraseFeatures> kWeights = {
    // clang-format off
    0.032, 0.135, 0.21, 0.316,  // feet: of four beats, two, one, half a one
    0.092, -0.166, 0.062, 0.107,  // hips' height
    -0.027, 0.038, 0.076, -0.271,  // sway
    -0.197, 0.141, 0.229, 0.199,  // trunk
    -0.069, -0.094, 0.296, -0.004,  // hands
    0.074, -1.139, -0.583,  // octaves from the usual tempo, their square, octaves of steps over beats
    0.012, -0.485, 0.148, 0.691, -1.473,  // steps by what lies before them: least to most beats
    -0.127, -0.041, -0.039, 0.009  // way of the feet in a beat, its square, way of the hands, its square
    // clang-format on
};

// Natural logarithm of how much less likely a number of beats is than the usual ones. A clip that
// lasts longer is less likely to be one phrase.
double length_penalty(int beats, double seconds, int beats_per_bar) {
    constexpr int kMostUsual = 32;
    constexpr double kPhraseSeconds = 8.0;
    constexpr double kBars = 6.0;  // whole ones, and what is longer than a phrase
    constexpr double kEven = 9.0;
    constexpr double kOdd = 12.0;
    int usual = beats_per_bar % 3 == 0 ? 3 : 4;
    while (usual < beats && usual < kMostUsual) {
        usual *= 2;
    }
    const double share = std::min(1.0, kPhraseSeconds / seconds);
    if (beats == usual) {
        return 0.0;
    }
    const bool is_whole = beats > kMostUsual || beats % beats_per_bar == 0;
    return share * (is_whole ? kBars : beats % 2 == 0 ? kEven : kOdd);
}

// What the stretch that repeats best says for a tempo: it has two, four or eight beats.
double repeat_bonus(const PhraseRepeat& repeat, double bpm) {
    constexpr double kWeight = 4.0;
    constexpr double kOctaves = 0.03;  // deviation
    constexpr double kLeastDistance = 0.05;
    if (!(repeat.seconds > 0.0)) {
        return 0.0;
    }
    double nearest = 0.0;
    for (const double beats : {2.0, 4.0, 8.0}) {
        const double off = std::log2(60.0 * beats / bpm / repeat.seconds) / kOctaves;
        nearest = std::max(nearest, std::exp(-0.5 * off * off));
    }
    return kWeight * nearest * std::max(0.0, -std::log(kLeastDistance + repeat.distance));
}

}  // namespace

std::vector<PhraseCount> count_phrase(const PhraseSignals& signals, int beats_per_bar) {
    std::vector<PhraseCount> counts;
    const double seconds = signals.seconds();
    if (seconds < kShortest) {
        return counts;
    }
    const int least = std::max(2, static_cast<int>(std::ceil(kSlowest * seconds / 60.0)));
    const int most = std::min(kMostBeats, static_cast<int>(std::floor(kFastest * seconds / 60.0)));
    double best = -1e9;
    for (int beats = least; beats <= most; ++beats) {
        PhraseCount count{beats, 60.0 * beats / seconds, 0.0};
        const std::array<double, kPhraseFeatures> features = signals.features(count.bpm);
        count.probability = repeat_bonus(signals.repeat(), count.bpm) -
                            length_penalty(beats, seconds, beats_per_bar);
        for (std::size_t i = 0; i < features.size(); ++i) {
            count.probability += kWeights[i] * features[i];
        }
        best = std::max(best, count.probability);
        counts.push_back(count);
    }
    double sum = 0.0;
    for (PhraseCount& count : counts) {
        count.probability = std::exp(count.probability - best);
        sum += count.probability;
    }
    for (PhraseCount& count : counts) {
        count.probability /= sum;
    }
    std::sort(counts.begin(), counts.end(), [](const PhraseCount& a, const PhraseCount& b) {
        return a.probability != b.probability ? a.probability > b.probability : a.beats < b.beats;
    });
    return counts;
}

namespace {

// Between two rotations, radians.
float turn_between(const glm::quat& a, const glm::quat& b) noexcept {
    return 2.0F * std::acos(std::min(1.0F, std::abs(glm::dot(a, b))));
}

// The farthest that a joint turns from one pose to another.
float turn_between(const Pose& a, const Pose& b) noexcept {
    float most = 0.0F;
    for (std::size_t bone = 0; bone < a.local_rotations.size(); ++bone) {
        most = std::max(most, turn_between(a.local_rotations[bone], b.local_rotations[bone]));
    }
    return most;
}

}  // namespace

bool is_rest_pose(const Pose& pose) noexcept {
    constexpr float kStraight = 0.2F;  // radians
    constexpr std::array<Bone, 8> kStraightBones = {Bone::spine,
                                                    Bone::chest,
                                                    Bone::left_upper_leg,
                                                    Bone::right_upper_leg,
                                                    Bone::left_lower_leg,
                                                    Bone::right_lower_leg,
                                                    Bone::left_lower_arm,
                                                    Bone::right_lower_arm};
    const glm::quat& right = pose.rotation(Bone::right_upper_arm);
    const glm::quat mirrored(right.w, right.x, -right.y, -right.z);
    return turn_between(pose.rotation(Bone::left_upper_arm), mirrored) < kStraight &&
           std::all_of(kStraightBones.begin(), kStraightBones.end(), [&](Bone bone) {
               return turn_between(pose.rotation(bone), kNoRotation) < kStraight;
           });
}

std::size_t leading_rest_poses(std::span<const Pose> poses, double frames_per_second) noexcept {
    constexpr float kStill = 0.03F;  // radians from the first pose
    constexpr float kLeap = 0.3F;    // radians to the next pose: nobody moved there
    constexpr double kHeld = 0.3;    // seconds; who stands for less begins from a stance
    std::size_t rests = 0;
    while (rests < poses.size() && is_rest_pose(poses[rests]) &&
           turn_between(poses[rests], poses[0]) < kStill) {
        ++rests;
    }
    if (rests == 0 || rests == poses.size()) {
        return 0;
    }
    const bool is_held = static_cast<double>(rests) >= kHeld * frames_per_second;
    return is_held || turn_between(poses[rests - 1], poses[rests]) > kLeap ? rests : 0;
}

}  // namespace raks::motion
