#include "training/figures/repeat_features.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/assert.hpp"
#include "motion/figures/figure_hmm.hpp"
#include "motion/figures/motion_features.hpp"

namespace raks::motion {

PhaseWarp::PhaseWarp(std::span<const double> beat_frames)
    : frames_(beat_frames.begin(), beat_frames.end()), slopes_(beat_frames.size()) {
    RAKS_ASSERT(frames_.size() >= 2);
    const std::size_t last = frames_.size() - 1;
    // The ends take the slope of their only neighbouring interval.
    for (std::size_t i = 0; i <= last; ++i) {
        const double before = i > 0 ? frames_[i] - frames_[i - 1] : frames_[1] - frames_[0];
        const double after = i < last ? frames_[i + 1] - frames_[i] : before;
        // The harmonic mean of both sides keeps the curve rising.
        slopes_[i] = 2.0 * before * after / (before + after);
    }
}

double PhaseWarp::frame_at(double beat) const noexcept {
    const double last = static_cast<double>(frames_.size() - 1);
    if (beat <= 0.0) {
        return frames_.front() + beat * slopes_.front();
    }
    if (beat >= last) {
        return frames_.back() + (beat - last) * slopes_.back();
    }
    const std::size_t i = static_cast<std::size_t>(beat);
    const double t = beat - static_cast<double>(i);
    const double step = frames_[i + 1] - frames_[i];
    // Cubic Hermite polynomial: the chord and a correction by how far the slope at each end (a, b)
    // departs from the chord's.
    const double a = slopes_[i] - step;
    const double b = step - slopes_[i + 1];
    return frames_[i] + t * step + t * (1.0 - t) * ((1.0 - t) * a + t * b);
}

double PhaseWarp::beat_at(double frame) const noexcept {
    if (frame <= frames_.front()) {
        return (frame - frames_.front()) / slopes_.front();
    }
    const double last = static_cast<double>(frames_.size() - 1);
    if (frame >= frames_.back()) {
        return last + (frame - frames_.back()) / slopes_.back();
    }
    // Rising, so bisection finds the only solution.
    double low = 0.0;
    double high = last;
    while (high - low > 1e-9) {
        const double middle = 0.5 * (low + high);
        (frame_at(middle) < frame ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

std::vector<std::vector<Pose>> phased_repeats(std::span<const TrainingClip> clips,
                                              std::span<const FigureRepeat> repeats,
                                              int samples_per_beat,
                                              double low_pass_hz) {
    // Each clip is conditioned once, however many repeats it has, and only if it has any.
    std::vector<std::vector<Pose>> conditioned(clips.size());
    std::vector<std::vector<Pose>> result;
    for (const FigureRepeat& repeat : repeats) {
        const TrainingClip& clip = clips[repeat.clip];
        std::vector<Pose>& poses = conditioned[repeat.clip];
        if (poses.empty()) {
            // Faults first: the filter would smear them over good frames.
            poses = clip.poses;
            bridge_faults(poses, clip.faults);
            poses = filtered(poses, low_pass_taps(low_pass_hz, clip.frames_per_second));
        }
        result.push_back(poses_on_phase(poses, repeat.beat_frames, samples_per_beat));
    }
    return result;
}

PartModel mean_joints(Part which,
                      std::span<const std::vector<Pose>> repeats,
                      std::span<const double> weights,
                      FigureFeatures features,
                      std::span<const Bone> more) {
    PartModel part;
    part.part = which;
    part.features = features;
    std::vector<Bone> bones = default_joints(which, features);
    bones.insert(bones.end(), more.begin(), more.end());
    for (const Bone bone : bones) {
        // Positions need no reference rotation.
        if (features == FigureFeatures::positions) {
            part.joints.push_back({bone});
            continue;
        }
        // All samples of all repeats, each with its repeat's weight.
        std::vector<glm::dquat> rotations;
        std::vector<double> each;
        for (std::size_t r = 0; r < repeats.size(); ++r) {
            for (const Pose& pose : repeats[r]) {
                rotations.emplace_back(pose.rotation(bone));
                each.push_back(weights[r]);
            }
        }
        part.joints.push_back({bone, mean_rotation(rotations, each)});
    }
    return part;
}

models::Frames part_frames(std::span<const Pose> phased,
                           const PartModel& part,
                           int samples_per_beat) {
    constexpr std::size_t kAround = 3;  // one sample before the figure, two after it
    const FeatureTrack track = features_of(phased, part, samples_per_beat);
    return frames_of(track, 1, phased.size() - kAround);
}

namespace {

constexpr double kAlike = M_PI / 3.0;  // radians: turns this close count as the same turn
// Radians from the commonest turn within which a repeat is kept.
constexpr double kKept = M_PI / 2.0;

}  // namespace

double turn_of(const TrainingClip& clip, const FigureRepeat& repeat) {
    const auto heading = [&](std::size_t frame) {
        return heading_of(glm::dquat(clip.poses[frame].rotation(Bone::hips)));
    };
    const auto first = static_cast<std::size_t>(repeat.beat_frames.front());
    const auto last =
        std::min(static_cast<std::size_t>(repeat.beat_frames.back()), clip.poses.size() - 1);
    // Sums the differences from frame to frame, each in (-pi, pi], so that full turns count.
    double turn = 0.0;
    for (std::size_t frame = first; frame < last; ++frame) {
        turn += std::remainder(heading(frame + 1) - heading(frame), 2.0 * M_PI);
    }
    return turn;
}

std::vector<bool> of_common_turn(const std::vector<TrainingClip>& clips,
                                 const std::vector<FigureRepeat>& repeats) {
    std::vector<double> turns;
    for (const FigureRepeat& repeat : repeats) {
        turns.push_back(turn_of(clips[repeat.clip], repeat));
    }
    double common = 0.0;
    // The mode: the turn with most others near it. A mean or median could fall between two kinds of
    // turn.
    std::ptrdiff_t most = 0;
    for (const double turn : turns) {
        const auto alike = std::count_if(turns.begin(), turns.end(), [turn](double other) {
            return std::abs(other - turn) <= kAlike;
        });
        if (alike > most) {
            most = alike;
            common = turn;
        }
    }
    std::vector<bool> kept;
    for (const double turn : turns) {
        kept.push_back(std::abs(turn - common) <= kKept);
    }
    return kept;
}

}  // namespace raks::motion
