#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "base/dice.hpp"
#include "base/music_state.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/scene/camera.hpp"
#include "render/scene/dancers_room.hpp"
#include "render/scene/follow_spring.hpp"
#include "render/scene/liveliness.hpp"
#include "render/scene/shot.hpp"

#include <glm/vec2.hpp>

namespace raks::render {

/// What a shot is.
enum class Shot : std::uint8_t {
    wide,        ///< dancers and stage
    full,        ///< from head to foot
    knees_up,    ///< from the knees up
    upper_body,  ///< from the waist up
    feet,        ///< the steps
    side,        ///< from head to foot, from the side
    push,        ///< slowly nearer, from head to foot to the upper body
    orbit,       ///< slowly round, from head to foot
    low,         ///< from head to foot, near and from below
    face,        ///< head and neck of one, or of two who are close
};
/// How many there are.
inline constexpr std::size_t kShots = 10;

/// What the director shows at a hop.
struct DirectedView {
    Camera camera;            ///< frames the dancers in the picture's format
    Shot shot = Shot::wide;   ///< that is on
    std::uint32_t cuts = 0;   ///< so far: between two hops that differ in it is a cut
    bool is_gliding = false;  ///< the camera is on its way from the shot before to this one
};

/// Chooses what is seen, as an editor at a desk does: shots, when one follows another, and how.
/// - Shots change on bar lines and on drops, at most once a bar, by a cut or by a glide of one bar;
///   the fuller the music, the sooner. While nothing sounds, and in the bar before a drop that is
///   known, none does. A build-up is a slow push.
/// - The camera stays before the stage's front and on one side of the line of action. With two
///   dancers the line is the one through both: no cut crosses it where it lies at the cut. Else it
///   is the one from the stage's middle to the audience: no shot crosses it.
/// - Every shot frames all dancers, with their hands, but for those of feet and faces; one that the
///   picture's format would push far away is not chosen.
/// - Feet and faces are on for some seconds at most; a face is seen in every minute while music
///   plays. A drop cuts nearer, or lower.
/// - Dancers who move to and from the audience more than sideways are seen from three quarters.
///
/// The same seed, states, poses and picture format give the same views, whoever asks.
///
///     Director director({.seed = 1});
///     director.set_picture(16.0F / 9.0F, 1.0F);
///     scene.camera = director.advance(state, bodies).camera;  // at each hop
///
/// Threads: one. Real-time: yes.
class Director {
 public:
    /// `seed`: of the choices.
    explicit Director(std::uint64_t seed = 1, Liveliness liveliness = Liveliness::usual) noexcept;

    /// Width / height of the picture (> 0), and the dancers' size against the mannequin's 1.
    void set_picture(float aspect, float size) noexcept;

    /// From the next hop on.
    void set_liveliness(Liveliness liveliness) noexcept { liveliness_ = liveliness; }

    /// The view at the next hop. `dancers`: of a body that stands as high as the mannequin, in
    /// world space; none: the view stays. A state that does not follow the last one begins anew.
    const DirectedView& advance(const MusicState& music,
                                std::span<const motion::WorldPose> dancers) noexcept;

    /// Whether a camera at `yaw` is on the positive side of the line of action of these dancers;
    /// none: the line points at it, or there is none.
    [[nodiscard]] static std::optional<bool> side_of_line(
        float yaw, std::span<const motion::WorldPose> dancers) noexcept;

 private:
    // One end of a move: a size of shot from a direction.
    struct Stand {
        ShotSize size = ShotSize::wide;
        float yaw = 0.0F;
        FaceOf whose = FaceOf::first;  // of ShotSize::face
    };
    // How full the music is, for the pace of shots.
    enum class Pace : std::uint8_t { calm, usual, full };

    void begin() noexcept;
    void notice(const MusicState& music) noexcept;
    [[nodiscard]] bool is_on_bar_line(const MusicState& music) noexcept;
    void watch_ways(std::span<const motion::WorldPose> dancers) noexcept;
    [[nodiscard]] bool wants_change(const MusicState& music, bool is_bar_line) const noexcept;
    void change(const MusicState& music, std::span<const motion::WorldPose> dancers) noexcept;
    [[nodiscard]] Shot next_shot(Pace pace, std::size_t dancers) noexcept;
    [[nodiscard]] Shot shot_of_drop(std::size_t dancers) const noexcept;
    [[nodiscard]] FaceOf choose_face(std::size_t dancers, float yaw) noexcept;
    [[nodiscard]] Shot choose(Pace pace, std::size_t dancers) noexcept;
    [[nodiscard]] bool suits(Shot shot, std::size_t dancers) const noexcept;
    [[nodiscard]] ShotView view_of_stand(const Stand& stand) const noexcept;
    void set_up(Shot shot, double bar, std::span<const motion::WorldPose> dancers) noexcept;
    [[nodiscard]] float yaw_for(float low,
                                float high,
                                std::span<const motion::WorldPose> dancers) noexcept;
    [[nodiscard]] bool glides_to(const ShotView& to) noexcept;
    [[nodiscard]] ShotView view() const noexcept;
    [[nodiscard]] Camera smoothed(Camera camera, bool is_cut) noexcept;
    [[nodiscard]] float progress(double begins, double seconds) const noexcept;
    void draw_length(Pace pace) noexcept;

    Dice dice_;
    Liveliness liveliness_;
    float aspect_ = 16.0F / 9.0F;
    float size_ = 1.0F;
    float side_ = 1.0F;  // of the line from the stage's middle to the audience: -1 or 1
    DancersRoomKeeper room_;
    DirectedView shown_;

    std::optional<HopIndex> last_hop_;
    double now_ = 0.0;  // seconds of the stream, as below
    // The shot that is on: from one stand to another.
    Stand from_;
    Stand to_;
    double begins_ = 0.0;
    double move_seconds_ = 0.0;  // of the way between the stands; 0: there is none
    double length_ = 0.0;        // after which another shot may follow
    // The glide to it from where the camera was.
    ShotView glide_from_;
    // Between cuts: what frames the dancers best may turn at once, as another edge of the picture
    // is the nearest; a camera may not.
    FollowSpring distance_;
    std::array<FollowSpring, 3> target_;
    double glide_seconds_ = 0.0;  // 0: it was cut to

    std::optional<double> bar_position_;  // at the last hop; none: no bars are known
    double last_change_ = 0.0;
    std::optional<double> drop_at_;    // a drop that has not been answered yet
    std::optional<Shot> next_;         // asked for by an event
    std::array<double, kShots> seen_;  // when each shot was on last
    double face_seen_ = 0.0;           // when a face was, or the music began
    double until_drop_ = 0.0;          // seconds to a drop that is known; many: there is none
    bool shows_second_face_ = false;   // in the next shot of one face of two
    // How the dancers move: mean squares of the speeds of hips, hands and feet, sideways and to
    // and from the audience.
    std::array<glm::vec3, 5> places_{};
    bool has_places_ = false;
    float sideways_ = 0.0F;
    float fore_and_aft_ = 0.0F;
};

/// "wide", "full", "knees up", "upper body", "feet", "side", "push", "orbit",
/// "low", "face".
[[nodiscard]] std::string_view name_of(Shot shot) noexcept;

}  // namespace raks::render
