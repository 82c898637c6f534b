// Feelings: what a dancer's face shows, hop by hop.
#pragma once

#include <array>
#include <cstdint>

#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "motion/figures/dance_mood.hpp"
#include "motion/skeleton/feeling.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::motion {

/// What feelings are made from at one hop.
struct FeelingMoment {
    const MusicState& music;  ///< of the hop
    const DanceMood& mood;    ///< of the dance
    std::uint64_t seed = 1;   ///< of what passes over the face, and when
    bool is_dancing = false;  ///< else it waits
    bool is_in_couple = false;
    double bar = 0.0;        ///< bars since the phrase of eight began
    float energy = 0.5F;     ///< how much is danced (MannerOfMusic::energy)
    float height = 1.0F;     ///< of the hips, against that of one who stands
    bool is_in_air = false;  ///< no foot is on the floor
};

/// A face feels with the dance. Between its base mood, which the dance has, emotions pass over it
/// every few seconds, each from an accent or a bar line on; it brightens as the music gives more
/// and at a drop, strains where the body is deep or in the air, is surprised when the music stops
/// and relieved when it goes on. All of it is eased within a third of a second. The same moments
/// give the same feelings. Threads: one. Real-time: yes.
class Feelings {
 public:
    /// One hop, in order.
    void advance(const FeelingMoment& moment) noexcept RAKS_NONBLOCKING;
    /// What the face shows at the last hop.
    [[nodiscard]] const Feeling& now() const noexcept { return eased_.back(); }
    /// As before any music.
    void reset() noexcept { *this = Feelings(); }

 private:
    void hear(const FeelingMoment& moment, double now) noexcept;
    void strain(const FeelingMoment& moment) noexcept;
    void pass(const FeelingMoment& moment, double now) noexcept;
    [[nodiscard]] Emotion draw(const FeelingMoment& moment) noexcept;
    [[nodiscard]] float cause(double now, Feeling& target) const noexcept;
    [[nodiscard]] Feeling target(const FeelingMoment& moment, double now) const noexcept;

    static constexpr double kNever = -1e9;
    // Seconds of stream time at which each happened last.
    double stopped_ = kNever;
    double went_on_ = kNever;
    double dropped_ = kNever;
    double ended_ = kNever;
    double showed_teeth_ = kNever;
    bool is_stopped_ = false;
    bool has_danced_ = false;
    float strain_ = 0.0F;        // [0, 1]
    float usual_strain_ = 0.0F;  // over the last seconds: nobody strains on and on
    int hops_in_air_ = 0;
    // The emotion that passes, or did last.
    Emotion passing_ = Emotion::happy;
    float passing_size_ = 0.0F;
    float passing_brows_ = 0.0F;
    double passes_until_ = 0.0;
    std::uint64_t draws_ = 0;
    std::array<std::uint64_t, kEmotionCount> drawn_{};  // number of the last draw of each
    std::uint64_t accents_ = 0;
    bool was_late_in_bar_ = false;
    std::array<Feeling, 2> eased_{};  // stages of the filter
};

}  // namespace raks::motion
