#include "motion/evaluate/dynamics_measures.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/statistics.hpp"
#include "motion/skeleton/body/body_finder.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kLeg = 0.83;             // metres, hip to ankle
constexpr double kSmoothing = 1.2;        // frames: 20 ms
constexpr double kSecond = 30.0;          // frames: a Gaussian as wide as a second
constexpr double kStillHand = 0.15;       // m/s
constexpr std::size_t kHoldFrames = 12;   // 0.2 s
constexpr std::size_t kBeatSamples = 16;  // of a bar's shape
constexpr double kDistinct = 0.10;        // metres
constexpr std::size_t kBarMoments = 64;   // of a bar that is compared with its first time

// Index in kDynamicsBones.
constexpr std::size_t place_of(Bone bone) {
    std::size_t i = 0;
    while (kDynamicsBones[i] != bone) {
        ++i;
    }
    return i;
}
constexpr std::size_t kPelvis = place_of(Bone::hips);
constexpr std::size_t kChest = place_of(Bone::upper_chest);
constexpr std::array<std::size_t, 2> kHands = {place_of(Bone::left_hand),
                                               place_of(Bone::right_hand)};

using AllPlaces = std::array<Places, kDynamicsBones.size()>;

// Weights of a Gaussian, up to four deviations to either side.
std::vector<double> gaussian(double deviation) {
    const auto radius = static_cast<std::ptrdiff_t>(4.0 * deviation + 0.5);
    std::vector<double> weights;
    double sum = 0.0;
    for (std::ptrdiff_t i = -radius; i <= radius; ++i) {
        weights.push_back(std::exp(-0.5 * std::pow(static_cast<double>(i) / deviation, 2.0)));
        sum += weights.back();
    }
    for (double& weight : weights) {
        weight /= sum;
    }
    return weights;
}

// Values averaged by the weights; before the first comes the first again, then the second, ...
template <typename Value>
std::vector<Value> averaged(std::span<const Value> values, double deviation) {
    const std::vector<double> weights = gaussian(deviation);
    const auto radius = static_cast<std::ptrdiff_t>(weights.size() / 2);
    const auto count = static_cast<std::ptrdiff_t>(values.size());
    std::vector<Value> result(values.size(), Value{});
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        Value sum{};
        for (std::ptrdiff_t k = -radius; k <= radius; ++k) {
            std::ptrdiff_t at = (i + k) % (2 * count);
            at = at < 0 ? at + 2 * count : at;
            at = at >= count ? 2 * count - 1 - at : at;
            sum += weights[static_cast<std::size_t>(k + radius)] *
                   values[static_cast<std::size_t>(at)];
        }
        result[static_cast<std::size_t>(i)] = sum;
    }
    return result;
}

// Derivative by central differences, one-sided at the ends; a second.
template <typename Value>
std::vector<Value> gradient(const std::vector<Value>& values) {
    std::vector<Value> result(values.size(), Value{});
    for (std::size_t i = 0; values.size() > 1 && i < values.size(); ++i) {
        const std::size_t before = i > 0 ? i - 1 : 0;
        const std::size_t after = std::min(i + 1, values.size() - 1);
        result[i] = (values[after] - values[before]) *
                    (kDynamicsRate / static_cast<double>(after - before));
    }
    return result;
}

std::vector<double> lengths(const Places& vectors) {
    std::vector<double> result(vectors.size());
    std::transform(vectors.begin(), vectors.end(), result.begin(), [](const glm::dvec3& v) {
        return glm::length(v);
    });
    return result;
}

double mean_of(std::span<const double> values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value;
    }
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

// A quotient of percentiles; what hardly moves must not divide by nothing.
double spread(const std::vector<double>& values, double low, double high) {
    return percentile(values, high) / std::max(percentile(values, low), 1e-3);
}

// Metres of the reference body per metre of this one.
double leg_scale(const AllPlaces& places) {
    const Places& hip = places[place_of(Bone::left_upper_leg)];
    const Places& knee = places[place_of(Bone::left_lower_leg)];
    const Places& ankle = places[place_of(Bone::left_foot)];
    std::vector<double> legs;
    for (std::size_t f = 0; f < hip.size(); ++f) {
        legs.push_back(glm::distance(hip[f], knee[f]) + glm::distance(knee[f], ankle[f]));
    }
    const double leg = percentile(std::move(legs), 0.5);
    return leg > 0.0 ? kLeg / leg : 1.0;
}

// Places of one joint on the even grid of the measures.
Places resampled(const Places& places, double rate, double scale, const DanceStretch& stretch) {
    Places result;
    const double last = static_cast<double>(places.size()) - 1.0;
    const double to = std::min(stretch.to, last / rate);
    const auto count =
        static_cast<std::size_t>(std::max(0.0, std::ceil((to - stretch.from) * kDynamicsRate)));
    for (std::size_t i = 0; i < count; ++i) {
        const double at =
            std::clamp((stretch.from + static_cast<double>(i) / kDynamicsRate) * rate, 0.0, last);
        const auto below = static_cast<std::size_t>(at);
        const std::size_t above = std::min(below + 1, places.size() - 1);
        result.push_back(scale *
                         (places[below] + (at - std::floor(at)) * (places[above] - places[below])));
    }
    return result;
}

// The angle by which the pelvis faces away from +z, averaged; radians, without jumps of a turn.
std::vector<double> facing(const AllPlaces& places) {
    const Places& left = places[place_of(Bone::left_upper_leg)];
    const Places& right = places[place_of(Bone::right_upper_leg)];
    std::vector<double> angles;
    for (std::size_t f = 0; f < left.size(); ++f) {
        const glm::dvec3 across = left[f] - right[f];
        double angle = std::atan2(-across.z, across.x);
        if (!angles.empty()) {
            angle += 2.0 * M_PI * std::round((angles.back() - angle) / (2.0 * M_PI));
        }
        angles.push_back(angle);
    }
    return averaged<double>(angles, kSecond);
}

// The places in the body's frame.
AllPlaces in_body(const AllPlaces& world) {
    const std::vector<double> angles = facing(world);
    AllPlaces body;
    for (std::size_t b = 0; b < body.size(); ++b) {
        for (std::size_t f = 0; f < angles.size(); ++f) {
            const glm::dvec3 from =
                world[b][f] - glm::dvec3(world[kPelvis][f].x, 0.0, world[kPelvis][f].z);
            const double c = std::cos(angles[f]);
            const double s = std::sin(angles[f]);
            body[b].push_back({c * from.x - s * from.z, from.y, s * from.x + c * from.z});
        }
    }
    return body;
}

DynamicsTrack track_of(const AllPlaces& places, double rate, const DanceStretch& stretch) {
    DynamicsTrack track;
    track.begins = stretch.from;
    if (places[0].empty()) {
        return track;
    }
    const double scale = leg_scale(places);
    for (std::size_t b = 0; b < places.size(); ++b) {
        track.world[b] =
            averaged<glm::dvec3>(resampled(places[b], rate, scale, stretch), kSmoothing);
    }
    track.body = in_body(track.world);
    return track;
}

// Stretches of at least kHoldFrames below a limit.
std::size_t holds(const std::vector<double>& speeds, double limit) {
    std::size_t count = 0;
    std::size_t run = 0;
    for (const double speed : speeds) {
        run = speed < limit ? run + 1 : 0;
        count += run == kHoldFrames ? 1 : 0;
    }
    return count;
}

// Root mean square distance of two bars, given by the frames of their samples.
double bar_distance(const DynamicsTrack& track,
                    std::span<const std::size_t> a,
                    std::span<const std::size_t> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < kMovingBones; ++j) {
            const glm::dvec3 apart = track.body[j][a[i]] - track.body[j][b[i]];
            sum += glm::dot(apart, apart);
        }
    }
    return std::sqrt(sum / static_cast<double>(a.size() * kMovingBones));
}

// Frames of the samples of each whole bar, kBeatSamples a beat.
std::vector<std::vector<std::size_t>> bars_of(const DynamicsTrack& track, const BarBeats& beats) {
    std::vector<double> frames;
    for (const double time : beats.times) {
        const double frame = (time - track.begins) * kDynamicsRate;
        if (frame > 0.0 && frame < static_cast<double>(track.frames()) - 1.0) {
            frames.push_back(frame);
        }
    }
    const auto bar = static_cast<std::size_t>(beats.beats_per_bar);
    std::vector<std::vector<std::size_t>> bars;
    for (std::size_t first = 0; first + bar < frames.size(); first += bar) {
        auto& samples = bars.emplace_back();
        for (std::size_t i = 0; i < bar * kBeatSamples; ++i) {
            const std::size_t beat = first + i / kBeatSamples;
            const double share = static_cast<double>(i % kBeatSamples) / kBeatSamples;
            samples.push_back(static_cast<std::size_t>(
                std::nearbyint(frames[beat] + share * (frames[beat + 1] - frames[beat]))));
        }
    }
    return bars;
}

void measure_bars(const DynamicsTrack& track, const BarBeats& beats, DynamicsMeasures& measures) {
    const auto bars = bars_of(track, beats);
    if (bars.size() < 2) {
        return;
    }
    std::vector<double> nearest(bars.size(), std::numeric_limits<double>::infinity());
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < bars.size(); ++i) {
        std::vector<double> apart(bars.size());
        for (std::size_t j = 0; j < bars.size(); ++j) {
            apart[j] = bar_distance(track, bars[i], bars[j]);
            nearest[i] = i == j ? nearest[i] : std::min(nearest[i], apart[j]);
        }
        if (std::all_of(
                kept.begin(), kept.end(), [&](std::size_t j) { return apart[j] >= kDistinct; })) {
            kept.push_back(i);
        }
    }
    measures.nearest_bar = percentile(std::move(nearest), 0.5);
    measures.distinct_bars = static_cast<double>(kept.size()) / static_cast<double>(bars.size());
}

// Pearson's; 0 where either does not change.
double correlation(std::span<const double> a, std::span<const double> b) {
    const double mean_a = mean_of(a);
    const double mean_b = mean_of(b);
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - mean_a) * (b[i] - mean_b);
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
    }
    return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

// Frames of kBarMoments moments of a stretch; none where it does not lie in the track.
std::vector<std::size_t> moments_of(const DynamicsTrack& track, const DanceStretch& stretch) {
    std::vector<std::size_t> moments;
    const double from = (stretch.from - track.begins) * kDynamicsRate;
    const double to = (stretch.to - track.begins) * kDynamicsRate;
    if (from >= 0.0 && to > from && to < static_cast<double>(track.frames())) {
        for (std::size_t i = 0; i < kBarMoments; ++i) {
            const double share = static_cast<double>(i) / kBarMoments;
            moments.push_back(static_cast<std::size_t>(from + share * (to - from)));
        }
    }
    return moments;
}

}  // namespace

PartRepeats measure_repeats(const DynamicsTrack& track, std::span<const RepeatedBar> bars) {
    PartRepeats repeats;
    std::vector<double> apart;
    for (const RepeatedBar& bar : bars) {
        const std::vector<std::size_t> now = moments_of(track, bar.bar);
        const std::vector<std::size_t> first = moments_of(track, bar.first);
        if (!now.empty() && !first.empty()) {
            apart.push_back(bar_distance(track, now, first));
            repeats.alike += apart.back() < kDistinct ? 1U : 0U;
        }
    }
    repeats.bars = apart.size();
    repeats.apart = percentile(std::move(apart), 0.5);
    return repeats;
}

DynamicsTrack dynamics_track(const Skeleton& skeleton,
                             std::span<const Pose> poses,
                             double frames_per_second,
                             DanceStretch stretch) {
    AllPlaces places;
    for (const Pose& pose : poses) {
        const WorldPose world = world_pose(skeleton, pose);
        for (std::size_t b = 0; b < places.size(); ++b) {
            places[b].emplace_back(world.position(kDynamicsBones[b]));
        }
    }
    return track_of(places, frames_per_second, stretch);
}

Expected<DynamicsTrack> dynamics_track(const MotionClip& recorded, DanceStretch stretch) {
    const Expected<StandingClip> standing = stand(recorded);
    if (!standing) {
        return tl::unexpected(standing.error());
    }
    const MotionClip& clip = standing->clip;
    const HumanoidMapping& mapping = standing->body.mapping();
    std::array<std::size_t, kDynamicsBones.size()> joints{};
    std::array<bool, kDynamicsBones.size()> is_tip{};
    for (std::size_t b = 0; b < kDynamicsBones.size(); ++b) {
        const Bone bone = kDynamicsBones[b];
        auto joint = mapping.joint(bone);
        if (!joint && bone == Bone::upper_chest) {
            joint = mapping.joint(Bone::chest);
        }
        if (!joint && (bone == Bone::left_toes || bone == Bone::right_toes)) {
            joint = mapping.joint(bone == Bone::left_toes ? Bone::left_foot : Bone::right_foot);
            is_tip[b] = true;
        }
        if (!joint) {
            return fail("the body has no " + std::string(kBoneNames[index_of(bone)]) +
                        ", which the measures need");
        }
        joints[b] = *joint;
    }
    AllPlaces places;
    for (std::size_t f = 0; f < clip.frame_count; ++f) {
        const ClipWorldPose world = world_pose(clip, f);
        for (std::size_t b = 0; b < places.size(); ++b) {
            const std::size_t joint = joints[b];
            const glm::dvec3 tip =
                is_tip[b] ? clip.joints[joint].end_site.value_or(glm::dvec3(0.0)) : glm::dvec3(0.0);
            places[b].push_back(world.positions[joint] + world.rotations[joint] * tip);
        }
    }
    return track_of(places, clip.frames_per_second, stretch);
}

std::vector<double> body_speeds(const DynamicsTrack& track) {
    std::vector<double> result(track.frames(), 0.0);
    for (std::size_t b = 0; b < kMovingBones; ++b) {
        const std::vector<double> one = lengths(gradient(track.body[b]));
        for (std::size_t f = 0; f < result.size(); ++f) {
            result[f] += one[f] / static_cast<double>(kMovingBones);
        }
    }
    return result;
}

DynamicsMeasures measure_dynamics(const DynamicsTrack& track, const BarBeats& beats) {
    DynamicsMeasures measures;
    if (track.frames() < 2) {
        return measures;
    }
    const std::vector<double> speed = body_speeds(track);
    const double minutes = static_cast<double>(speed.size()) / (60.0 * kDynamicsRate);
    measures.body_speed = mean_of(speed);
    measures.second_spread = spread(gaussian_average(speed, kSecond), 0.05, 0.95);
    measures.body_spread = spread(speed, 0.10, 0.95);
    measures.holds_per_minute =
        static_cast<double>(holds(speed, percentile(speed, 0.5) / 3.0)) / minutes;
    for (const std::size_t hand : kHands) {
        Places about_chest(track.frames());
        for (std::size_t f = 0; f < about_chest.size(); ++f) {
            about_chest[f] = track.body[hand][f] - track.body[kChest][f];
        }
        const std::vector<double> speeds = lengths(gradient(about_chest));
        measures.hand_speed += 0.5 * mean_of(speeds);
        const auto still = std::count_if(
            speeds.begin(), speeds.end(), [](double value) { return value < kStillHand; });
        measures.still_hands +=
            0.5 * static_cast<double>(still) / static_cast<double>(speeds.size());
        const std::vector<double> acceleration =
            lengths(gradient(gradient(averaged<glm::dvec3>(track.body[hand], 1.0))));
        measures.hand_hits += 0.5 * spread(acceleration, 0.5, 0.99);
    }
    measure_bars(track, beats, measures);
    return measures;
}

std::vector<double> gaussian_average(std::span<const double> values, double deviation) {
    return averaged<double>(values, deviation);
}

double loudness_correlation(std::span<const double> speeds, std::span<const double> loudness_db) {
    constexpr std::size_t kLeftOut = 360;  // frames: the dancer begins
    constexpr std::size_t kLongestLag = 60;
    constexpr std::size_t kLagStep = 6;
    const std::size_t frames = std::min(speeds.size(), loudness_db.size());
    if (frames < kLeftOut + 4 * kLongestLag) {
        return 0.0;
    }
    const std::vector<double> speed = gaussian_average(speeds.first(frames), kSecond);
    const std::vector<double> loud = gaussian_average(loudness_db.first(frames), kSecond);
    double best = -1.0;
    for (std::size_t lag = 0; lag <= kLongestLag; lag += kLagStep) {
        const std::size_t count = frames - kLeftOut - lag;
        best = std::max(best,
                        correlation(std::span(loud).subspan(kLeftOut, count),
                                    std::span(speed).subspan(kLeftOut + lag, count)));
    }
    return best;
}

}  // namespace raks::motion
