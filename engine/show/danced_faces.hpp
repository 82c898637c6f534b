// The faces of a dance, for files.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/offline/offline_driver.hpp"
#include "engine/show/dancer_face.hpp"
#include "motion/skeleton/formats/vrma.hpp"
#include "render/avatar/face.hpp"

namespace raks::engine {

/// Makes all dancers' faces at an even rate while they dance, as a film of them shows them: face i
/// at i / fps seconds. Where eyes look is left out, as nobody knows who will watch.
class CollectFaces final : public OfflineDriver::Sink {
 public:
    /// `fps`: faces a second, > 0.
    CollectFaces(double fps, FaceHabits habits) : fps_(fps), habits_(habits) {
        habits_.gazes = false;
    }

    /// Appends the faces whose time the hop's tracks have reached.
    void on_hop(const PerformedHop& hop) override;

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
