#include "engine/show/clip_performer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "motion/figures/phrase_tempo.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace raks::engine {
namespace {

constexpr double kRate = 60.0;          // poses a second that are looked at
constexpr double kTempoSeconds = 60.0;  // of the clip that tell its tempo
constexpr float kMeetMetres = 0.10F;    // first and last pose: joints in the world
constexpr float kMeetRadians = 0.26F;   // 15 degrees
constexpr double kThere = 0.01;         // metres
constexpr double kJump = 0.1;           // seconds that no course runs in a hop

using motion::Bone;
constexpr std::array<Bone, 13> kComparedBones = {Bone::hips,
                                                 Bone::chest,
                                                 Bone::head,
                                                 Bone::left_upper_leg,
                                                 Bone::left_lower_leg,
                                                 Bone::left_foot,
                                                 Bone::right_upper_leg,
                                                 Bone::right_lower_leg,
                                                 Bone::right_foot,
                                                 Bone::left_lower_arm,
                                                 Bone::left_hand,
                                                 Bone::right_lower_arm,
                                                 Bone::right_hand};

const motion::Skeleton& body() noexcept { return motion::mannequin_skeleton(); }

bool do_meet(const motion::Pose& first, const motion::Pose& last) {
    const motion::WorldPose a = motion::world_body(body(), first);
    const motion::WorldPose b = motion::world_body(body(), last);
    for (const Bone bone : kComparedBones) {
        const float turn =
            2.0F *
            std::acos(std::min(1.0F, std::abs(glm::dot(a.rotation(bone), b.rotation(bone)))));
        if (glm::length(a.position(bone) - b.position(bone)) > kMeetMetres || turn > kMeetRadians) {
            return false;
        }
    }
    return true;
}

// Seconds of the clip that are a rest pose in front of it.
double rest_of(const AvatarClip& clip) {
    constexpr double kLongestRest = 20.0;
    std::vector<motion::Pose> poses;
    for (double at = 0.0; at <= std::min(clip.duration(), kLongestRest); at += 1.0 / clip.rate()) {
        poses.push_back(clip.pose_at(at));
    }
    return static_cast<double>(motion::leading_rest_poses(poses, clip.rate())) / clip.rate();
}

double tempo_of(const AvatarClip& clip, double begins, double seconds) {
    if (clip.bpm()) {
        return *clip.bpm();
    }
    std::vector<motion::Pose> poses;
    for (double at = 0.0; at < std::min(seconds, kTempoSeconds); at += 1.0 / kRate) {
        poses.push_back(clip.pose_at(begins + at));
    }
    const auto counts = motion::count_phrase(motion::PhraseSignals(poses, kRate, body()));
    return counts.empty() ? 0.0 : counts.front().bpm;
}

ClipSpan span_of(const AvatarClip& clip, double begins, ClipSync sync) {
    ClipSpan span;
    // A clip of one pose is held for a while.
    span.seconds = std::max(clip.duration() - begins, 1.0 / kRate);
    span.do_ends_meet = do_meet(clip.pose_at(begins), clip.pose_at(clip.duration()));
    span.bpm = sync == ClipSync::beat ? tempo_of(clip, begins, span.seconds) : 0.0;
    return span;
}

}  // namespace

ClipPerformer::ClipPerformer(AvatarClip clip, const ClipTiming& timing)
    : clip_(std::move(clip)),
      begins_(rest_of(clip_)),
      timing_(timing),
      span_(span_of(clip_, begins_, timing.sync)),
      course_(span_, timing) {
    stands_ = motion::floor_frame(pose_at(0.0));
    standing_.stand(stands_);
}

void ClipPerformer::begin_anew() noexcept {
    course_.begin_anew();
    stands_ = motion::floor_frame(pose_at(0.0));
    standing_.stand(stands_);
    smoothing_.clear();
    place_.reset();
    shown_.reset();
}

motion::Pose ClipPerformer::pose_at(double seconds) const {
    return clip_.pose_at(begins_ + seconds);
}

motion::Pose ClipPerformer::target(StreamTime moment, std::optional<double> place) const {
    return place ? pose_at(*place) : standing_.at(body(), moment);
}

// Towards where the clip begins: what is far is walked to, a few steps at a time.
void ClipPerformer::step_back(StreamTime moment) {
    constexpr double kStepsReach = 0.9;  // metres
    motion::FloorMove to = motion::floor_frame(pose_at(0.0));
    const glm::dvec2 way = to.offset - stands_.offset;
    if (const double far = glm::length(way); far > kStepsReach) {
        to.offset = stands_.offset + way * (kStepsReach / far);
    }
    standing_.settle(body(), *shown_, shown_before_, stands_, to, moment);
    stands_ = to;
}

// The motion is another one from this moment on.
void ClipPerformer::change(StreamTime moment, std::optional<double> place) {
    if (!place) {
        stands_ = motion::floor_frame(*shown_);
        step_back(moment);
    }
    const double hop = to_seconds(kHop) * course_.rate();
    const motion::Pose before =
        place ? pose_at(std::max(0.0, *place - hop)) : standing_.at(body(), moment - kHop);
    smoothing_.start(*shown_, shown_before_, target(moment, place), before);
    changed_at_ = moment;
}

motion::Pose ClipPerformer::next(StreamTime moment, const MusicState& music) {
    const std::optional<double> place = course_.advance(moment, music);
    const bool goes_on =
        place.has_value() == place_.has_value() && (!place || std::abs(*place - *place_) < kJump);
    if (shown_ && !goes_on) {
        change(moment, place);
    } else if (shown_ && !place && standing_.is_settled(moment) &&
               glm::length(motion::floor_frame(pose_at(0.0)).offset - stands_.offset) > kThere) {
        step_back(moment);
    }
    place_ = place;
    motion::Pose pose = target(moment, place);
    if (smoothing_.is_active(moment - changed_at_)) {
        pose = smoothing_.apply(pose, moment - changed_at_);
    }
    if (!place) {
        standing_.plant(body(), moment, pose);
    }
    shown_before_ = shown_.value_or(pose);
    shown_ = pose;
    return pose;
}

std::optional<render::Face> ClipPerformer::face() const {
    return place_ ? clip_.face_at(begins_ + *place_) : std::nullopt;
}

std::string ClipPerformer::description() const {
    const bool loops = timing_.loop == ClipLoop::always ||
                       (timing_.loop == ClipLoop::where_ends_meet && span_.do_ends_meet);
    const std::string again = loops ? "over and over"
                              : timing_.loop == ClipLoop::never || timing_.sync == ClipSync::song
                                  ? "once"
                                  : "again at each phrase";
    if (timing_.sync == ClipSync::song) {
        return fmt::format(
            "{:.1f} s from {:.2f} s of the song on, {}", span_.seconds, timing_.offset, again);
    }
    return span_.bpm > 0.0
               ? fmt::format("{:.1f} s, taken for {:.0f} BPM, {}", span_.seconds, span_.bpm, again)
               : fmt::format("{:.1f} s, {}", span_.seconds, again);
}

}  // namespace raks::engine
