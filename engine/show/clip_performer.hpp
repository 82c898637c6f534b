// Clip performer: the poses of one who performs a clip, and stands where the clip does not run.
#pragma once

#include <optional>

#include "base/music_state.hpp"
#include "base/time.hpp"
#include "engine/show/avatar_clip.hpp"
#include "engine/show/clip_course.hpp"
#include "motion/dance/body/floor_move.hpp"
#include "motion/dance/inertialization.hpp"
#include "motion/dance/standing.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::engine {

/// Performs a clip hop by hop on the body that dances are solved for. Where its course leaves off
/// it steps back to where the clip begins, and stands. Nothing jumps: not where it begins, not
/// where it begins again. A rest pose in front of the clip is left out. Threads: one. Real-time:
/// no.
class ClipPerformer {
 public:
    /// `clip`: on motion::mannequin_skeleton().
    ClipPerformer(AvatarClip clip, const ClipTiming& timing);

    /// Another stream begins.
    void begin_anew() noexcept;
    /// What was shown is long gone: nothing leads over from it.
    void leap() noexcept {
        smoothing_.clear();
        shown_.reset();
    }
    /// As ClipCourse::set_song_start.
    void set_song_start(double seconds) noexcept { course_.set_song_start(seconds); }

    /// The pose of the next hop, which is at `moment`. `music`: the newest that is known.
    [[nodiscard]] motion::Pose next(StreamTime moment, const MusicState& music);
    /// The clip's face then; none: it has none, or does not run.
    [[nodiscard]] std::optional<render::Face> face() const;
    /// Where in the clip's file the last pose is, seconds; none: the clip does not run.
    [[nodiscard]] std::optional<double> file_seconds() const noexcept {
        return place_ ? std::optional(begins_ + *place_) : std::nullopt;
    }
    /// What is said of it, one line: how long it is, its tempo, and whether it loops.
    [[nodiscard]] std::string description() const;

 private:
    [[nodiscard]] motion::Pose pose_at(double seconds) const;
    [[nodiscard]] motion::Pose target(StreamTime moment, std::optional<double> place) const;
    void step_back(StreamTime moment);
    void change(StreamTime moment, std::optional<double> place);

    AvatarClip clip_;
    double begins_ = 0.0;  // seconds of the clip, behind its rest pose
    ClipTiming timing_;
    ClipSpan span_;
    ClipCourse course_;
    motion::Standing standing_;
    motion::FloorMove stands_;  // where, or where to it steps
    motion::Inertialization smoothing_;
    StreamTime changed_at_{};
    std::optional<double> place_;  // of the last hop
    std::optional<motion::Pose> shown_;
    motion::Pose shown_before_;
};

}  // namespace raks::engine
