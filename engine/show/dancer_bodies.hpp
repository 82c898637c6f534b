// From danced poses to dancers as they are drawn: on their own body, with face and tails.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/music_state.hpp"
#include "base/time.hpp"
#include "engine/show/dancer_face.hpp"
#include "motion/skeleton/pose_track.hpp"
#include "render/avatar/avatar.hpp"
#include "render/renderer.hpp"
#include "render/scene/camera.hpp"

namespace raks::engine {

/// One moment of the dance, as it is to be drawn.
struct DancedMoment {
    std::span<const motion::PoseTrack> tracks;  ///< one a dancer, on the stage
    StreamTime moment{};                        ///< that is seen and heard
    Nanos lead{0};                              ///< by which the poses are ahead of it
    std::optional<render::Face> face{};         ///< of a clip; none: by the music
};

/// The bodies of all dancers: one avatar, and for each dancer what its springs and its face
/// remember. Tails depend on the poses of stream time alone, not on how often pictures are drawn.
/// Threads: the OpenGL context's. Real-time: no.
class DancerBodies {
 public:
    /// `avatar` is what `handle` names in the renderer. `made_for`: the body that the dance was
    /// solved for.
    DancerBodies(render::AvatarHandle handle,
                 std::shared_ptr<const render::Avatar> avatar,
                 motion::Skeleton made_for);

    /// The dancers at a moment; they hold until the next call. `camera`: where solo dancers look.
    [[nodiscard]] std::span<const render::Dancer> at(const DancedMoment& danced,
                                                     const MusicState& music,
                                                     const render::Camera& camera);
    [[nodiscard]] const render::Avatar& avatar() const noexcept { return *avatar_; }

 private:
    /// One dancer's memory.
    struct Body {
        render::RigState state;
        DancerFace face;
    };
    void make_bodies(std::size_t count);
    void move(std::size_t dancer,
              const DancedMoment& danced,
              const MusicState& music,
              const render::Camera& camera);

    render::AvatarHandle handle_;
    std::shared_ptr<const render::Avatar> avatar_;
    motion::Skeleton made_for_;
    std::vector<std::unique_ptr<Body>> bodies_;  // of avatars that have a rig
    std::vector<render::Dancer> dancers_;
};

}  // namespace raks::engine
