#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "audio/features/noise_floor.hpp"
#include "audio/genre/bar_patterns.hpp"
#include "audio/genre/dance_decision.hpp"
#include "audio/genre/genre_model.hpp"
#include "audio/genre/genre_scorer.hpp"
#include "audio/genre/song_judgement.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "models/hmm_scorer.hpp"
#include "models/sliding_score.hpp"

namespace raks::audio {

/// Whether a hop counts as evidence for a genre: neither silence nor one of the stream's first
/// hops. Training leaves out the same hops. Real-time: yes.
[[nodiscard]] bool is_genre_evidence(const MusicState& state) noexcept;

/// ln density of a frame under the mixture of a model's states, each with the same weight.
/// `log_emissions`: ln b_n(o) of each state. Real-time: yes.
[[nodiscard]] double frame_density(std::span<const double> log_emissions) noexcept;

/// Settings of GenreRecognizer::create().
struct GenreSettings {
    /// Which dances MusicState::genre can name; genres of the model that are not in it count as
    /// none.
    std::shared_ptr<const DanceList> dances = nullptr;
    double window_seconds = 3.0;  ///< 0.5 to 10, rounded to the model's nearest window
    GenreEvidence evidence = GenreEvidence::fused;  ///< all of the model, or a part of it
    DecisionRules rules{};                          ///< when another genre is shown
    /// What is known of the music beforehand, by class of the model, in nats: it is added to the ln
    /// probabilities of what is heard, and decides alone until something is. All 0: nothing is
    /// known (audio/genre/tag_evidence.hpp makes one of a file's tags). From kCertainPrior on it
    /// decides in any case.
    GenreLogProbabilities prior{};
};

/// Decides every 100 ms which dance the music is for, from all of the song so far.
///
/// MFCC: one HMM a genre and the forward score of the sliding window (models/sliding_score.hpp:
/// exact, from products of blocks of 100 ms). Rhythm and sound: two pattern networks on
/// BarPatterns, every half second. Network: recurrent networks over every hop. The last three take
/// the magnitudes without hiss (NoiseFloor). The scores are fused by the weights of the window's
/// length; until the window is full, the longest full one is used. What the windows say is averaged
/// over the song, and so is what the music tagger says, where there is one (song_judgement.hpp). A
/// single kind of evidence, asked for by itself, is judged by its last window alone, as in the
/// paper. The decision is of DanceDecision; silence keeps it.
///
/// Threads: one. Real-time: all but create. Cost: about 13 us a hop with six genres, bounded: the
/// models' emissions each hop, the walks over blocks spread over the hops between.
class GenreRecognizer {
 public:
    /// Prepares a recognizer. Errors: the model is not valid; a window outside 0.5 to 10 s;
    /// evidence that the model lacks.
    [[nodiscard]] static Expected<GenreRecognizer> create(std::shared_ptr<const GenreModel> model,
                                                          const GenreSettings& settings);

    /// Takes a hop: its normalized MFCC vector and mel magnitudes; of `state` it reads time, grid,
    /// level and hop. Writes the genre fields of `state`. `word`: the tagger's newest; null: there
    /// is no tagger.
    void advance(const MfccVector& mfcc,
                 std::span<const float, BarPatterns::kMelBands> mel,
                 const TaggerWord* word,
                 MusicState& state) noexcept RAKS_NONBLOCKING;
    /// For a hop without sound: writes the genre fields as they were.
    void advance_blind(MusicState& state) const noexcept RAKS_NONBLOCKING;
    /// From now on this is known of the music beforehand: GenreSettings::prior. What was heard
    /// stays.
    void expect(const GenreLogProbabilities& prior) noexcept RAKS_NONBLOCKING {
        decision_.expect(prior);
    }
    /// Forgets the music; the decision is "none of them".
    void reset() noexcept RAKS_NONBLOCKING;

    /// Fused ln probabilities of the classes for one window length.
    struct Judgement {
        bool is_full = false;               ///< enough music; otherwise the values mean nothing
        GenreScores::Values log_chances{};  ///< by class
    };
    /// The scores of window length `kGenreWindows[window]` as they stand.
    [[nodiscard]] Judgement judge(std::size_t window) const noexcept RAKS_NONBLOCKING;

    /// What the own parts said of the last seconds.
    struct Moment {
        std::int64_t number = 0;      ///< 1, 2, ... since reset(); 0: nothing is said yet
        std::int64_t heard_hops = 0;  ///< with evidence, since reset()
        double seconds = 0.0;         ///< that the window holds
        double sureness = 0.0;        ///< its share of the wanted window
        GenreScores::Values logs{};   ///< ln probabilities by class
    };
    /// The newest; every 100 ms of music brings another.
    [[nodiscard]] const Moment& moment() const noexcept { return moment_; }
    /// The tagger's newest patch as this model takes it; number 0: none yet.
    [[nodiscard]] const SongJudgement::Patch& patch() const noexcept { return song_.patch(); }
    /// ln probabilities by what is heard of the song so far, by those who are asked.
    [[nodiscard]] GenreScores::Values heard(SongJudgement::Asked asked,
                                            const BeatGrid& grid) const noexcept RAKS_NONBLOCKING;
    /// A decision of its own by this model and these dances; `prior`: as in GenreSettings.
    [[nodiscard]] DanceDecision decision(const GenreLogProbabilities& prior) const noexcept;
    /// Beats a bar of each class' dance.
    [[nodiscard]] const ClassBars& bars() const noexcept { return bars_; }
    /// The model.
    [[nodiscard]] const GenreModel& model() const noexcept { return *model_; }

 private:
    GenreRecognizer(std::shared_ptr<const GenreModel> model, const GenreSettings& settings);

    void score_frame(const MfccVector& mfcc) noexcept;
    void score_patterns() noexcept;
    void decide(const TaggerWord* word, const MusicState& state) noexcept;
    [[nodiscard]] GenreScores::Values judge_song(const TaggerWord* word,
                                                 const BeatGrid& grid) noexcept;
    void publish(MusicState& state) const noexcept;

    std::shared_ptr<const GenreModel> model_;
    std::array<DanceId, kMostGenres + 1> dances_{};  // by class
    ClassBars bars_{};                               // by class
    GenreSettings settings_;
    std::size_t window_ = 0;  // index into kGenreWindows

    std::vector<models::HmmScorer> scorers_;  // genres, then background
    std::optional<models::HmmScorer> similarity_;
    std::vector<models::SlidingScore> sliding_;
    std::vector<std::vector<double>> emissions_;
    std::vector<double> selected_;
    std::vector<double> similarity_work_;
    NoiseFloor noise_;
    BarPatterns patterns_;
    GenreScorer network_scorer_;
    // ln probabilities by rhythm and by sound of one window length.
    struct Patterns {
        bool is_scored = false;  // there was enough music for this length
        GenreScores::Values rhythm{};
        GenreScores::Values sound{};
    };
    std::array<Patterns, kGenreWindows.size()> judged_{};  // by window length
    std::size_t next_pattern_ = kGenreWindows.size();      // window length whose turn it is
    std::int64_t counted_hops_ = 0;                        // hops with evidence since reset
    SongJudgement song_{1};
    HopIndex quiet_hops_ = 0;  // since the last hop with evidence
    Moment moment_;            // as last judged
    DanceDecision decision_{1, {}, {}};
};

}  // namespace raks::audio
