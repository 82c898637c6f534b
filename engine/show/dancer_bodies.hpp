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

/// The bodies of all dancers: one avatar, or two in turn, and for each dancer what its springs and
/// its face remember. Tails depend on the poses of stream time alone, not on how often pictures are
/// drawn. Threads: the OpenGL context's. Real-time: no.
class DancerBodies {
 public:
    /// `avatar` is what `handle` names in the renderer. `made_for`: a body that stands as high as
    /// the one that the dance was solved for. `habits`: of all faces.
    DancerBodies(render::AvatarHandle handle,
                 std::shared_ptr<const render::Avatar> avatar,
                 motion::Skeleton made_for,
                 FaceHabits habits = {});

    /// A body in the renderer.
    struct Worn {
        render::AvatarHandle handle;
        std::shared_ptr<const render::Avatar> avatar;
    };
    /// All wear another avatar from the next moment on, or two in turn (add_partner); tails begin
    /// anew. Returns what they wore.
    [[nodiscard]] std::vector<Worn> wear(std::vector<Worn> worn);

    /// A second body: the lead of a couple and every second dancer of a group have it. Its skeleton
    /// must be the first one's.
    void add_partner(render::AvatarHandle handle, std::shared_ptr<const render::Avatar> avatar);

    /// The dancers at a moment; they hold until the next call. `camera`: where solo dancers look.
    [[nodiscard]] std::span<const render::Dancer> at(const DancedMoment& danced,
                                                     const MusicState& music,
                                                     const render::Camera& camera);
    /// A dancer in a pose of the body that dances are solved for, tails and face at rest.
    [[nodiscard]] render::Dancer still(const motion::Pose& pose) const noexcept;
    [[nodiscard]] const render::Avatar& avatar() const noexcept { return *worn_.front().avatar; }

 private:
    /// One dancer's memory.
    struct Body {
        render::RigState state;
        DancerFace face;
    };
    /// What a dancer of so many wears.
    [[nodiscard]] const Worn& worn_by(std::size_t dancer, std::size_t count) const noexcept;
    void make_bodies(std::size_t count);
    void move(std::size_t dancer,
              const DancedMoment& danced,
              const MusicState& music,
              const render::Camera& camera);

    std::vector<Worn> worn_;  // one, or two that differ
    motion::Skeleton made_for_;
    FaceHabits habits_;
    std::vector<std::unique_ptr<Body>> bodies_;  // of avatars that have a rig
    std::size_t made_count_ = 0;                 // of dancers, for which `bodies_` are made
    std::vector<render::Dancer> dancers_;
};

}  // namespace raks::engine
