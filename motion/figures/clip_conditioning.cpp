#include "motion/figures/clip_conditioning.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace raks::motion {
namespace {

// Linear interpolation of places.
SourceFoot between(const SourceFoot& a, const SourceFoot& b, double t) {
    return {a.ankle + (b.ankle - a.ankle) * t, a.toe_tip + (b.toe_tip - a.toe_tip) * t};
}

std::array<SourceFoot, 2> interpolate(const std::array<SourceFoot, 2>& a,
                                      const std::array<SourceFoot, 2>& b,
                                      double t) {
    return {between(a[0], b[0], t), between(a[1], b[1], t)};
}

Pose interpolate(const Pose& a, const Pose& b, double t) {
    return motion::interpolate(a, b, static_cast<float>(t));
}

// Bridges one fault, for poses and feet alike. The frames next to the fault count as sound.
template <typename Frame>
void bridge(std::span<Frame> frames, FrameSpan fault) {
    if (fault.first >= frames.size() || fault.first > fault.last) {
        return;
    }
    // Labels may reach beyond the end of the clip.
    const std::size_t last = std::min(fault.last, frames.size() - 1);
    const bool has_before = fault.first > 0;
    const bool has_after = last + 1 < frames.size();
    if (!has_before && !has_after) {
        return;
    }
    // At an end of the clip both are the one sound neighbour: the fault holds still.
    const Frame before = has_before ? frames[fault.first - 1] : frames[last + 1];
    const Frame after = has_after ? frames[last + 1] : before;
    // Steps from the frame before the fault to the frame after it.
    const double gap = static_cast<double>(last - fault.first + 2);
    for (std::size_t i = fault.first; i <= last; ++i) {
        frames[i] = interpolate(before, after, static_cast<double>(i - fault.first + 1) / gap);
    }
}

/// Filters one number of each frame, read by `get` and written back by `set`.
template <typename Get, typename Set>
void filter_each(std::size_t count, std::span<const double> taps, const Get& get, const Set& set) {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = get(i);
    }
    values = filtered(values, taps);
    for (std::size_t i = 0; i < count; ++i) {
        set(i, static_cast<float>(values[i]));
    }
}

// Rotations of one bone over time.
void filter_rotation(std::span<Pose> poses, std::size_t bone, std::span<const double> taps) {
    for (std::size_t i = 1; i < poses.size(); ++i) {
        // q and -q are the same rotation, but their mean is not: neighbours get the same sign.
        glm::quat& q = poses[i].local_rotations[bone];
        if (glm::dot(q, poses[i - 1].local_rotations[bone]) < 0.0F) {
            q = -q;
        }
    }
    for (int c = 0; c < 4; ++c) {
        filter_each(
            poses.size(),
            taps,
            [&](std::size_t i) { return static_cast<double>(poses[i].local_rotations[bone][c]); },
            [&](std::size_t i, float value) { poses[i].local_rotations[bone][c] = value; });
    }
    for (Pose& pose : poses) {
        pose.local_rotations[bone] = glm::normalize(pose.local_rotations[bone]);
    }
}

}  // namespace

void bridge_faults(std::span<Pose> poses, std::span<const FrameSpan> faults) {
    for (const FrameSpan& fault : faults) {
        bridge(poses, fault);
    }
}

void bridge_faults(std::span<std::array<SourceFoot, 2>> feet, std::span<const FrameSpan> faults) {
    for (const FrameSpan& fault : faults) {
        bridge(feet, fault);
    }
}

std::vector<double> low_pass_taps(double cutoff_hz, double frames_per_second) {
    const double cutoff = cutoff_hz / frames_per_second;  // cycles a frame
    if (!(cutoff < 0.5)) {
        return {1.0};
    }
    constexpr double kHalfWaves = 3.0;  // of the sinc to each side
    const int reach = static_cast<int>(std::ceil(kHalfWaves / (2.0 * cutoff)));
    std::vector<double> taps;
    double sum = 0.0;
    for (int i = -reach; i <= reach; ++i) {
        const double x = 2.0 * M_PI * cutoff * i;
        const double sinc = i == 0 ? 1.0 : std::sin(x) / x;
        // Zero one tap beyond the reach.
        const double hann = 0.5 + 0.5 * std::cos(M_PI * i / (reach + 1));
        taps.push_back(sinc * hann);
        sum += taps.back();
    }
    // Unit gain at zero frequency: a standing foot stays where it is.
    for (double& tap : taps) {
        tap /= sum;
    }
    return taps;
}

std::vector<double> filtered(std::span<const double> values, std::span<const double> taps) {
    std::vector<double> result(values.size());
    const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(values.size());
    const std::ptrdiff_t reach = static_cast<std::ptrdiff_t>(taps.size() / 2);
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        double sum = 0.0;
        for (std::ptrdiff_t j = -reach; j <= reach; ++j) {
            const std::ptrdiff_t at = std::clamp<std::ptrdiff_t>(i + j, 0, count - 1);
            sum += taps[static_cast<std::size_t>(j + reach)] * values[static_cast<std::size_t>(at)];
        }
        result[static_cast<std::size_t>(i)] = sum;
    }
    return result;
}

std::vector<Pose> filtered(std::span<const Pose> poses, std::span<const double> taps) {
    std::vector<Pose> result(poses.begin(), poses.end());
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
        filter_rotation(result, bone, taps);
    }
    for (int c = 0; c < 3; ++c) {
        filter_each(
            result.size(),
            taps,
            [&](std::size_t i) { return static_cast<double>(result[i].hips_position[c]); },
            [&](std::size_t i, float value) { result[i].hips_position[c] = value; });
    }
    return result;
}

}  // namespace raks::motion
