#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "audio/evaluate/piece_features.hpp"
#include "base/music_state.hpp"
#include "models/recurrent_network.hpp"

/// Training of the recurrent networks of a genre model.
namespace raks::audio {

/// How the recurrent networks are trained, each on its own: on written music, of which there is
/// plenty; optionally on in several branches whose weights are averaged; then tuned for some steps
/// with recordings in the batches.
struct NetworkTrainingPlan {
    int networks = 1;  ///< whose log-probabilities are averaged, 1 to GenreScorer::kMostNetworks
    std::size_t units = 64;       ///< of each layer
    std::size_t layers = 2;       ///< of gated recurrent units
    int written_steps = 1'500;    ///< batches of 24 stretches of 10 s
    double written_rate = 4e-3;   ///< highest learning rate (Adam) on written music
    int branches = 1;             ///< trained from the same weights and averaged; at most 1: none
    int branch_steps = 1'000;     ///< of each
    double branch_rate = 2e-3;    ///< highest learning rate of a branch
    int tuning_steps = 250;       ///< batches with recordings in them
    double tuning_rate = 1e-3;    ///< highest learning rate while tuning
    double recorded_share = 0.4;  ///< share of a tuning batch, for classes with recordings
    double cut_chance = 0.33;     ///< chance that a second piece begins within a stretch
    double room_chance =
        0.35;  ///< chance of simulated reverberation on a stretch (MelAugmentation)
    /// Chance of damped treble: recordings differ in it by how they were made.
    double muffled_chance = 0.3;
    /// Layers that the networks start from, in turn, where the shapes agree: networks of the same
    /// inputs that already detect rhythm. Empty: random weights.
    std::vector<std::shared_ptr<const models::RecurrentNetwork>> starts;
    std::uint64_t seed = 1;  ///< of weights and draws
    int threads = 2;         ///< any number gives the same weights

    /// The plan of network `number`, from 0: its own start and its own seed.
    [[nodiscard]] NetworkTrainingPlan of_network(std::size_t number) const;
};

/// Mean cross-entropy a hop: on the batches since the last report, and on pieces that were kept
/// out.
struct NetworkTrainingProgress {
    int step = 0;                  ///< batches done
    int steps = 0;                 ///< batches in all
    double training_loss = 0.0;    ///< nats a hop
    double validation_loss = 0.0;  ///< nats a hop
};
/// Called on the training thread.
using ReportNetwork = std::function<void(const NetworkTrainingProgress&)>;

/// Is the piece at `index` kept out of training on written music? Every ninth written piece is: for
/// the validation loss and to fit the fusion on.
[[nodiscard]] inline bool is_kept_out(const PieceFeatures& piece, std::size_t index) noexcept {
    return !piece.is_recorded() && index % 9 == 4;
}

/// Trains on the written pieces, except those kept out, in one run. `classes[i]`: class of
/// pieces[i], below `class_count`. Every class is drawn equally often, and every piece of a class
/// equally often; each with time stretched by up to 8 %, a drawn equalizer and noise. The same plan
/// and pieces give the same weights on one machine, for any number of threads. `report`: every 50
/// steps. Threads: workers. Real-time: no.
[[nodiscard]] models::RecurrentNetwork train_on_written(
    std::span<const PieceFeatures* const> pieces,
    std::span<const std::size_t> classes,
    std::size_t class_count,
    const NetworkTrainingPlan& plan,
    const ReportNetwork& report);

/// Averages the weights of `plan.branches` networks that are each trained on from `start` with
/// draws of their own. They stay in one basin of the loss, and the average generalizes better than
/// any of them (Wortsman et al. 2022). `report` counts the steps of all.
[[nodiscard]] models::RecurrentNetwork average_branches(
    const models::RecurrentNetwork& start,
    std::span<const PieceFeatures* const> pieces,
    std::span<const std::size_t> classes,
    const NetworkTrainingPlan& plan,
    const ReportNetwork& report);

/// Trains on from `start` with recordings (altered copies, too) and written music in the batches.
[[nodiscard]] models::RecurrentNetwork tune_network(const models::RecurrentNetwork& start,
                                                    std::span<const PieceFeatures* const> pieces,
                                                    std::span<const std::size_t> classes,
                                                    const NetworkTrainingPlan& plan);

/// Copies of the networks with one output for each of `genres` and one for none of them. `known`:
/// the genres that the networks have outputs for, all among `genres`. Each new genre gets a copy of
/// the output of none; their biases are lowered so that together they have the probability that
/// none had.
[[nodiscard]] std::vector<std::shared_ptr<const models::RecurrentNetwork>> with_outputs(
    std::span<const std::shared_ptr<const models::RecurrentNetwork>> networks,
    std::span<const std::string> known,
    std::span<const std::string> genres);

}  // namespace raks::audio
