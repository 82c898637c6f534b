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

    /// Who is asked. Beside the tagger the own parts weigh half; alone each weighs one.
    enum class Asked : std::uint8_t { own_parts, tagger, both };
    /// Seconds of music after which silence is the end of the song.
    static constexpr double kEndOfSong = 2.5;

    /// Weight of the own parts beside the tagger, and of the tagger, fitted on clips of other
    /// sources (docs/measurements/genre.md).
    static constexpr float kOwnWeight = 0.5F;
    static constexpr float kTaggerWeight = 0.75F;
    /// What a bar that the dance does not have takes off, in nats.
    static constexpr float kOtherBar = 3.0F;

    /// Whether another song is looked for, or all that is added is known to be of one song.
    enum class Songs : std::uint8_t { any, one };
    /// What the tagger said of a patch.
    struct Patch {
        std::int64_t number = 0;  ///< 1, 2, ... as they were added; 0: there was none
        StreamTime until{};       ///< its end
        Values logs{};            ///< ln probabilities by class
    };

    /// `classes`: those of the model, the last of which is none of the dances.
    explicit SongJudgement(std::size_t classes, Songs songs = Songs::any) noexcept
        : classes_(classes), songs_(songs) {}

    /// Another song begins.
    void reset() noexcept RAKS_NONBLOCKING;
    /// What the last seconds sound like: ln probabilities, and how sure they are: the seconds that
    /// they are of, up to the model's window. `seconds`: since the last call.
    void add(const Values& logs, double sureness, double seconds) noexcept RAKS_NONBLOCKING;
    /// What the tagger says of its newest patch; only a patch that was not added before counts.
    void add(const TaggerWord& word, const TaggerClasses& tagger) noexcept RAKS_NONBLOCKING;
    /// The same for what it said elsewhere, once each.
    void add(const Patch& patch) noexcept RAKS_NONBLOCKING { tags_.add(patch.logs, 1.0); }
    /// The newest patch of a word.
    [[nodiscard]] const Patch& patch() const noexcept { return patch_; }
    /// ln probabilities of the classes; nothing said yet by who is asked: none of them.
    /// `beats_per_bar`: of the music, where it is sure, else 0; `bars`: of each class' dance, 0:
    /// any.
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
    Songs songs_;
    Sum own_;
    Sum tags_;
    std::array<Other, PatternNetwork::kMaxClasses> others_{};  // by class
    std::uint32_t patches_ = 0;                                // of the tagger, as last added
    Patch patch_;                                              // likewise
};

}  // namespace raks::audio
