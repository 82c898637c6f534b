#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "audio/evaluate/genre_scores.hpp"

namespace raks::audio {

/// How well windows of one length are classified.
struct GenreTally {
    std::size_t windows = 0;     ///< of that length, all classes
    double macro_recall = 0.0;   ///< mean over the asked classes that occur, each piece alike
    double two_dances = 0.0;     ///< mean recall of a pair, decided between these two only
    double auroc_unknown = 0.0;  ///< "none of them" against the genres; 0.5 is chance
    /// Truth x decision, both classes: shares of the weight of the truth's windows.
    std::vector<std::vector<double>> confusion;
    std::vector<std::size_t> pieces;  ///< by class
    double calibration_error = 0.0;   ///< expected calibration error of the best class' probability
    /// Windows whose best probability lies in one tenth of [0, 1]: sums of weight, of weight x
    /// probability, and of the weight of the windows that are classified right.
    struct Bin {
        double weight = 0.0;  ///< sum of the windows' weights
        double chance = 0.0;  ///< sum of weight x probability
        double right = 0.0;   ///< sum of the weights of right windows
    };
    std::array<Bin, 10> reliability{};  ///< by tenth, for the calibration curve
};

/// Tallies the windows of length kGenreWindows[`window`]. `log_chances`: fused ln probabilities,
/// one entry a score. `asked`: classes (at least two) between which the decision is taken and whose
/// pieces count for the recall; all others count for auroc_unknown only. `pair`: the two dances of
/// `two_dances`; empty: `two_dances` stays 0. Threads: any. Real-time: no.
[[nodiscard]] GenreTally tally(std::span<const WindowScore> scores,
                               std::span<const GenreScores::Values> log_chances,
                               std::size_t window,
                               std::span<const std::string> genres,
                               std::span<const std::size_t> asked,
                               std::span<const std::string> pair);

}  // namespace raks::audio
