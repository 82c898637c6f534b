// What a dancer's face does while the music plays.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/time.hpp"
#include "motion/skeleton/feeling.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/pose_track.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/avatar/face.hpp"

namespace raks::engine {

/// What a face does by itself; each can be switched off.
struct FaceHabits {
    bool blinks = true;
    bool moves_mouth = true;  ///< by the music's level
    bool gazes = true;        ///< to the camera or the partner
    float mood = 1.0F;        ///< how much feelings show (mood_size); 0: not at all

    friend bool operator==(const FaceHabits&, const FaceHabits&) = default;
};

/// How much feelings show by the setting face_mood: "off" 0, "calm", "normal" 1, "stage". Pure.
[[nodiscard]] float mood_size(std::string_view mood) noexcept;

/// What the head does around a moment.
struct HeadTurn {
    glm::vec3 soon{0.0F};  ///< where the face looks a moment later, a unit vector; 0: not known
    float blink = 0.0F;    ///< 0..1: how far a blink closes the lids, because the head turns far
};

/// What a face is made from.
struct FaceMoment {
    StreamTime time{};                   ///< that is seen and heard
    float level_dbfs = -120.0F;          ///< of the music now (MusicState)
    float loudness_lufs = -120.0F;       ///< of the music of late (MusicState)
    glm::vec3 gaze_target{0.0F};         ///< the camera, or the partner's head (head_place); metres
    HeadTurn head{};                     ///< none: the head keeps still
    motion::Feeling feeling{};           ///< of the dancer (motion::PoseTrack::feeling_at)
    std::optional<glm::vec3> partner{};  ///< of a couple: the partner's head; metres
    bool has_met = false;                ///< hands of the couple have just met
};

/// How far both eyelids are closed at a moment, 0..1. Blinks are 2 to 6 s apart and keep the eyes
/// more than half shut for 0.1 to 0.2 s; when they come is the seed's alone.
/// Threads: any. Real-time: yes.
[[nodiscard]] float blink_at(StreamTime time, std::uint64_t seed) noexcept;

/// What the head of a dancer does at a moment of its track, which must reach 0.2 s beyond. The eyes
/// go where the head is 0.12 s later; a turn by more than 25 degrees within 0.2 s makes it blink.
/// Threads: any. Real-time: yes (some fifty products of rotations).
[[nodiscard]] HeadTurn head_turn_at(const motion::PoseTrack& track, StreamTime moment) noexcept;

/// Place of the head's joint, in the world.
[[nodiscard]] glm::vec3 head_place(const motion::Skeleton& skeleton,
                                   const motion::Pose& pose) noexcept;

/// The face of one dancer, picture by picture. The same seed and moments give the same faces.
/// Threads: one. Real-time: yes.
class DancerFace {
 public:
    explicit DancerFace(std::uint64_t seed, FaceHabits habits = {}) noexcept
        : seed_(seed), habits_(habits) {}

    void set_habits(FaceHabits habits) noexcept { habits_ = habits; }

    /// The face at a moment. `pose`: the dancer's. The eyes follow a target before them and go
    /// ahead of a head that turns elsewhere; they rest where what they look at is beside or behind
    /// the head. A couple's two look at each other, but where their feeling is for the audience and
    /// their hands have not just met; others look past the audience where it is not.
    [[nodiscard]] render::Face face_at(const FaceMoment& moment,
                                       const motion::Skeleton& skeleton,
                                       const motion::Pose& pose) noexcept;

 private:
    float mouth_at(const FaceMoment& moment) noexcept;
    void show_feeling(const motion::Feeling& feeling, render::Face& face) const noexcept;
    [[nodiscard]] glm::vec3 wanted_gaze(const FaceMoment& moment,
                                        const glm::vec3& head) const noexcept;

    std::uint64_t seed_;
    FaceHabits habits_;
    float mouth_ = 0.0F;
    std::optional<StreamTime> last_;
};

}  // namespace raks::engine
