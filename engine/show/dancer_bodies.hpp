// From danced poses to dancers as they are drawn: on their own body, with face and tails.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/music_state.hpp"
#include "base/time.hpp"
#include "engine/show/dancer_face.hpp"
#include "engine/show/loaded_avatar.hpp"
#include "motion/skeleton/pose_track.hpp"
#include "render/avatar/avatar.hpp"
#include "render/renderer.hpp"
#include "render/scene/camera.hpp"

#include <glm/vec2.hpp>

namespace raks::engine {

/// One moment of the dance, as it is to be drawn.
struct DancedMoment {
    std::span<const motion::PoseTrack> tracks;  ///< one a dancer, on the stage
    /// Where each stands when not carried away by the dance (motion::DancerPart::place); none: all
    /// in the middle.
    std::span<const glm::vec2> places{};
    StreamTime moment{};                 ///< that is seen and heard
    Nanos lead{0};                       ///< by which the poses are ahead of it
    std::optional<render::Face> face{};  ///< of a clip; none: by the music
    /// What a clip of the only avatar moves besides turning its bones, as AvatarClip::move_others,
    /// for the pose on that avatar; empty: nothing.
    std::function<void(const motion::Pose&, const render::JointTree&, render::JointState&)>
        move_others{};
};

/// The bodies of all dancers, who wear one avatar or several in turn, and for each dancer what its
/// springs and its face remember. Tails depend on the poses of stream time alone, not on how often
/// pictures are drawn. Threads: the OpenGL context's. Real-time: no.
class DancerBodies {
 public:
    /// A body in the renderer.
    struct Worn {
        render::AvatarHandle handle;  ///< what names `avatar` in the renderer
        std::shared_ptr<const render::Avatar> avatar;
    };
    /// The bodies of one avatar: one, or two with the same skeleton. Of the dancers who wear the
    /// avatar every second one, and of a couple the lead, has the second body.
    using Builds = std::vector<Worn>;
    /// The avatars of all dancers, in turn: dancer k wears avatar k modulo their number. Not empty.
    using Wardrobe = std::vector<Builds>;

    /// `made_for`: the body for which danced poses are solved, or one that stands as high.
    /// `habits`: how all faces behave.
    DancerBodies(Wardrobe wardrobe, motion::Skeleton made_for, FaceHabits habits = {});

    /// From the next moment on they wear this; tails begin anew. Returns what they wore.
    [[nodiscard]] Wardrobe wear(Wardrobe wardrobe);

    /// What they wear.
    [[nodiscard]] const Wardrobe& wardrobe() const noexcept { return wardrobe_; }
    /// How their faces behave.
    [[nodiscard]] const FaceHabits& habits() const noexcept { return habits_; }

    /// The dancers at a moment; they hold until the next call. `camera`: where solo dancers look.
    [[nodiscard]] std::span<const render::Dancer> at(const DancedMoment& danced,
                                                     const MusicState& music,
                                                     const render::Camera& camera);
    /// How far from the stage's middle the farthest place is, metres; 0 without places.
    [[nodiscard]] float reach_of(std::span<const glm::vec2> places) const noexcept;
    /// A dancer in a pose of the body that dances are solved for, tails and face at rest.
    [[nodiscard]] render::Dancer still(const motion::Pose& pose) const noexcept;
    /// The first dancer's.
    [[nodiscard]] const render::Avatar& avatar() const noexcept {
        return *wardrobe_.front().front().avatar;
    }
    /// The bodies that their dances should be solved for (render::dance_body), one an avatar.
    [[nodiscard]] const std::vector<motion::Skeleton>& dance_bodies() const noexcept {
        return dance_bodies_;
    }
    /// How large the largest is, against the mannequin's 1 (render::size_of).
    [[nodiscard]] float size() const noexcept { return size_; }

 private:
    /// One dancer's memory.
    struct Body {
        render::RigState state;
        DancerFace face;
        std::optional<StreamTime> hands_met{};  // of a couple
        bool has_hands = false;                 // they hold now
    };
    [[nodiscard]] const Worn& worn_by(std::size_t dancer) const noexcept;
    [[nodiscard]] motion::Pose worn_pose(std::size_t dancer,
                                         const motion::Pose& danced,
                                         glm::vec2 place) const noexcept;
    void make_bodies(const DancedMoment& danced);
    [[nodiscard]] bool have_hands_met(std::size_t dancer, StreamTime moment) noexcept;
    void move(std::size_t dancer,
              const DancedMoment& danced,
              const MusicState& music,
              const render::Camera& camera);

    Wardrobe wardrobe_;
    std::vector<motion::Skeleton> dance_bodies_;
    float size_;
    motion::Skeleton made_for_;
    FaceHabits habits_;
    std::vector<std::unique_ptr<Body>> bodies_;  // of avatars that have a rig
    // Of dancers, for which `bodies_` are made.
    std::size_t made_count_ = 0;
    bool is_couple_ = false;
    std::vector<render::Dancer> dancers_;
};

/// What dancers wear of these costumes, whose bodies the renderer has as `added`, in their order.
/// Pure.
[[nodiscard]] DancerBodies::Wardrobe wardrobe_of(const Costumes& costumes,
                                                 const DancerBodies::Builds& added);
/// That body of it; none: nobody wears it. Pure.
[[nodiscard]] std::optional<DancerBodies::Worn> find_worn(
    const DancerBodies::Wardrobe& wardrobe, const std::shared_ptr<const render::Avatar>& body);
/// The renderer's handles of it, each once. Pure.
[[nodiscard]] std::vector<render::AvatarHandle> handles_of(const DancerBodies::Wardrobe& wardrobe);

}  // namespace raks::engine
