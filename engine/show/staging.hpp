#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/music_state.hpp"
#include "base/time.hpp"
#include "engine/show/framing.hpp"
#include "motion/skeleton/pose_track.hpp"
#include "render/scene/director.hpp"
#include "render/scene/light_show.hpp"
#include "render/scene/scene.hpp"

namespace raks::engine {

/// The camera that is none of the presets: a director chooses what is seen.
inline constexpr std::string_view kDirector = "director";

/// Who moves the camera of a show.
struct CameraChoice {
    std::string_view name = kDirector;  ///< kDirector, or a preset's name
    render::Camera preset{};            ///< that preset, where it must stand for the dancers
    bool is_held = false;               ///< a person has moved it by hand: it stays there
};

/// Camera and light of a show. Both are made hop by hop from music and poses, so that the same
/// dance gives the same pictures in a film and in a window, however often pictures are drawn.
///
///     staging.advance(state, tracks);  // each hop, in order
///     staging.set(scene, choice, {moment, lead}, tracks);  // each picture
///
/// Threads: one. Real-time: no (set() may allocate).
class Staging {
 public:
    /// `seed`: of the director's choices.
    Staging(std::uint64_t seed, render::Liveliness liveliness)
        : director_(seed, liveliness), light_(liveliness) {}

    /// Width / height of the picture (> 0) and the dancers' size against the mannequin's 1, from
    /// the next hop on.
    void set_picture(float aspect, float size) noexcept;

    /// How lively camera and light are from the next hop on.
    void set_liveliness(render::Liveliness liveliness) noexcept {
        director_.set_liveliness(liveliness);
        light_.set_liveliness(liveliness);
    }

    /// The next hop; `tracks`: one a dancer, whose pose of this hop is final.
    void advance(const MusicState& music, std::span<const motion::PoseTrack> tracks);
    /// The next hop is the first of another stream.
    void begin_anew() noexcept { last_hop_.reset(); }
    /// The hop that advance() got last; none: there was none yet.
    [[nodiscard]] std::optional<HopIndex> last_hop() const noexcept { return last_hop_; }

    /// What is to be seen when.
    struct Moment {
        StreamTime time{};  ///< that is heard
        Nanos lead{0};      ///< by which the poses are ahead of it
    };
    /// Sets the scene's light, and its camera where nobody holds it: the director's, or the preset
    /// on the dancers' heels (Framing). Moments go on from picture to picture.
    void set(render::Scene& scene,
             const CameraChoice& choice,
             const Moment& moment,
             std::span<const motion::PoseTrack> tracks);

    /// What the director and the light were at a moment, between the two hops around it; that of
    /// the nearest hop known outside of the last 1.28 s.
    struct Cue {
        HopIndex hop = -1;          ///< none: there was none yet
        render::DirectedView view;  ///< across a cut that of the hop before
        render::LightLevels light;
    };
    /// See Cue.
    [[nodiscard]] Cue at(StreamTime time) const noexcept;

 private:
    static constexpr std::size_t kKept = 128;
    [[nodiscard]] const Cue& cue_of(HopIndex hop) const noexcept;

    render::Director director_;
    render::LightShow light_;
    float aspect_ = 16.0F / 9.0F;
    float size_ = 1.0F;
    std::optional<HopIndex> first_hop_;
    std::optional<HopIndex> last_hop_;
    std::array<Cue, kKept> cues_{};  // that of hop h at h % kKept
    std::vector<motion::WorldPose> bodies_;
    // Of a preset.
    std::optional<Framing> framing_;
    render::Camera framed_preset_;
    float framed_aspect_ = 0.0F;
    float framed_size_ = 0.0F;
    StreamTime last_moment_{};
    std::vector<motion::Pose> poses_;
};

}  // namespace raks::engine
