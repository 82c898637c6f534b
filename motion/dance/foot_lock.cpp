#include "motion/dance/foot_lock.hpp"

#include <algorithm>
#include <cmath>

#include "motion/dance/closed_curve.hpp"
#include "motion/dance/easing.hpp"
#include "motion/dance/leg_ik.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// How smoothly heel and ball take turns in carrying the foot, and the hips sink; beats.
constexpr double kHeightSigma = 0.04;
constexpr double kSinkSigma = 0.14;
constexpr float kDeepest = 0.002F;       // metres that a sole dips where that is smooth
constexpr double kReleaseBeats = 0.3;    // beats until a foot that was let go is wholly free
constexpr float kFloorSoftness = 0.02F;  // metres over the floor where a free foot feels it
constexpr float kToeSoftness = 0.15F;    // radians of the heel's rise where the toes begin to bend
constexpr float kReleaseGlide = 0.3F;    // beats over which the lock's shift fades after a contact
constexpr float kArrivalGlide = 0.25F;   // and comes up before one: as brisk as people land
constexpr float kMostToeBend = 0.9F;     // radians
constexpr double kEdgeBeats = 0.042;     // differences at a contact's ends

/// The larger of both, rounded where they are nearer than `softness`; twice differentiable.
float soft_max(float a, float b, float softness) {
    const float apart = std::clamp(std::abs(a - b) / std::max(softness, 1e-9F), 0.0F, 1.0F);
    const float near = 1.0F - apart;
    return std::max(a, b) + softness * near * near * near / 6.0F;
}

/// Value, speed and acceleration of a curve at one sample; per sample.
struct Jet {
    glm::vec3 value{};
    glm::vec3 speed{};
    glm::vec3 acceleration{};
};

/// The quintic that leaves as `from` says and arrives `length` samples later as `to` says.
class Quintic {
 public:
    Quintic(const Jet& from, const Jet& to, float length) : length_(length) {
        const glm::vec3 speed = from.speed * length;
        const glm::vec3 bend = 0.5F * from.acceleration * length * length;
        const glm::vec3 way = to.value - from.value - speed - bend;
        const glm::vec3 gain = to.speed * length - speed - 2.0F * bend;
        const glm::vec3 turn = to.acceleration * length * length - 2.0F * bend;
        terms_ = {from.value,
                  speed,
                  bend,
                  10.0F * way - 4.0F * gain + 0.5F * turn,
                  -15.0F * way + 7.0F * gain - turn,
                  6.0F * way - 3.0F * gain + 0.5F * turn};
    }
    [[nodiscard]] glm::vec3 at(float sample) const {
        const float t = sample / length_;
        glm::vec3 value = terms_[5];
        for (std::size_t i = 5; i-- > 0;) {
            value = value * t + terms_[i];
        }
        return value;
    }

 private:
    float length_ = 1.0F;
    std::array<glm::vec3, 6> terms_{};
};

/// What the lock moves an ankle by during one flight: it leaves the contact before with its value,
/// speed and acceleration, fades out, and comes up to those of the contact after.
class Glide {
 public:
    Glide(const Jet& from, const Jet& to, float length, float samples_per_beat)
        : length_(length),
          release_(std::min(length, kReleaseGlide * samples_per_beat)),
          arrival_(std::min(length, kArrivalGlide * samples_per_beat)),
          leave_(from, {}, release_),
          arrive_({}, to, arrival_) {}
    [[nodiscard]] glm::vec3 at(float sample) const {
        const float before_end = length_ - sample;
        glm::vec3 value{};
        value += sample < release_ ? leave_.at(sample) : glm::vec3(0.0F);
        value += before_end < arrival_ ? arrive_.at(arrival_ - before_end) : glm::vec3(0.0F);
        return value;
    }

 private:
    float length_;
    float release_;
    float arrival_;
    Quintic leave_;
    Quintic arrive_;
};

/// One foot over the whole figure.
struct FootTrack {
    std::vector<glm::vec3> ankle;
    std::vector<glm::vec3> from_ball;  // of the ankle, in the world
    std::vector<glm::quat> rotation;
    std::vector<glm::quat> toes;  // local
    std::vector<float> lock;      // 1 in contact, 0 free, between while it is taken up or let go
    std::vector<float> standing;  // the ankle's height when the sole is on the floor

    [[nodiscard]] std::size_t size() const { return ankle.size(); }
    [[nodiscard]] std::size_t at(std::ptrdiff_t i) const { return wrap(i, size()); }
};

/// How firmly each sample is held: 1 in the windows, down to 0 within `ramp` samples beside them.
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

/// Toes that stay flat while the heel is up over a planted ball.
glm::quat toe_bend(const Skeleton& skeleton, const glm::quat& foot, float lock) {
    const glm::vec3 toe = foot * (skeleton.toe_tip - skeleton.ball);
    const float down = std::asin(std::clamp(-toe.y / glm::length(toe), -1.0F, 1.0F));
    const float bend = std::min(soft_max(0.0F, down, kToeSoftness), kMostToeBend);
    return glm::angleAxis(-lock * bend, glm::vec3(1, 0, 0));
}

FootTrack foot_track(const Skeleton& skeleton,
                     Side side,
                     const std::vector<PlannedContact>& contacts,
                     double samples_per_beat,
                     const std::vector<Pose>& poses) {
    FootTrack track;
    const auto ramp = static_cast<std::ptrdiff_t>(std::lround(kReleaseBeats * samples_per_beat));
    track.lock = locks(contacts, ramp, poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const WorldPose world = world_pose(skeleton, poses[i]);
        const Bone foot = on_side(Bone::left_foot, side);
        track.ankle.push_back(world.position(foot));
        track.rotation.push_back(world.rotation(foot));
        track.from_ball.push_back(world.position(foot) - foot_point(world, side, skeleton.ball));
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

/// How far the ankle of a foot planted at `place` lies from the free one.
glm::vec3 shift_to(const FootTrack& track, const glm::vec3& place, std::ptrdiff_t sample) {
    const std::size_t i = track.at(sample);
    glm::vec3 planted = place + track.from_ball[i];
    planted.y = track.standing[i];
    return planted - track.ankle[i];
}

Jet jet_of(const FootTrack& track,
           const glm::vec3& place,
           std::ptrdiff_t sample,
           std::ptrdiff_t reach) {
    const auto step = static_cast<float>(reach);
    const glm::vec3 before = shift_to(track, place, sample - reach);
    const glm::vec3 here = shift_to(track, place, sample);
    const glm::vec3 after = shift_to(track, place, sample + reach);
    return {here, (after - before) / (2.0F * step), (after - 2.0F * here + before) / (step * step)};
}

/// Where the ball of the free foot is on average while it rests.
glm::vec3 resting_place(const FootTrack& track, const ContactWindow& window) {
    glm::vec3 place{};
    for (std::size_t k = 0; k < window.length; ++k) {
        const std::size_t i = (window.first + k) % track.size();
        place += (track.ankle[i] - track.from_ball[i]) / static_cast<float>(window.length);
    }
    return place;
}

/// How far from there it shall rest.
glm::vec3 aside_of(const PlannedContact& contact, const glm::vec3& resting) {
    const glm::vec2 own(resting.x, resting.z);
    const glm::vec2 aside = contact.place.value_or(own) + contact.aside - own;
    return {aside.x, 0.0F, aside.y};
}

/// Moves the ankles so that the ball rests in each window, and glides there between them.
void plant(const std::vector<PlannedContact>& contacts, double samples_per_beat, FootTrack& track) {
    std::vector<glm::vec3> shift(track.size());
    const auto reach = std::max<std::ptrdiff_t>(1, std::lround(kEdgeBeats * samples_per_beat));
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const PlannedContact& contact = contacts[c];
        const PlannedContact& next = contacts[(c + 1) % contacts.size()];
        const glm::vec3 place = resting_place(track, contact.window);
        const glm::vec3 next_place = resting_place(track, next.window);
        const glm::vec3 aside = aside_of(contact, place);
        const auto first = static_cast<std::ptrdiff_t>(contact.window.first);
        const std::ptrdiff_t last = first + static_cast<std::ptrdiff_t>(contact.window.length) - 1;
        for (std::ptrdiff_t i = first; i <= last; ++i) {
            shift[track.at(i)] = shift_to(track, place, i) + aside;
        }
        const auto rise = static_cast<std::ptrdiff_t>(
            track.at(static_cast<std::ptrdiff_t>(next.window.first) - last - 1) + 1);
        const auto length = static_cast<float>(rise);
        const Glide glide(jet_of(track, place, last, reach),
                          jet_of(track, next_place, last + rise, reach),
                          length,
                          static_cast<float>(samples_per_beat));
        const glm::vec3 next_aside = aside_of(next, next_place);
        for (std::ptrdiff_t k = 1; k < rise; ++k) {
            const auto sample = static_cast<float>(k);
            shift[track.at(last + k)] =
                glide.at(sample) + glm::mix(aside, next_aside, smootherstep(sample / length));
        }
    }
    for (std::size_t i = 0; i < track.size(); ++i) {
        track.ankle[i] += shift[i];
        const float softness = kFloorSoftness * (1.0F - track.lock[i]);
        track.ankle[i].y = soft_max(track.ankle[i].y, track.standing[i], softness);
    }
}

/// Mean height of the soles in contact: what the hips must sink (positive) or rise.
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

void lock_feet(const Skeleton& skeleton,
               const std::array<std::vector<PlannedContact>, 2>& contacts,
               double samples_per_beat,
               const std::vector<Pose>& stepping,
               std::vector<Pose>& poses) {
    std::array<FootTrack, 2> feet;
    for (const Side side : kSides) {
        const std::size_t s = static_cast<std::size_t>(side);
        feet[s] = foot_track(skeleton, side, contacts[s], samples_per_beat, stepping);
    }
    const float height = height_over_floor(feet);
    for (Pose& pose : poses) {
        pose.hips_position.y -= height;
    }
    for (const Side side : kSides) {
        FootTrack& track = feet[static_cast<std::size_t>(side)];
        for (glm::vec3& ankle : track.ankle) {
            ankle.y -= height;
        }
        plant(contacts[static_cast<std::size_t>(side)], samples_per_beat, track);
    }
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
