#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "audio/features/mfcc.hpp"
#include "audio/features/network_input.hpp"
#include "audio/genre/bar_patterns.hpp"
#include "audio/genre/genre_fusion.hpp"
#include "audio/genre/pattern_network.hpp"
#include "audio/genre/tagger_classes.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "models/gaussian_hmm.hpp"
#include "models/recurrent_network.hpp"

namespace raks::audio {

/// Window lengths that a model's fusion is fitted for, in segments of half a second: 0.5 to 10 s.
inline constexpr std::array<int, 5> kGenreWindows = {1, 2, 6, 10, 20};
/// Length of a segment, 0.5 s.
inline constexpr double kSegmentSeconds = BarPatterns::kSegmentHops / kHopsPerSecond;

/// Mean of the MFCC statics (C1..C12, C0; 26 bands) over music of many kinds: 83 clips, each
/// weighing the same. A running mean starts from it, before any music is known.
inline constexpr std::array<float, kMfccStatic> kMeanOfMusic = {
    -4.4F, -7.5F, -0.1F, -7.8F, -2.1F, -5.6F, -1.3F, -3.7F, 0.1F, -4.4F, 1.1F, -2.8F, 145.3F};

/// Definition of a model's features. A model must not be used with features of another definition.
struct GenreFeatures {
    MfccConfig mfcc;  ///< of the MFCC vectors
    /// Normalization of the statics.
    CepstralMeanConfig cepstral_mean = {.start_weight = 0.5, .start = kMeanOfMusic};
    /// Whether C0 (or the log energy) and its derivatives are among the features.
    enum class Energy : std::uint8_t { used, left_out };
    Energy energy = Energy::used;  ///< which of the two

    /// Number of features that the HMMs take: 39, or 36 without energy.
    [[nodiscard]] int dimension() const noexcept {
        return energy == Energy::used ? kMfccFeatures : kMfccFeatures - 3;
    }
    /// Copies the features that count from `vector` to `out` (dimension() values). Real-time: yes.
    void select(const MfccVector& vector, std::span<double> out) const noexcept;
};

/// A complete genre model. Classes: `genres` in order, then "none of them". Immutable while it is
/// used; read and written by genre_file.hpp.
struct GenreModel {
    GenreFeatures features;                 ///< definition of its inputs
    std::vector<std::string> genres;        ///< names of dances, none twice; 1 to kMostGenres
    std::vector<models::GaussianHmm> mfcc;  ///< one a genre
    models::GaussianHmm background;         ///< of all music: the class "none of them"
    /// Of frames that the genres have in common (inter-genre similarity, Bagci and Erzin 2007): a
    /// frame that it explains best does not count.
    std::optional<models::GaussianHmm> similarity;
    PatternNetwork rhythm;  ///< of the patterns over bar and beat; classes: genres, then none
    PatternNetwork sound;   ///< of the spectrum's shape, the bands' onsets and the swing; the same
    /// Recurrent networks over every hop (genre_scorer.hpp), 1 to GenreScorer::kMostNetworks.
    /// Inputs: NetworkInput::kSize; outputs: genres, then none.
    std::vector<models::RecurrentNetwork> networks;
    /// What the music tagger's numbers say of the same classes; none: it is not asked.
    std::optional<TaggerClasses> tagger;
    std::array<GenreFusion, kGenreWindows.size()> fusion;  ///< by window length, as kGenreWindows
    std::string made_with;                                 ///< the command that trained it
    std::string attribution;  ///< credits of the music that it was trained on

    /// Number of classes: genres and "none of them".
    [[nodiscard]] std::size_t classes() const noexcept { return genres.size() + 1; }
};

/// Checks that sizes agree, models are valid and their dimension is the features'. Errors: names
/// the first wrong field.
[[nodiscard]] Expected<void> validate(const GenreModel& model);

}  // namespace raks::audio
