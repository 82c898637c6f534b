// Dance decision: from what is heard of a song to the dance that is shown.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "audio/genre/genre_fusion.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// A prior of so many nats, or more, is certain: neither what is heard nor another metre outvotes
/// it. Far more than what is heard can ever say.
inline constexpr float kCertainPrior = 1e4F;

/// Whether the music has surely other bars than a dance of `bars` beats (0: any) can be danced to:
/// in threes where the dance is not, or the other way round.
[[nodiscard]] bool contradicts(const BeatGrid& grid, int bars) noexcept;

/// When another class is shown than before.
struct DecisionRules {
    float margin = 0.2F;            ///< in probability, by which another genre must lead
    double switch_seconds = 0.5;    ///< how long it must lead
    double give_up_seconds = 3.0;   ///< how long "none of them" must lead
    float least_confidence = 0.3F;  ///< of the beat grid: below, a known genre is kept
    /// Least probability with which a dance is begun: a wrong one costs more than none.
    float least_chance = 0.4F;
};

/// Beats a bar of each class' dance; 0: any.
using ClassBars = std::array<int, PatternNetwork::kMaxClasses>;

/// Keeps the class that is shown: what is known beforehand is added to what is heard, and another
/// class is shown only when it leads by a margin for some time. Sound without a beat keeps it. A
/// dance whose metre the music contradicts is not shown, unless it is certain beforehand.
/// Threads: one. Real-time: yes.
class DanceDecision {
 public:
    using Values = GenreScores::Values;
    /// Seconds between two calls of advance().
    static constexpr double kStep = 0.1;

    /// `classes`: those of the model, the last of which is none of the dances; `prior`: as
    /// GenreSettings has it.
    DanceDecision(std::size_t classes,
                  const ClassBars& bars,
                  const GenreLogProbabilities& prior,
                  const DecisionRules& rules = {}) noexcept;

    /// Another prior from the next advance() on; where nothing was heard yet, at once.
    void expect(const GenreLogProbabilities& prior) noexcept RAKS_NONBLOCKING;
    /// Nothing is heard yet: the prior decides, or "none of them".
    void reset() noexcept RAKS_NONBLOCKING;
    /// Takes ln probabilities of what was heard. `heard_hops`: hops of music that they are from,
    /// in all; `grid`: of the music.
    void advance(const Values& heard,
                 std::int64_t heard_hops,
                 const BeatGrid& grid) noexcept RAKS_NONBLOCKING;

    /// The same of a song that is known as a whole: what leads is shown at once.
    void settle(const Values& heard, std::int64_t heard_hops, const BeatGrid& grid) noexcept;

    /// The class that is shown.
    [[nodiscard]] std::size_t shown() const noexcept { return shown_; }
    /// Whether it is what was known beforehand and not what is heard; what is certain is told
    /// whatever is heard.
    [[nodiscard]] bool is_told() const noexcept {
        const float prior = prior_[shown_];
        return prior >= kCertainPrior || (prior > 0.0F && heard_ != shown_);
    }
    /// ln probabilities of the classes, the prior among them.
    [[nodiscard]] const Values& log_chances() const noexcept { return log_chances_; }

 private:
    [[nodiscard]] std::size_t weigh(const Values& heard,
                                    std::int64_t heard_hops,
                                    const BeatGrid& grid) noexcept;
    void add_prior(std::int64_t heard_hops, const BeatGrid& grid) noexcept;
    void rule_out_metres(std::int64_t heard_hops, const BeatGrid& grid) noexcept;
    void challenge(std::size_t best, const BeatGrid& grid) noexcept;
    [[nodiscard]] std::size_t best() const noexcept;

    std::size_t classes_;
    ClassBars bars_;
    GenreLogProbabilities prior_;
    DecisionRules rules_;
    bool has_heard_ = false;  // since reset()
    Values log_chances_{};
    std::size_t shown_ = 0;
    std::size_t challenger_ = 0;  // class that leads
    double leads_for_ = 0.0;      // seconds that it has led
    std::size_t heard_ = 0;       // class that is heard, without the prior
};

}  // namespace raks::audio
