#include "engine/show/dancer_face.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "base/smooth_steps.hpp"

#include <glm/geometric.hpp>

namespace raks::engine {
namespace {

// One blink in the first half of every 4 s, so that two are 2 to 6 s apart.
constexpr std::int64_t kBlinkCell = 4'000'000'000;  // ns
constexpr double kBlinkSpread = 2.0;                // s

constexpr std::uint64_t kBlinkTimes = 1;  // streams of random numbers
constexpr std::uint64_t kBlinkLengths = 2;

// Lids fall faster than they rise.
constexpr double kLidFall = 0.06;  // s
constexpr double kLidRise = 0.14;  // s

// The mouth opens with what is louder than the music has been of late, and never as far as in song.
constexpr float kMouthClosed = -4.0F;  // dB against the loudness
constexpr float kMouthOpen = 8.0F;     // dB
constexpr float kWidestMouth = 0.5F;
constexpr float kQuietest = -60.0F;  // LUFS; below it there is no music
constexpr double kMouthTime = 0.06;  // s; the mouth's own slowness

// Cosine of the angle between the face and what it looks at: from here on the eyes do not reach it.
constexpr float kGazeLost = 0.26F;  // 75 degrees
constexpr float kGazeFull = 0.64F;  // 50 degrees

// 0 before and long after the blink that begins at 0.
double lids(double seconds, double closed) noexcept {
    const double fallen = seconds / kLidFall;
    const double risen = (seconds - kLidFall - closed) / kLidRise;
    return std::clamp(std::min(fallen, 1.0 - risen), 0.0, 1.0);
}

// -1 (behind) to 1 (straight ahead).
float facing(const motion::WorldPose& world, const glm::vec3& target) noexcept {
    const glm::vec3 towards = target - world.position(motion::Bone::head);
    const float distance = glm::length(towards);
    if (!(distance > 0.0F)) {
        return -1.0F;
    }
    const glm::vec3 ahead = world.rotation(motion::Bone::head) * glm::vec3(0.0F, 0.0F, 1.0F);
    return glm::dot(ahead, towards) / distance;
}

}  // namespace

float blink_at(StreamTime time, std::uint64_t seed) noexcept {
    const std::int64_t ns = std::max<std::int64_t>(time.time_since_epoch().count(), 0);
    const auto cell = static_cast<std::uint64_t>(ns / kBlinkCell);
    const double start = kBlinkSpread * CounterRandom(seed, kBlinkTimes).uniform(cell);
    // Halves of the fall and the rise are more than half shut, too: 0.1 s of the 0.1 to 0.2.
    const double closed = 0.1 * CounterRandom(seed, kBlinkLengths).uniform(cell);
    const double into = static_cast<double>(ns % kBlinkCell) * 1e-9 - start;
    return smoothstep(0.0F, 1.0F, static_cast<float>(lids(into, closed)));
}

glm::vec3 head_place(const motion::Skeleton& skeleton, const motion::Pose& pose) noexcept {
    return motion::world_pose(skeleton, pose).position(motion::Bone::head);
}

float DancerFace::mouth_at(const FaceMoment& moment) noexcept {
    float asked = 0.0F;
    if (moment.loudness_lufs > kQuietest) {
        asked = kWidestMouth *
                smoothstep(kMouthClosed, kMouthOpen, moment.level_dbfs - moment.loudness_lufs);
    }
    // What is left of the difference goes by the time alone, not by the number of pictures.
    const double since = last_ ? std::max(to_seconds(moment.time - *last_), 0.0) : 1.0;
    const auto left = static_cast<float>(std::exp(-since / kMouthTime));
    mouth_ = asked + (mouth_ - asked) * left;
    last_ = moment.time;
    return mouth_;
}

render::Face DancerFace::face_at(const FaceMoment& moment,
                                 const motion::Skeleton& skeleton,
                                 const motion::Pose& pose) noexcept {
    render::Face face;
    if (habits_.blinks) {
        face.weight(render::FaceExpression::blink) = blink_at(moment.time, seed_);
    }
    const float mouth = mouth_at(moment);
    if (habits_.moves_mouth) {
        face.weight(render::FaceExpression::aa) = mouth;
    }
    if (habits_.gazes) {
        const motion::WorldPose world = motion::world_pose(skeleton, pose);
        face.gaze_target = moment.gaze_target;
        face.gaze = smoothstep(kGazeLost, kGazeFull, facing(world, moment.gaze_target));
    }
    return face;
}

}  // namespace raks::engine
