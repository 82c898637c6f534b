#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/show/camera_motion.hpp"
#include "engine/show/clip_performer.hpp"
#include "engine/show/show.hpp"
#include "motion/skeleton/pose_track.hpp"

namespace raks::engine {

/// A clip that all dancers perform in the place of their dance, in the time of the stream: it
/// stands still while a song is paused. Threads: one.
class ClipPerformance {
 public:
    /// `name`: for people.
    ClipPerformance(ClipPerformer performer, std::string name)
        : performer_(std::move(performer)), name_(std::move(name)) {}

    /// The clip's file, for people.
    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    /// A camera that was made for the clip, from the start of its file on.
    void set_camera(CameraMotion camera) { camera_ = std::move(camera); }
    /// That camera at the moment that at() was asked for; none: there is none, or the clip does not
    /// run. `size`: of the dancers against the mannequin's 1.
    [[nodiscard]] std::optional<render::Camera> camera(float size) const;

    /// As ClipPerformer::description.
    [[nodiscard]] std::string description() const { return performer_.description(); }
    /// Another stream begins: the clip begins anew with the first moment of it that is shown.
    void begin_anew() noexcept {
        performer_.begin_anew();
        tracks_.clear();
        song_start_.reset();
    }
    /// Where the song is at the start of the stream, in its seconds; with each picture. It changes
    /// with a seek; what a buffer makes of it is passed over.
    void follow_song(double song_start) noexcept;

    /// The same moment, performed. Valid until the next call, and as long as `shown`.
    [[nodiscard]] ShownMoment at(const ShownMoment& shown);

 private:
    void perform_until(HopIndex hop, const ShownMoment& shown);

    ClipPerformer performer_;
    std::string name_;
    std::optional<CameraMotion> camera_;
    double ahead_ = 0.0;  // seconds from the moment that was asked for to the newest pose
    std::optional<double> song_start_;
    std::vector<motion::PoseTrack> tracks_;  // one a dancer
};

}  // namespace raks::engine
