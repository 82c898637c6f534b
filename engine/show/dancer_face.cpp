#include "engine/show/dancer_face.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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

// Sizes of feelings by the setting face_mood.
constexpr std::array<std::pair<std::string_view, float>, 4> kMoodSizes = {
    {{"off", 0.0F}, {"calm", 0.6F}, {"normal", 1.0F}, {"stage", 1.4F}}};
// The mouth of who smiles or shows teeth sings less.
constexpr float kMouthOfFeeling = 0.7F;
constexpr float kTeethShape = 0.75F;  // of the vowel that shows them

// Who looks past the audience looks this far aside, at that much height over its eyes.
constexpr float kPastAside = 0.45F;  // of the distance
constexpr float kPastUp = 0.12F;
constexpr double kPastSeconds = 3.1;      // of one such look
constexpr std::uint64_t kPastStream = 3;  // random numbers

// Cosine of the angle between the face and what it looks at: from here on the eyes do not reach it.
constexpr float kGazeLost = 0.26F;  // 75 degrees
constexpr float kGazeFull = 0.64F;  // 50 degrees

// Eyes go first, and the head comes after.
constexpr Nanos kEyesLead = std::chrono::milliseconds(120);
// Cosine of the angle between what is to be looked at and where the head will be: nearer than 22
// degrees the eyes keep to it, farther than 34 they go with the head.
constexpr float kGoesWithHead = 0.83F;
constexpr float kStaysOnTarget = 0.93F;
// A blink hides a fast turn of the head.
constexpr float kFarTurn = 0.436F;      // radians, 25 degrees
constexpr HopIndex kTurnHops = 20;      // in which it is far
constexpr HopIndex kBlinkAfter = 4;     // hops from its start
constexpr HopIndex kLongestBlink = 26;  // hops
constexpr double kTurnShut = 0.05;      // s

// 0 before and long after the blink that begins at 0.
double lids(double seconds, double closed) noexcept {
    const double fallen = seconds / kLidFall;
    const double risen = (seconds - kLidFall - closed) / kLidRise;
    return std::clamp(std::min(fallen, 1.0 - risen), 0.0, 1.0);
}

float smooth_lids(double seconds, double closed) noexcept {
    return smoothstep(0.0F, 1.0F, static_cast<float>(lids(seconds, closed)));
}

// Where the face looks, a unit vector.
glm::vec3 ahead_of_head(const motion::Pose& pose) noexcept {
    using motion::Bone;
    glm::quat rotation = pose.rotation(Bone::hips);
    for (const Bone bone : {Bone::spine, Bone::chest, Bone::upper_chest, Bone::neck, Bone::head}) {
        rotation = rotation * pose.rotation(bone);
    }
    return rotation * glm::vec3(0.0F, 0.0F, 1.0F);
}

float heading_of_head(const motion::Pose& pose) noexcept {
    const glm::vec3 ahead = ahead_of_head(pose);
    return std::atan2(ahead.x, ahead.z);
}

// Whether the head turns far from this hop on.
bool turns_far(const motion::PoseTrack& track, HopIndex hop) noexcept {
    const float turn =
        heading_of_head(track.at_hop(hop + kTurnHops)) - heading_of_head(track.at_hop(hop));
    return std::abs(std::remainder(turn, 2.0F * static_cast<float>(M_PI))) > kFarTurn;
}

// What the eyes look at: what they shall, or, as far as the head turns elsewhere, what that will
// face.
glm::vec3 gaze_target(const FaceMoment& moment,
                      const glm::vec3& wanted,
                      const glm::vec3& head) noexcept {
    const glm::vec3 towards = wanted - head;
    const float distance = glm::length(towards);
    const float soon = glm::length(moment.head.soon);
    if (!(distance > 0.0F) || !(soon > 0.0F)) {
        return wanted;
    }
    const float along = glm::dot(towards, moment.head.soon) / (distance * soon);
    const float stays = smoothstep(kGoesWithHead, kStaysOnTarget, along);
    return head + glm::mix((distance / soon) * moment.head.soon, towards, stays);
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

float mood_size(std::string_view mood) noexcept {
    const auto* const found = std::find_if(
        kMoodSizes.begin(), kMoodSizes.end(), [&](const auto& one) { return one.first == mood; });
    return found != kMoodSizes.end() ? found->second : 1.0F;
}

float blink_at(StreamTime time, std::uint64_t seed) noexcept {
    const std::int64_t ns = std::max<std::int64_t>(time.time_since_epoch().count(), 0);
    const auto cell = static_cast<std::uint64_t>(ns / kBlinkCell);
    const double start = kBlinkSpread * CounterRandom(seed, kBlinkTimes).uniform(cell);
    // Halves of the fall and the rise are more than half shut, too: 0.1 s of the 0.1 to 0.2.
    const double closed = 0.1 * CounterRandom(seed, kBlinkLengths).uniform(cell);
    const double into = static_cast<double>(ns % kBlinkCell) * 1e-9 - start;
    return smooth_lids(into, closed);
}

// A blink begins where the turn that lies ahead becomes far: once for each turn.
HeadTurn head_turn_at(const motion::PoseTrack& track, StreamTime moment) noexcept {
    HeadTurn turn;
    if (track.is_empty()) {
        return turn;
    }
    turn.soon = ahead_of_head(track.at(moment + kEyesLead));
    const HopIndex now = moment.time_since_epoch() / kHop;
    const HopIndex first = std::max(track.oldest_final() + 1, now - kBlinkAfter - kLongestBlink);
    bool turned = turns_far(track, first - 1);
    for (HopIndex hop = first; hop + kBlinkAfter <= now; ++hop) {
        const bool turns = turns_far(track, hop);
        if (turns && !turned) {
            const StreamTime starts = time_of_hop(hop + kBlinkAfter);
            turn.blink = std::max(turn.blink, smooth_lids(to_seconds(moment - starts), kTurnShut));
        }
        turned = turns;
    }
    return turn;
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

void DancerFace::show_feeling(const motion::Feeling& feeling, render::Face& face) const noexcept {
    using render::FaceExpression;
    constexpr std::array kShown = {FaceExpression::happy,
                                   FaceExpression::angry,
                                   FaceExpression::sad,
                                   FaceExpression::relaxed,
                                   FaceExpression::surprised};
    static_assert(kShown.size() == motion::kEmotionCount);
    for (std::size_t i = 0; i < kShown.size(); ++i) {
        face.weight(kShown[i]) = std::min(1.0F, habits_.mood * feeling.emotions[i]);
    }
    const float teeth = std::min(1.0F, habits_.mood * feeling.teeth);
    face.weight(FaceExpression::aa) *= 1.0F - kMouthOfFeeling * teeth;
    face.weight(FaceExpression::ee) = kTeethShape * teeth;
    const float brows = std::clamp(habits_.mood * feeling.brows, -1.0F, 1.0F);
    face.weight(FaceExpression::brow_up_left) = std::max(brows, 0.0F);
    face.weight(FaceExpression::brow_up_right) = std::max(-brows, 0.0F);
}

/// What the eyes shall look at.
glm::vec3 DancerFace::wanted_gaze(const FaceMoment& moment, const glm::vec3& head) const noexcept {
    // Without feelings as without moods: at who watches, or at the partner.
    const bool feels = habits_.mood > 0.0F && moment.feeling != motion::Feeling();
    const float audience = feels ? moment.feeling.audience : 1.0F;
    if (moment.partner) {
        const float away = feels && !moment.has_met ? audience : 0.0F;
        return glm::mix(*moment.partner, moment.gaze_target, away);
    }
    const glm::vec3 towards = moment.gaze_target - head;
    const double seconds = std::max(0.0, to_seconds(moment.time.time_since_epoch()));
    const auto look = static_cast<std::uint64_t>(seconds / kPastSeconds);
    const float side = CounterRandom(seed_, kPastStream).uniform(look) < 0.5 ? -1.0F : 1.0F;
    const glm::vec3 aside = glm::vec3(towards.z, 0.0F, -towards.x) * (side * kPastAside);
    const glm::vec3 up(0.0F, kPastUp * glm::length(towards), 0.0F);
    return moment.gaze_target + (1.0F - audience) * (aside + up);
}

render::Face DancerFace::face_at(const FaceMoment& moment,
                                 const motion::Skeleton& skeleton,
                                 const motion::Pose& pose) noexcept {
    render::Face face;
    if (habits_.blinks) {
        face.weight(render::FaceExpression::blink) =
            std::max(blink_at(moment.time, seed_), moment.head.blink);
    }
    const float mouth = mouth_at(moment);
    if (habits_.moves_mouth) {
        face.weight(render::FaceExpression::aa) = mouth;
    }
    show_feeling(moment.feeling, face);
    if (habits_.gazes) {
        const motion::WorldPose world = motion::world_pose(skeleton, pose);
        const glm::vec3 head = world.position(motion::Bone::head);
        face.gaze_target = gaze_target(moment, wanted_gaze(moment, head), head);
        face.gaze = smoothstep(kGazeLost, kGazeFull, facing(world, face.gaze_target));
    }
    return face;
}

}  // namespace raks::engine
