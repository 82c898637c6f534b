// Manner: how large, low and sharp a dance is danced now.
#pragma once

#include <array>

#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "motion/skeleton/humanoid.hpp"

namespace raks::motion {

/// How a dance is danced at a moment; the default is as its figures were learnt.
struct Manner {
    float body = 1.0F;  ///< size of what trunk and head do, and of the bounce
    float arms = 1.0F;  ///< size of what arms do
    /// By Side: length of steps. A foot's must not change while it stands.
    std::array<float, 2> steps{1.0F, 1.0F};
    /// [0, 1): how much trunk and arms hurry between two beats and wait on them; 0: as learnt
    float sharpness = 0.0F;
    float bend = 0.0F;  ///< how much lower the hips are; metres

    /// Whether it changes nothing.
    [[nodiscard]] bool is_as_learnt() const noexcept {
        return body == 1.0F && arms == 1.0F && steps[0] == 1.0F && steps[1] == 1.0F &&
               sharpness == 0.0F && bend == 0.0F;
    }
};

/// The manner that suits the music: small, upright and soft where it gives little, large, low and
/// sharp where it gives all. It grows within a quarter of a second and shrinks within half of one.
/// Threads: one. Real-time: yes.
class MannerOfMusic {
 public:
    /// What happens in the music, also while the dancer stands still.
    void hear(const MusicEvent& event) noexcept RAKS_NONBLOCKING;
    /// One hop of dancing.
    void advance(const MusicState& music) noexcept RAKS_NONBLOCKING;
    /// A foot in the air has gone so many metres: its step gets as long as the music wants.
    void swing(Side side, float metres) noexcept RAKS_NONBLOCKING;
    /// The manner now.
    [[nodiscard]] Manner manner() const noexcept RAKS_NONBLOCKING;
    /// How much the music gives now, smoothed as the manner is; [0, 1.3].
    [[nodiscard]] float energy() const noexcept { return energy_; }
    /// What is left of the last drop or entry; [0, 1].
    [[nodiscard]] float lift() const noexcept { return lift_; }
    /// As before any music.
    void reset() noexcept { *this = MannerOfMusic(); }

 private:
    float energy_ = 0.5F;
    float eased_ = 0.5F;       // energy_, smoothed once more
    float lift_ = 0.0F;        // of the last drop
    bool has_played_ = false;  // music that stopped since
    std::array<float, 2> steps_{1.0F, 1.0F};
};

/// The beat at which trunk and arms are read, so that they hurry between beats and wait on them.
/// It is never more than 0.16 beats from `beat`. Threads: any. Real-time: yes.
[[nodiscard]] double sharpened(double beat, float sharpness) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
