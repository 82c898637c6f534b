#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "audio/features/noise_floor.hpp"
#include "audio/genre/bar_patterns.hpp"
#include "audio/genre/genre_model.hpp"
#include "audio/genre/genre_scorer.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "models/hmm_scorer.hpp"
#include "models/sliding_score.hpp"

namespace raks::audio {

/// Whether this hop tells anything about the genre: neither silence nor the stream's first hops.
/// Training and recognition leave out the same. Real-time: yes.
[[nodiscard]] bool is_genre_evidence(const MusicState& state) noexcept;

/// ln of a frame's density under all states of a model, weighted alike, from its log-emissions.
[[nodiscard]] double frame_density(std::span<const double> log_emissions) noexcept;

struct GenreSettings {
    /// What MusicState::genre numbers; dances of the model that are not in it count as none.
    std::shared_ptr<const DanceList> dances = nullptr;
    double window_seconds = 3.0;  ///< 0.5 to 10, rounded to the model's nearest window
    GenreEvidence evidence = GenreEvidence::fused;
    float margin = 0.2F;            ///< by which another genre must lead, in chance
    double switch_seconds = 0.5;    ///< and for how long
    double give_up_seconds = 3.0;   ///< the same until nothing known is danced
    float least_confidence = 0.3F;  ///< of the beat: below, a known genre stays (applause)
};

/// Says every hop which dance the music is, from the last seconds that were no silence.
///
/// MFCC: one HMM a genre, forward score of the sliding window (models/sliding_score.hpp: exact,
/// from products of blocks of 100 ms). Rhythm and sound: two pattern networks on BarPatterns, every
/// half second. Network: recurrent networks hear every hop. The last three hear the music without
/// hiss (NoiseFloor). All are fused by the weights of the window's length; until a window is full
/// the longest that is full speaks. The decision changes only when another class leads by a margin
/// for a while; silence and sound without a beat keep it.
///
/// Threads: one. Real-time: all but create. Cost: about 13 us a hop with six genres, bounded: the
/// models' emissions each hop, the walks over blocks spread over the hops between.
class GenreRecognizer {
 public:
    /// Errors: those of the model's validation; a window outside 0.5 to 10 s.
    [[nodiscard]] static Expected<GenreRecognizer> create(std::shared_ptr<const GenreModel> model,
                                                          const GenreSettings& settings);

    /// Takes a hop: its normalized MFCC vector and mel magnitudes; of `state` it reads time, grid,
    /// level and hop. Writes the genre fields of `state`.
    void advance(const MfccVector& mfcc,
                 std::span<const float, BarPatterns::kMelBands> mel,
                 MusicState& state) noexcept RAKS_NONBLOCKING;
    /// A hop without sound: writes what was believed before.
    void advance_blind(MusicState& state) const noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING;

    /// ln chances of the classes at window `kGenreWindows[window]`, and whether it is full.
    struct Judgement {
        bool is_full = false;
        GenreScores::Values log_chances{};
    };
    [[nodiscard]] Judgement judge(std::size_t window) const noexcept RAKS_NONBLOCKING;

 private:
    GenreRecognizer(std::shared_ptr<const GenreModel> model, const GenreSettings& settings);

    void score_frame(const MfccVector& mfcc) noexcept;
    void score_patterns() noexcept;
    void decide(const MusicState& state) noexcept;
    void publish(MusicState& state) const noexcept;

    std::shared_ptr<const GenreModel> model_;
    std::array<DanceId, kMostGenres + 1> dances_{};  // by class
    GenreSettings settings_;
    std::size_t window_ = 0;  // index into kGenreWindows

    std::vector<models::HmmScorer> scorers_;  // genres, background
    std::optional<models::HmmScorer> similarity_;
    std::vector<models::SlidingScore> sliding_;
    std::vector<std::vector<double>> emissions_;
    std::vector<double> selected_;
    std::vector<double> similarity_work_;
    NoiseFloor noise_;
    BarPatterns patterns_;
    GenreScorer network_scorer_;
    /// By window: ln chances by rhythm and by sound alone.
    struct Patterns {
        bool is_scored = false;
        GenreScores::Values rhythm{};
        GenreScores::Values sound{};
    };
    std::array<Patterns, kGenreWindows.size()> judged_{};
    std::size_t next_pattern_ = kGenreWindows.size();  // window whose turn it is
    std::int64_t counted_hops_ = 0;                    // hops that counted
    GenreScores::Values log_chances_{};
    std::size_t decision_ = 0;  // class
    std::size_t challenger_ = 0;
    double leads_for_ = 0.0;  // s
};

}  // namespace raks::audio
