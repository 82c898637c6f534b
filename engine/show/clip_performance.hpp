#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/show/avatar_clip.hpp"
#include "engine/show/show.hpp"
#include "motion/skeleton/pose_track.hpp"

namespace raks::engine {

/// A clip that all dancers perform over and over in the place of their dance, in the time of the
/// stream: it stands still while a song is paused. Threads: one.
class ClipPerformance {
 public:
    /// `name`: for people.
    ClipPerformance(AvatarClip clip, std::string name)
        : clip_(std::move(clip)), name_(std::move(name)) {}

    /// The clip's file, for people.
    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    /// Another stream begins: the clip begins anew with the first moment of it that is shown.
    void begin_anew() noexcept {
        begins_.reset();
        tracks_.clear();
    }

    /// The same moment, performed. Valid until the next call, and as long as `shown`.
    [[nodiscard]] ShownMoment at(const ShownMoment& shown);

 private:
    [[nodiscard]] double time_in_clip(StreamTime moment) const;
    void perform_until(HopIndex hop, const DancedMoment& danced);

    AvatarClip clip_;
    std::string name_;
    std::optional<StreamTime> begins_;
    std::vector<motion::PoseTrack> tracks_;  // one a dancer
};

}  // namespace raks::engine
