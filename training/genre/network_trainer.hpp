#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "audio/evaluate/piece_features.hpp"
#include "models/recurrent_network.hpp"

namespace raks::audio {

/// How the recurrent networks learn, each by itself: first from written music, of which there is
/// much, then from it in several branches whose weights' mean is taken, then some steps more with
/// recordings among it.
struct NetworkTrainingPlan {
    int networks = 1;  ///< heard together, 1 to GenreScorer::kMostNetworks
    std::size_t units = 64;
    std::size_t layers = 2;
    int written_steps = 1'500;  ///< batches of 24 stretches of 10 s
    double written_rate = 4e-3;
    int branches = 1;          ///< at most 1: none
    int branch_steps = 1'000;  ///< of each
    double branch_rate = 2e-3;
    int tuning_steps = 250;
    double tuning_rate = 1e-3;
    double recorded_share = 0.4;  ///< of a tuning batch, where a class has recordings
    double cut_chance = 0.33;     ///< that another piece begins within a stretch
    double room_chance = 0.35;    ///< that a stretch is heard in a room (MelAugmentation)
    /// That its treble is damped: recordings differ there by how they were made.
    double muffled_chance = 0.3;
    /// What they begin with in turn, where the layers fit: networks of the same inputs that know
    /// rhythm already. None: drawn.
    std::vector<std::shared_ptr<const models::RecurrentNetwork>> starts;
    std::uint64_t seed = 1;
    int threads = 2;

    /// How network `number`, from 0, learns: with a start and draws of its own.
    [[nodiscard]] NetworkTrainingPlan of_network(std::size_t number) const;
};

/// Mean cross-entropy a hop: of what was learnt from since the last report, and of pieces kept out.
struct NetworkTrainingProgress {
    int step = 0;
    int steps = 0;
    double training_loss = 0.0;
    double validation_loss = 0.0;
};
using ReportNetwork = std::function<void(const NetworkTrainingProgress&)>;

/// Whether the network is not to learn from piece `index` while it learns from written music: every
/// ninth written piece, to see how it fares and to weigh it with.
[[nodiscard]] inline bool is_kept_out(const PieceFeatures& piece, std::size_t index) noexcept {
    return !piece.is_recorded() && index % 9 == 4;
}

/// Learns from the written pieces, but for those kept out, in one run. `classes[i]`: of pieces[i],
/// below `class_count`. Each class is drawn alike often, each piece of a class alike often; each is
/// heard slower or faster (by up to 8 %), through drawn equalizers and in noise. The same plan and
/// pieces give the same weights on one machine, for any number of threads. `report`: every 50
/// steps.
[[nodiscard]] models::RecurrentNetwork train_on_written(
    std::span<const PieceFeatures* const> pieces,
    std::span<const std::size_t> classes,
    std::size_t class_count,
    const NetworkTrainingPlan& plan,
    const ReportNetwork& report);

/// The mean of the weights of `plan.branches` networks that each go on from `start` with draws of
/// their own. They lie in one valley, and the mean, deeper in it than any, does better on other
/// music (Wortsman et al. 2022). `report` counts the steps of all.
[[nodiscard]] models::RecurrentNetwork average_branches(
    const models::RecurrentNetwork& start,
    std::span<const PieceFeatures* const> pieces,
    std::span<const std::size_t> classes,
    const NetworkTrainingPlan& plan,
    const ReportNetwork& report);

/// Goes on from `start` with recordings (altered copies, too) among written music.
[[nodiscard]] models::RecurrentNetwork tune_network(const models::RecurrentNetwork& start,
                                                    std::span<const PieceFeatures* const> pieces,
                                                    std::span<const std::size_t> classes,
                                                    const NetworkTrainingPlan& plan);

}  // namespace raks::audio
