#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "audio/features/cepstral_mean.hpp"
#include "audio/features/mfcc.hpp"
#include "audio/features/network_input.hpp"
#include "audio/genre/bar_patterns.hpp"
#include "audio/genre/genre_fusion.hpp"
#include "audio/genre/pattern_network.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "models/gaussian_hmm.hpp"
#include "models/recurrent_network.hpp"

namespace raks::audio {

/// Window lengths that a model is calibrated for, in segments of half a second.
inline constexpr std::array<int, 5> kGenreWindows = {1, 2, 6, 10, 20};
inline constexpr double kSegmentSeconds = BarPatterns::kSegmentHops / kHopsPerSecond;

/// Mean of the statics (C1..C12, C0; 26 bands) over music of many kinds: 83 clips, each alike. What
/// a running mean starts from before it has heard anything.
inline constexpr std::array<float, kMfccStatic> kMeanOfMusic = {
    -4.4F, -7.5F, -0.1F, -7.8F, -2.1F, -5.6F, -1.3F, -3.7F, 0.1F, -4.4F, 1.1F, -2.8F, 145.3F};

/// What a model's numbers are about: an analyzer that hears otherwise must not use it.
struct GenreFeatures {
    MfccConfig mfcc;
    CepstralMeanConfig cepstral_mean = {.start_weight = 0.5, .start = kMeanOfMusic};
    /// Whether C0 (or the log energy) and its derivatives count.
    enum class Energy : std::uint8_t { used, left_out };
    Energy energy = Energy::used;

    /// Of the vectors that the models see: 39 or 36.
    [[nodiscard]] int dimension() const noexcept {
        return energy == Energy::used ? kMfccFeatures : kMfccFeatures - 3;
    }
    /// Copies what counts of `vector`. `out`: dimension() values. Real-time: yes.
    void select(const MfccVector& vector, std::span<double> out) const noexcept;
};

/// Everything that is needed to say which dance music is. Classes: `genres` in order, then "none of
/// them". A value, immutable while it listens; read and written by genre_file.hpp.
struct GenreModel {
    GenreFeatures features;
    std::vector<std::string> genres;        ///< names of dances, none twice; 1 to kMostGenres
    std::vector<models::GaussianHmm> mfcc;  ///< one a genre
    models::GaussianHmm background;         ///< of all music: what is none of the genres
    /// Of frames that the genres confuse (inter-genre similarity, Bagci and Erzin 2007): a frame
    /// that it explains best does not count.
    std::optional<models::GaussianHmm> similarity;
    PatternNetwork rhythm;  ///< of the patterns over bar and beat; classes: genres, then none
    PatternNetwork sound;   ///< of the spectrum's shape, the bands' onsets and the swing; the same
    /// Hear every hop together (genre_scorer.hpp), 1 to
    /// GenreScorer::kMostNetworks: inputs NetworkInput::kSize; outputs: genres, then none.
    std::vector<models::RecurrentNetwork> networks;
    std::array<GenreFusion, kGenreWindows.size()> fusion;
    std::string made_with;    ///< the command
    std::string attribution;  ///< of the music that it was learnt from

    [[nodiscard]] std::size_t classes() const noexcept { return genres.size() + 1; }
};

/// Sizes agree, models are valid and of the features' dimension. Errors: the first wrong field.
[[nodiscard]] Expected<void> validate(const GenreModel& model);

}  // namespace raks::audio
