// The faces of a dance, for files.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/music_state.hpp"
#include "engine/show/dancer_face.hpp"
#include "motion/skeleton/formats/vrma.hpp"
#include "motion/skeleton/pose_track.hpp"
#include "render/avatar/face.hpp"

namespace raks::engine {

/// Makes all dancers' faces at an even rate while they dance, as a film of them shows them: face i
/// at i / fps seconds. Where eyes look is left out, as nobody knows who will watch.
class CollectFaces {
 public:
    /// `fps`: faces a second, > 0.
    CollectFaces(double fps, FaceHabits habits) : fps_(fps), habits_(habits) {
        habits_.gazes = false;
    }

    /// The next hop: appends the faces whose time its tracks, one a dancer, have reached.
    void advance(const MusicState& music, std::span<const motion::PoseTrack> tracks);

    /// The faces of a dancer, cut or extended to so many: the last one is repeated.
    [[nodiscard]] std::vector<render::Face> of(std::size_t dancer, std::size_t count) const;

 private:
    double fps_;
    FaceHabits habits_;
    std::vector<DancerFace> made_by_;               // by dancer
    std::vector<std::vector<render::Face>> faces_;  // by dancer
    std::int64_t next_ = 0;
};

/// Faces as tracks of the expressions that they ever show. Pure.
[[nodiscard]] std::vector<motion::ExpressionTrack> expression_tracks(
    std::span<const render::Face> faces);

}  // namespace raks::engine
