#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "audio/evaluate/genre_scores.hpp"

namespace raks::audio {

/// How well windows of one length are told apart.
struct GenreTally {
    std::size_t windows = 0;
    double macro_recall = 0.0;   ///< mean over the classes asked for that occur, each piece alike
    double two_dances = 0.0;     ///< one of a pair against the other, only these two asked for
    double auroc_unknown = 0.0;  ///< none of the genres against the genres; 0.5 is chance
    std::vector<std::vector<double>>
        confusion;                    ///< truth x decision, shares of the truth's windows
    std::vector<std::size_t> pieces;  ///< of each class
    double calibration_error = 0.0;   ///< expected, of the best class' chance
    /// Windows whose best chance lies in one tenth: sums of weight, of weight x chance, of the
    /// weight of those that are right.
    struct Bin {
        double weight = 0.0;
        double chance = 0.0;
        double right = 0.0;
    };
    std::array<Bin, 10> reliability{};
};

/// `asked`: classes whose pieces count for the recall and between which it is decided (at least
/// two); the others count for auroc_unknown alone. `pair`: the two dances of
/// `two_dances`; empty: 0.
[[nodiscard]] GenreTally tally(std::span<const WindowScore> scores,
                               std::span<const GenreScores::Values> log_chances,
                               std::size_t window,
                               std::span<const std::string> genres,
                               std::span<const std::size_t> asked,
                               std::span<const std::string> pair);

}  // namespace raks::audio
