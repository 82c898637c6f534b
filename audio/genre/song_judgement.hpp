// Song judgement: which dance a song is for, by all of it so far.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "audio/genre/genre_fusion.hpp"
#include "audio/genre/tag_source.hpp"
#include "audio/genre/tagger_classes.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Averages what is heard of a song: the logarithms of the classes' probabilities, by the model's
/// own parts and by the tagger, each with its weight. A song is for one dance from its first bar to
/// its last, so a change needs evidence, not a moment: the mean of a minute is not turned by the
/// next second. Another song without a silence before it is found by a cumulative sum of how much
/// the last seconds speak for another class (Page 1954); it is judged by these seconds alone.
/// Threads: one. Real-time: yes.
class SongJudgement {
 public:
    using Values = GenreScores::Values;

    /// Who is asked. Beside the tagger the own parts weigh half.
    enum class Asked : std::uint8_t { own_parts, both };
    /// Seconds of music after which silence is the end of the song.
    static constexpr double kEndOfSong = 2.5;

    /// `classes`: those of the model, the last of which is none of the dances.
    explicit SongJudgement(std::size_t classes) noexcept : classes_(classes) {}

    /// Another song begins.
    void reset() noexcept RAKS_NONBLOCKING;
    /// What the last seconds sound like: ln probabilities, and how sure they are: the seconds that
    /// they are of, up to the model's window. `seconds`: since the last call.
    void add(const Values& logs, double sureness, double seconds) noexcept RAKS_NONBLOCKING;
    /// What the tagger says of its newest patch; only a patch that was not added before counts.
    void add(const TaggerWord& word, const TaggerClasses& tagger) noexcept RAKS_NONBLOCKING;
    /// ln probabilities of the classes; nothing heard: none of them. `beats_per_bar`: of the music,
    /// where it is sure, else 0; `bars`: of each class' dance, 0: any.
    [[nodiscard]] Values log_chances(Asked asked,
                                     int beats_per_bar,
                                     std::span<const int> bars) const noexcept RAKS_NONBLOCKING;

 private:
    /// A weighted sum of logarithms.
    struct Sum {
        Values sum{};
        double weight = 0.0;
        void add(const Values& logs, double own) noexcept;
        void add_to(float factor, Values& out, std::size_t classes) const noexcept;
    };
    /// How much a class is spoken for instead of that of the song, and by what.
    struct Other {
        double nats = 0.0;  // times seconds
        Sum since;          // of the own parts, since they speak for it
    };
    [[nodiscard]] std::size_t best_of(const Sum& own) const noexcept;
    void watch_for_another(const Values& logs, double weight, double seconds) noexcept;

    std::size_t classes_;
    Sum own_;
    Sum tags_;
    std::array<Other, PatternNetwork::kMaxClasses> others_{};  // by class
    std::uint32_t patches_ = 0;                                // of the tagger, as last added
    StreamTime until_{};                                       // likewise
};

}  // namespace raks::audio
