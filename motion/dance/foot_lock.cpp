#include "motion/dance/foot_lock.hpp"

#include <algorithm>
#include <cmath>

#include "motion/dance/leg_ik.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kSmoothBeats = 0.15;
constexpr double kLeastGapBeats = 0.25;
constexpr double kLeastContactBeats = 0.34;
constexpr double kContactChance = 0.45;
constexpr double kLandingReach = 0.5;  // beats between a contact's start and its landing
constexpr int kLandingRepeats = 3;
// Beats from the landing (the foot falls under 0.30 m/s) until it stands still.
// (Before it: the foot glides the last centimetres while the lock takes it up.)
constexpr double kRestAfterLanding = -0.03;

constexpr float kToeOnset = 0.55F;    // radians of the heel's rise over which toes begin to bend
constexpr float kMostToeBend = 0.9F;  // radians

/// Shortest contact that is worth locking, in samples.
std::ptrdiff_t shift_floor(double samples_per_beat) {
    return static_cast<std::ptrdiff_t>(0.2 * samples_per_beat);
}

std::size_t wrap(std::ptrdiff_t i, std::size_t size) {
    const auto n = static_cast<std::ptrdiff_t>(size);
    return static_cast<std::size_t>(((i % n) + n) % n);
}

float smoothstep(float t) {
    t = std::clamp(t, 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

/// Gaussian over a closed curve.
template <typename T>
std::vector<T> smoothed(const std::vector<T>& values, double sigma) {
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3.0 * sigma));
    std::vector<T> result(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        double sum = 0.0;
        double total = 0.0;
        for (std::ptrdiff_t step = -reach; step <= reach; ++step) {
            const double d = static_cast<double>(step) / sigma;
            const double weight = std::exp(-0.5 * d * d);
            sum += weight * static_cast<double>(
                                values[wrap(static_cast<std::ptrdiff_t>(i) + step, values.size())]);
            total += weight;
        }
        result[i] = static_cast<T>(sum / total);
    }
    return result;
}

/// Runs of `value` in a closed row; empty when the whole row is one.
std::vector<ContactWindow> runs_of(const std::vector<bool>& row, bool value) {
    std::vector<ContactWindow> runs;
    const std::size_t size = row.size();
    for (std::size_t i = 0; i < size; ++i) {
        if (row[i] != value || row[wrap(static_cast<std::ptrdiff_t>(i) - 1, size)] == value) {
            continue;
        }
        std::size_t length = 0;
        while (length < size && row[(i + length) % size] == value) {
            ++length;
        }
        runs.push_back({i, length});
    }
    return runs;
}

void fill(std::vector<bool>& row, const ContactWindow& window, bool value) {
    for (std::size_t k = 0; k < window.length; ++k) {
        row[(window.first + k) % row.size()] = value;
    }
}

/// One foot over the whole figure.
struct FootTrack {
    std::vector<glm::vec3> ankle;
    std::vector<glm::vec3> ball;
    std::vector<glm::quat> rotation;
    std::vector<glm::quat> toes;  // in the foot's frame
    std::vector<float> lock;      // 1 in contact, 0 free, between while it is taken up or let go
};

FootTrack foot_track(const Skeleton& skeleton, Side side, const std::vector<Pose>& poses) {
    FootTrack track;
    for (const Pose& pose : poses) {
        const WorldPose world = world_pose(skeleton, pose);
        const Bone foot = on_side(Bone::left_foot, side);
        track.ankle.push_back(world.position(foot));
        track.rotation.push_back(world.rotation(foot));
        track.ball.push_back(foot_point(world, side, skeleton.ball));
    }
    track.lock.resize(poses.size());
    return track;
}

/// Moves ankles so that the ball stays on its anchor inside each window.
void anchor(const std::vector<ContactWindow>& windows, std::size_t blend, FootTrack& track) {
    const std::size_t size = track.ankle.size();
    const std::vector<glm::vec3> ankle = track.ankle;
    for (const ContactWindow& window : windows) {
        glm::vec3 place{};
        for (std::size_t k = 0; k < window.length; ++k) {
            place += track.ball[(window.first + k) % size] / static_cast<float>(window.length);
        }
        const auto length = static_cast<std::ptrdiff_t>(window.length);
        const auto ramp = static_cast<std::ptrdiff_t>(blend);
        for (std::ptrdiff_t k = -ramp; k < length + ramp; ++k) {
            const std::size_t i = wrap(static_cast<std::ptrdiff_t>(window.first) + k, size);
            const std::ptrdiff_t outside = k < 0 ? -k : std::max<std::ptrdiff_t>(0, k - length + 1);
            const float weight =
                smoothstep(1.0F - static_cast<float>(outside) / static_cast<float>(ramp + 1));
            if (weight < track.lock[i]) {
                continue;  // the neighbouring contact holds this sample harder
            }
            track.lock[i] = weight;
            glm::vec3 shift = place - track.ball[i];
            shift.y = 0.0F;
            track.ankle[i] = ankle[i] + weight * shift;
        }
    }
}

/// Toes that stay flat while the heel is up over a planted ball.
glm::quat toe_bend(const Skeleton& skeleton, const glm::quat& foot, float lock) {
    const glm::vec3 toe = foot * (skeleton.toe_tip - skeleton.ball);
    const float down = std::asin(std::clamp(-toe.y / glm::length(toe), -1.0F, 1.0F));
    // Zero for a flat foot and below, with a soft onset.
    const float onset = smoothstep(down / kToeOnset);
    const float bend = std::min(onset * std::max(0.0F, down), kMostToeBend);
    return glm::angleAxis(-lock * bend, glm::vec3(1, 0, 0));
}

/// Heights: on the floor in contact, never below it.
void put_on_floor(const Skeleton& skeleton, Side side, FootTrack& track) {
    for (std::size_t i = 0; i < track.ankle.size(); ++i) {
        track.toes.push_back(toe_bend(skeleton, track.rotation[i], track.lock[i]));
        const float standing = -lowest_of_sole(skeleton, side, track.rotation[i], track.toes[i]);
        const float free = std::max(track.ankle[i].y, standing);
        track.ankle[i].y = free + track.lock[i] * (standing - free);
    }
}

/// Mean height of the soles in contact: what the hips must sink (positive) or rise.
float height_over_floor(const Skeleton& skeleton,
                        const std::array<FootTrack, 2>& feet,
                        const std::array<std::vector<ContactWindow>, 2>& contacts) {
    float sum = 0.0F;
    float count = 0.0F;
    for (const Side side : kSides) {
        const FootTrack& track = feet[static_cast<std::size_t>(side)];
        for (const ContactWindow& window : contacts[static_cast<std::size_t>(side)]) {
            for (std::size_t k = 0; k < window.length; ++k) {
                const std::size_t i = (window.first + k) % track.ankle.size();
                sum += track.ankle[i].y +
                       lowest_of_sole(skeleton, side, track.rotation[i], kNoRotation);
                count += 1.0F;
            }
        }
    }
    return count > 0.0F ? sum / count : 0.0F;
}

/// How far the hips must sink at each sample so that both legs reach, smoothed so that they glide.
std::vector<float> sinking(const Skeleton& skeleton,
                           const std::array<FootTrack, 2>& feet,
                           const std::vector<Pose>& poses,
                           double sigma) {
    const float reach = kLongestReach * leg_length(skeleton);
    std::vector<float> sink(poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        for (const Side side : kSides) {
            const Bone thigh = on_side(Bone::left_upper_leg, side);
            const glm::vec3 hip = poses[i].hips_position +
                                  poses[i].rotation(Bone::hips) * skeleton.offsets[index_of(thigh)];
            const glm::vec3 line = feet[static_cast<std::size_t>(side)].ankle[i] - hip;
            const float aside = line.x * line.x + line.z * line.z;
            const float down = std::sqrt(std::max(0.0F, reach * reach - aside));
            sink[i] = std::max(sink[i], -line.y - down);
        }
    }
    // The largest in the neighbourhood, then smoothed: never less than needed at a sample.
    const auto around = static_cast<std::ptrdiff_t>(std::ceil(2.0 * sigma));
    std::vector<float> widened(sink.size());
    for (std::size_t i = 0; i < sink.size(); ++i) {
        for (std::ptrdiff_t step = -around; step <= around; ++step) {
            widened[i] = std::max(widened[i],
                                  sink[wrap(static_cast<std::ptrdiff_t>(i) + step, sink.size())]);
        }
    }
    return smoothed(widened, sigma);
}

}  // namespace

std::vector<ContactWindow> contact_windows(const std::array<double, kContactBins>& chance,
                                           int beats,
                                           std::size_t samples) {
    const double bins_per_beat = static_cast<double>(kContactBins) / beats;
    const std::vector<double> smooth =
        smoothed(std::vector<double>(chance.begin(), chance.end()), kSmoothBeats * bins_per_beat);
    std::vector<bool> row(samples);
    for (std::size_t i = 0; i < samples; ++i) {
        row[i] = smooth[i * kContactBins / samples] > kContactChance;
    }
    const double samples_per_beat = static_cast<double>(samples) / beats;
    for (const ContactWindow& gap : runs_of(row, false)) {
        if (static_cast<double>(gap.length) < kLeastGapBeats * samples_per_beat) {
            fill(row, gap, true);
        }
    }
    for (const ContactWindow& contact : runs_of(row, true)) {
        if (static_cast<double>(contact.length) < kLeastContactBeats * samples_per_beat) {
            fill(row, contact, false);
        }
    }
    return runs_of(row, true);
}

std::vector<ContactWindow> start_at_landings(std::vector<ContactWindow> windows,
                                             const std::vector<LandingOffset>& landings,
                                             double samples_per_beat,
                                             std::size_t samples) {
    for (ContactWindow& window : windows) {
        double best = kLandingReach;
        for (std::size_t count = 0; count < landings.size(); ++count) {
            if (landings[count].repeats < kLandingRepeats) {
                continue;
            }
            const double landing =
                static_cast<double>(count) + landings[count].median.count() + kRestAfterLanding;
            const double beats = static_cast<double>(samples) / samples_per_beat;
            double away = landing - static_cast<double>(window.first) / samples_per_beat;
            away -= beats * std::round(away / beats);
            best = std::abs(away) < std::abs(best) ? away : best;
        }
        const auto shift = static_cast<std::ptrdiff_t>(std::lround(best * samples_per_beat));
        const auto length = static_cast<std::ptrdiff_t>(window.length) - shift;
        if (std::abs(best) < kLandingReach && length > shift_floor(samples_per_beat)) {
            window.first = wrap(static_cast<std::ptrdiff_t>(window.first) + shift, samples);
            window.length = static_cast<std::size_t>(length);
        }
    }
    return windows;
}

void lock_feet(const Skeleton& skeleton,
               const std::array<std::vector<ContactWindow>, 2>& contacts,
               std::size_t blend,
               std::vector<Pose>& poses) {
    std::array<FootTrack, 2> feet;
    for (const Side side : kSides) {
        feet[static_cast<std::size_t>(side)] = foot_track(skeleton, side, poses);
    }
    const float height = height_over_floor(skeleton, feet, contacts);
    for (Pose& pose : poses) {
        pose.hips_position.y -= height;
    }
    for (const Side side : kSides) {
        FootTrack& track = feet[static_cast<std::size_t>(side)];
        for (std::size_t i = 0; i < poses.size(); ++i) {
            track.ankle[i].y -= height;
        }
        anchor(contacts[static_cast<std::size_t>(side)], blend, track);
        put_on_floor(skeleton, side, track);
    }
    const std::vector<float> sink = sinking(skeleton, feet, poses, static_cast<double>(blend));
    for (std::size_t i = 0; i < poses.size(); ++i) {
        poses[i].hips_position.y -= sink[i];
        for (const Side side : kSides) {
            const std::size_t s = static_cast<std::size_t>(side);
            solve_leg(skeleton, side, {feet[s].ankle[i], feet[s].rotation[i]}, poses[i]);
            poses[i].rotation(on_side(Bone::left_toes, side)) = feet[s].toes[i];
            poses[i].foot_contact[s] = feet[s].lock[i] >= 1.0F;
        }
    }
}

}  // namespace raks::motion
