#include "motion/dance/baking/foot_lock.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/smooth_steps.hpp"
#include "motion/dance/baking/flight.hpp"
#include "motion/dance/body/curves.hpp"
#include "motion/dance/body/limb_ik.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// Deviations in beats of two Gaussians: that of the standing height of the ankle (the foot's weight
// goes from heel to ball) and that of the sinking of the hips.
constexpr double kHeightSigma = 0.04;
constexpr double kSinkSigma = 0.14;
constexpr float kDeepest = 0.002F;     // metres that smoothing may let a sole dip into the floor
constexpr double kReleaseBeats = 0.3;  // beats over which the lock fades beside a contact
constexpr float kEasyReach = 0.98F;    // longest distance from hip to ankle, of the leg's length
// Metres; width of the soft limit that keeps a free foot above the floor
constexpr float kFloorSoftness = 0.02F;
constexpr float kToeSoftness = 0.15F;     // radians of pitch over which the toes begin to bend
constexpr float kMostToeBend = 0.9F;      // radians, upper limit of the bend
constexpr double kFlightBandwidth = 4.0;  // low-pass of a foot in the air, cycles a beat

/// One foot over the whole figure, one entry a sample.
struct FootTrack {
    std::vector<glm::vec3> ankle;      // world
    std::vector<glm::vec3> from_ball;  // from the pivot to the ankle, world
    std::vector<glm::quat> rotation;   // of the foot bone, world
    std::vector<glm::quat> toes;       // local
    std::vector<float> lock;           // 1 in contact, 0 free, between the two while it fades
    std::vector<float> standing;       // height of the ankle at which the sole is on the floor

    [[nodiscard]] std::size_t size() const { return ankle.size(); }
    [[nodiscard]] std::size_t at(std::ptrdiff_t i) const { return wrap(i, size()); }
};

/// Lock by sample: 1 in the windows, easing to 0 over `ramp` samples beside them. Where two ramps
/// overlap the firmer lock counts.
std::vector<float> locks(const std::vector<PlannedContact>& contacts,
                         std::ptrdiff_t ramp,
                         std::size_t size) {
    std::vector<float> lock(size);
    for (const PlannedContact& contact : contacts) {
        const ContactWindow& window = contact.window;
        const auto length = static_cast<std::ptrdiff_t>(window.length);
        for (std::ptrdiff_t k = -ramp; k < length + ramp; ++k) {
            const std::ptrdiff_t outside = k < 0 ? -k : std::max<std::ptrdiff_t>(0, k - length + 1);
            float& here = lock[wrap(static_cast<std::ptrdiff_t>(window.first) + k, size)];
            here = std::max(
                here,
                smootherstep(1.0F - static_cast<float>(outside) / static_cast<float>(ramp + 1)));
        }
    }
    return lock;
}

/// Local rotation of the toes that keeps them flat while the heel is up over a planted ball. It
/// undoes the downward pitch of the toes, scaled by the lock.
glm::quat toe_bend(const Skeleton& skeleton, const glm::quat& foot, float lock) {
    const glm::vec3 toe = foot * (skeleton.toe_tip - skeleton.ball);
    const float down = std::asin(std::clamp(-toe.y / glm::length(toe), -1.0F, 1.0F));
    const float bend = std::min(soft_max(0.0F, down, kToeSoftness), kMostToeBend);
    return glm::angleAxis(-lock * bend, glm::vec3(1, 0, 0));
}

// Fills one foot's track from its targets. The standing height is smoothed, since the lowest point
// of the sole jumps from heel to ball; it stays within kDeepest of the exact height.
FootTrack foot_track(const Skeleton& skeleton,
                     Side side,
                     const std::vector<PlannedContact>& contacts,
                     double samples_per_beat,
                     const std::vector<FootTarget>& stepping) {
    FootTrack track;
    const auto ramp = static_cast<std::ptrdiff_t>(std::lround(kReleaseBeats * samples_per_beat));
    track.lock = locks(contacts, ramp, stepping.size());
    for (const FootTarget& place : stepping) {
        const std::size_t i = track.ankle.size();
        track.ankle.push_back(place.ankle);
        track.rotation.push_back(place.rotation);
        track.from_ball.push_back(-pivot_from_ankle(skeleton, side, place.rotation));
        track.toes.push_back(toe_bend(skeleton, track.rotation[i], track.lock[i]));
        track.standing.push_back(-lowest_of_sole(skeleton, side, track.rotation[i], track.toes[i]));
    }
    const std::vector<float> exact = track.standing;
    track.standing = smoothed(track.standing, kHeightSigma * samples_per_beat);
    for (std::size_t i = 0; i < track.size(); ++i) {
        track.standing[i] = soft_max(track.standing[i], exact[i] - kDeepest, kDeepest);
    }
    return track;
}

/// Vector from the free ankle to that of a foot planted at `place`, at one sample.
glm::vec3 shift_to(const FootTrack& track, const glm::vec3& place, std::ptrdiff_t sample) {
    const std::size_t i = track.at(sample);
    glm::vec3 planted = place + track.from_ball[i];
    planted.y = track.standing[i];
    return planted - track.ankle[i];
}

/// Mean place of the pivot of the free foot over one window.
glm::vec3 resting_place(const FootTrack& track, const ContactWindow& window) {
    glm::vec3 place{};
    for (std::size_t k = 0; k < window.length; ++k) {
        const std::size_t i = (window.first + k) % track.size();
        place += (track.ankle[i] - track.from_ball[i]) / static_cast<float>(window.length);
    }
    return place;
}

/// Vector on the floor from the mean place `resting` to where the contact is planned.
glm::vec3 aside_of(const PlannedContact& contact, const glm::vec3& resting) {
    const glm::vec2 own(resting.x, resting.z);
    const glm::vec2 aside = contact.place.value_or(own) + contact.aside - own;
    return {aside.x, 0.0F, aside.y};
}

/// Moves the ankles so that the pivot rests in each window. Between two windows the shift of the
/// first is eased into that of the next, then the flight is smoothed.
void plant(const std::vector<PlannedContact>& contacts, double samples_per_beat, FootTrack& track) {
    std::vector<bool> rests(track.size());
    std::vector<glm::vec3> wanted = track.ankle;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const PlannedContact& contact = contacts[c];
        const PlannedContact& next = contacts[(c + 1) % contacts.size()];
        const glm::vec3 place = resting_place(track, contact.window);
        const glm::vec3 next_place = resting_place(track, next.window);
        const glm::vec3 aside = aside_of(contact, place);
        const auto first = static_cast<std::ptrdiff_t>(contact.window.first);
        const std::ptrdiff_t last = first + static_cast<std::ptrdiff_t>(contact.window.length) - 1;
        // In contact: the pivot is pinned to its place, the ankle turns about it.
        for (std::ptrdiff_t i = first; i <= last; ++i) {
            wanted[track.at(i)] += shift_to(track, place, i) + aside;
            rests[track.at(i)] = true;
        }
        // Samples from the last one of this contact to the first one of the next, round the closed
        // curve.
        const auto rise = static_cast<std::ptrdiff_t>(
            track.at(static_cast<std::ptrdiff_t>(next.window.first) - last - 1) + 1);
        const glm::vec3 from = shift_to(track, place, last) + aside;
        const glm::vec3 to = shift_to(track, next_place, last + rise) + aside_of(next, next_place);
        for (std::ptrdiff_t k = 1; k < rise; ++k) {
            const float share = static_cast<float>(k) / static_cast<float>(rise);
            wanted[track.at(last + k)] += glm::mix(from, to, smootherstep(share));
        }
    }
    fly(rests, kFlightBandwidth / samples_per_beat, wanted);
    track.ankle = std::move(wanted);
    // A planted sole (lock 1) is limited sharply, a free one softly, so that it does not kink
    // there.
    for (std::size_t i = 0; i < track.size(); ++i) {
        const float softness = kFloorSoftness * (1.0F - track.lock[i]);
        track.ankle[i].y = soft_max(track.ankle[i].y, track.standing[i], softness);
    }
}

/// Plants the feet a second time, after each step's speed got a single peak (rising_once). The feet
/// are at their planned places already, so the contacts' places and asides are dropped.
FootTrack planted_again(const Skeleton& skeleton,
                        Side side,
                        std::vector<PlannedContact> contacts,
                        double samples_per_beat,
                        const FootTrack& planted) {
    std::vector<FootTarget> places;
    for (std::size_t i = 0; i < planted.size(); ++i) {
        places.push_back({planted.ankle[i], planted.rotation[i]});
    }
    FootTrack track =
        foot_track(skeleton, side, contacts, samples_per_beat, rising_once(contacts, places));
    for (PlannedContact& contact : contacts) {
        contact.place.reset();
        contact.aside = {};
    }
    plant(contacts, samples_per_beat, track);
    return track;
}

/// Mean height of the soles in contact over their standing height, both feet: what the hips must
/// sink (positive) or rise; metres.
float height_over_floor(const std::array<FootTrack, 2>& feet) {
    float sum = 0.0F;
    float count = 0.0F;
    for (const FootTrack& track : feet) {
        for (std::size_t i = 0; i < track.size(); ++i) {
            if (track.lock[i] >= 1.0F) {
                sum += track.ankle[i].y - track.standing[i];
                count += 1.0F;
            }
        }
    }
    return count > 0.0F ? sum / count : 0.0F;
}

/// How far the hips must sink at each sample so that both legs reach their ankles; metres, smoothed
/// so that the hips glide.
std::vector<float> sinking(const Skeleton& skeleton,
                           const std::array<FootTrack, 2>& feet,
                           const std::vector<Pose>& poses,
                           double sigma) {
    const float reach = kEasyReach * leg_length(skeleton);
    std::vector<float> sink(poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        for (const Side side : kSides) {
            const Bone thigh = on_side(Bone::left_upper_leg, side);
            const glm::vec3 hip = poses[i].hips_position +
                                  poses[i].rotation(Bone::hips) * skeleton.offsets[index_of(thigh)];
            // Pythagoras: the ankle lies `aside` (squared) off the vertical through the hip, so a
            // leg of length `reach` gets `down` metres deep there.
            const glm::vec3 line = feet[static_cast<std::size_t>(side)].ankle[i] - hip;
            const float aside = line.x * line.x + line.z * line.z;
            const float down = std::sqrt(std::max(0.0F, reach * reach - aside));
            sink[i] = std::max(sink[i], -line.y - down);
        }
    }
    // First the maximum over two deviations to each side, then the Gaussian: by this order the
    // smoothed curve hardly falls below what a sample needs.
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

void lock_feet(const Skeleton& skeleton,
               const std::array<std::vector<PlannedContact>, 2>& contacts,
               double samples_per_beat,
               const std::array<std::vector<FootTarget>, 2>& stepping,
               std::vector<Pose>& poses) {
    const auto is_mean = [](const PlannedContact& contact) { return contact.is_mean; };
    std::array<FootTrack, 2> feet;
    // Timing first: it changes which targets fall into the contact windows, where heights are
    // measured.
    for (const Side side : kSides) {
        const std::size_t s = static_cast<std::size_t>(side);
        feet[s] = foot_track(
            skeleton, side, contacts[s], samples_per_beat, in_time(contacts[s], stepping[s]));
    }
    // One constant for the whole figure, so that the hips keep their own rise and fall.
    const float height = height_over_floor(feet);
    for (Pose& pose : poses) {
        pose.hips_position.y -= height;
    }
    for (const Side side : kSides) {
        const std::size_t s = static_cast<std::size_t>(side);
        for (glm::vec3& ankle : feet[s].ankle) {
            ankle.y -= height;
        }
        plant(contacts[s], samples_per_beat, feet[s]);
        if (std::any_of(contacts[s].begin(), contacts[s].end(), is_mean)) {
            feet[s] = planted_again(skeleton, side, contacts[s], samples_per_beat, feet[s]);
        }
    }
    // Hips last, when the planted ankles are known; the legs are then solved from the sunken hips.
    const std::vector<float> sink = sinking(skeleton, feet, poses, kSinkSigma * samples_per_beat);
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
