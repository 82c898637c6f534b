#include "training/genre/network_trainer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "audio/evaluate/genre_scores.hpp"
#include "base/dice.hpp"
#include "training/networks/mel_augmentation.hpp"
#include "training/networks/network_descent.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kChunks = 24;   // stretches of a batch
constexpr std::size_t kHops = 1'000;  // of a stretch, 10 s
// ln of the time stretch: the tempo is evidence for a dance, so it must not move far.
constexpr double kMostStretch = 0.08;
constexpr float kSmoothing = 0.05F;  // of the labels: this share is spread over all classes
constexpr int kReportEvery = 50;
// The first notes do not tell the dance: a hop's weight in the loss rises from kFirstWeight at the
// piece's begin to 1 after kKnownHops.
constexpr float kFirstWeight = 0.03F;
constexpr std::size_t kKnownHops = 300;
constexpr double kEarliestCut = 0.25;  // share of the stretch where a second piece may begin
constexpr double kLatestCut = 0.6;
// Recordings of a class (altered copies among them) at which they are drawn at their full share.
// With fewer they are drawn less often, because the network would memorize them.
constexpr double kEnoughRecordings = 24.0;
constexpr std::size_t kFewestHops = 200;  // a shorter piece is not used

/// A piece with its class.
struct Drawn {
    const PieceFeatures* piece;
    std::size_t class_number;
};

/// Draws a class uniformly, then recorded or written by the plan's share, then a piece uniformly.
class PieceDraw {
 public:
    PieceDraw(std::size_t class_count, double recorded_share)
        : recorded_(class_count), written_(class_count), recorded_share_(recorded_share) {}

    void add(const PieceFeatures& piece, std::size_t class_number) {
        if (piece.hops() >= kFewestHops) {
            auto& of_class = piece.is_recorded() ? recorded_ : written_;
            of_class[class_number].push_back(&piece);
            // Only classes with pieces are drawn.
            if (std::find(learnt_.begin(), learnt_.end(), class_number) == learnt_.end()) {
                learnt_.push_back(class_number);
            }
        }
    }
    [[nodiscard]] bool is_empty() const { return learnt_.empty(); }
    [[nodiscard]] Drawn draw(Dice& dice) const {
        const std::size_t c = dice.pick<std::size_t>(learnt_);
        const double enough =
            std::min(1.0, static_cast<double>(recorded_[c].size()) / kEnoughRecordings);
        const bool is_recorded =
            written_[c].empty() || (!recorded_[c].empty() && dice.chance(enough * recorded_share_));
        return {dice.pick<const PieceFeatures*>(is_recorded ? recorded_[c] : written_[c]), c};
    }

 private:
    std::vector<std::vector<const PieceFeatures*>> recorded_;
    std::vector<std::vector<const PieceFeatures*>> written_;
    std::vector<std::size_t> learnt_;
    double recorded_share_;
};

// Fills one batch of kHops hops by `chunks` stretches, hop by hop.
class BatchWriter {
 public:
    BatchWriter(std::size_t chunks, std::size_t outputs) : outputs_(outputs) {
        // Rows are hop-major: hop * chunks + chunk. The smoothed share of every target is there
        // from the start; write() adds the rest to the true class.
        batch_.steps = kHops;
        batch_.chunks = chunks;
        batch_.loss = TrainingBatch::Loss::softmax;
        batch_.inputs.resize(kHops * chunks * NetworkInput::kSize);
        batch_.targets.resize(kHops * chunks * outputs, kSmoothing / static_cast<float>(outputs));
        batch_.weights.resize(kHops * chunks * outputs);
    }

    /// Fills hops [begin, end) of a chunk with augmented features of the piece. `input` carries on
    /// from the hops before, as it does at run time. `dice`: of the noise; null: none.
    void write(std::size_t chunk,
               std::size_t begin,
               std::size_t end,
               const Drawn& drawn,
               const MelAugmentation& augmentation,
               NetworkInput& input,
               Dice* dice) {
        const double piece_hops = static_cast<double>(drawn.piece->hops());
        const auto put = [&](std::size_t t, const NetworkInput::Frame& frame) {
            const std::size_t row = (begin + t) * batch_.chunks + chunk;
            std::copy(frame.begin(),
                      frame.end(),
                      batch_.inputs.begin() + static_cast<std::ptrdiff_t>(row * frame.size()));
            batch_.targets[row * outputs_ + drawn.class_number] += 1.0F - kSmoothing;
            // Behind the end of the piece its last hop is repeated: no weight.
            const bool is_over =
                augmentation.first_hop + static_cast<double>(t) * augmentation.stretch >=
                piece_hops;
            const float known =
                std::min(1.0F, static_cast<float>(t) / static_cast<float>(kKnownHops));
            std::fill_n(batch_.weights.begin() + static_cast<std::ptrdiff_t>(row * outputs_),
                        outputs_,
                        is_over ? 0.0F : kFirstWeight + (1.0F - kFirstWeight) * known);
        };
        augment_mel(drawn.piece->mel, augmentation, end - begin, input, dice, put);
    }
    TrainingBatch finish() { return std::move(batch_); }

 private:
    std::size_t outputs_;
    TrainingBatch batch_;
};

// One batch: each stretch is one piece, or two that meet at a drawn cut.
TrainingBatch draw_batch(const PieceDraw& from,
                         std::size_t chunks,
                         std::size_t outputs,
                         const NetworkTrainingPlan& plan,
                         Dice& dice) {
    BatchWriter writer(chunks, outputs);
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        const double length = static_cast<double>(kHops);
        // A cut teaches the network to let go of the first piece.
        const std::size_t cut =
            dice.chance(plan.cut_chance)
                ? static_cast<std::size_t>(length * dice.uniform(kEarliestCut, kLatestCut))
                : kHops;
        // One input for both pieces, so that the change arrives as in a stream.
        NetworkInput input;
        for (const auto& [begin, end] : {std::pair{std::size_t{0}, cut}, std::pair{cut, kHops}}) {
            if (begin < end) {
                const Drawn drawn = from.draw(dice);
                MelAugmentation augmentation =
                    MelAugmentation::draw(drawn.piece->hops(), end - begin, kMostStretch, dice);
                if (dice.chance(plan.room_chance)) {
                    augmentation.enter_room(dice);
                }
                if (dice.chance(plan.muffled_chance)) {
                    augmentation.muffle(dice);
                }
                writer.write(chunk, begin, end, drawn, augmentation, input, &dice);
            }
        }
    }
    return writer.finish();
}

/// The pieces without augmentation, in batches: for the validation loss.
std::vector<TrainingBatch> plain_batches(const std::vector<Drawn>& pieces, std::size_t outputs) {
    std::vector<TrainingBatch> batches;
    for (std::size_t first = 0; first < pieces.size(); first += kChunks) {
        const std::size_t count = std::min(kChunks, pieces.size() - first);
        BatchWriter writer(count, outputs);
        for (std::size_t i = 0; i < count; ++i) {
            NetworkInput input;
            writer.write(i, 0, kHops, pieces[first + i], MelAugmentation::plain(), input, nullptr);
        }
        batches.push_back(writer.finish());
    }
    return batches;
}

/// Written pieces to train on, and those kept out as batches for the validation loss.
struct WrittenMusic {
    PieceDraw from;
    std::vector<TrainingBatch> validation;

    WrittenMusic(std::span<const PieceFeatures* const> pieces,
                 std::span<const std::size_t> classes,
                 std::size_t class_count)
        : from(class_count, 0.0) {
        std::vector<Drawn> kept_out;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            if (is_kept_out(*pieces[i], i)) {
                if (pieces[i]->hops() >= kFewestHops) {
                    kept_out.push_back({pieces[i], classes[i]});
                }
            } else if (!pieces[i]->is_recorded()) {
                from.add(*pieces[i], classes[i]);
            }
        }
        validation = plain_batches(kept_out, class_count);
    }
};

/// Reports the mean training loss and the validation loss every kReportEvery steps.
class Reporter {
 public:
    Reporter(const std::vector<TrainingBatch>& validation, int steps, const ReportNetwork& report)
        : validation_(validation), steps_(steps), report_(report) {}

    void operator()(double step_loss, const NetworkDescent& descent) {
        loss_ += step_loss;
        ++since_;
        ++step_;
        if (step_ % kReportEvery == 0 || step_ == steps_) {
            report_({step_, steps_, loss_ / since_, descent.loss_of(validation_)});
            loss_ = 0.0;
            since_ = 0;
        }
    }

 private:
    const std::vector<TrainingBatch>& validation_;
    int steps_;
    const ReportNetwork& report_;
    double loss_ = 0.0;
    int since_ = 0;
    int step_ = 0;
};

/// Takes `steps` steps at a rate that falls to 0 by rate_at; calls after(loss, descent) after each.
template <class After>
void descend(models::RecurrentNetwork& network,
             const PieceDraw& from,
             int steps,
             double rate,
             const NetworkTrainingPlan& plan,
             After&& after) {
    constexpr std::size_t kShards = NetworkDescent::kShards;
    NetworkDescent descent(network, plan.threads);
    for (int step = 0; step < steps && !from.is_empty(); ++step) {
        // Each shard of each step has a stream of draws of its own, so threads do not matter.
        const double loss = descent.step(rate_at(rate, step, steps), [&](std::size_t shard) {
            Dice dice(plan.seed, 5'000 + static_cast<std::uint64_t>(step) * kShards + shard);
            return draw_batch(from, kChunks / kShards, network.outputs(), plan, dice);
        });
        after(loss, descent);
    }
}

// Random weights; the layers of a given start replace them where inputs, units and layers agree.
// The outputs stay random: the start's are for beats.
models::RecurrentNetwork first_network(std::size_t class_count, const NetworkTrainingPlan& plan) {
    models::RecurrentNetwork network({NetworkInput::kSize, plan.units, plan.layers, class_count});
    initialize(network, plan.seed);
    if (plan.starts.empty()) {
        return network;
    }
    const models::RecurrentNetwork& start = *plan.starts.front();
    if (start.shape().inputs == NetworkInput::kSize && start.units() == plan.units &&
        start.layers().size() == plan.layers) {
        const auto layers = start.parameters().first(start.output_weights());
        std::copy(layers.begin(), layers.end(), network.parameters().begin());
    }
    return network;
}

}  // namespace

NetworkTrainingPlan NetworkTrainingPlan::of_network(std::size_t number) const {
    NetworkTrainingPlan own = *this;
    own.networks = 1;
    // Seeds far apart: average_branches adds multiples of 1,000 to them.
    own.seed += 10'000 * number;
    if (!starts.empty()) {
        own.starts = {starts[number % starts.size()]};
    }
    return own;
}

models::RecurrentNetwork train_on_written(std::span<const PieceFeatures* const> pieces,
                                          std::span<const std::size_t> classes,
                                          std::size_t class_count,
                                          const NetworkTrainingPlan& plan,
                                          const ReportNetwork& report) {
    models::RecurrentNetwork network = first_network(class_count, plan);
    const WrittenMusic music(pieces, classes, class_count);
    Reporter reporter(music.validation, plan.written_steps, report);
    descend(network, music.from, plan.written_steps, plan.written_rate, plan, reporter);
    return network;
}

models::RecurrentNetwork average_branches(const models::RecurrentNetwork& start,
                                          std::span<const PieceFeatures* const> pieces,
                                          std::span<const std::size_t> classes,
                                          const NetworkTrainingPlan& plan,
                                          const ReportNetwork& report) {
    const WrittenMusic music(pieces, classes, start.outputs());
    Reporter reporter(music.validation, plan.branches * plan.branch_steps, report);
    // Parameters of `mean` are 0 at first.
    models::RecurrentNetwork mean(start.shape());
    for (int branch = 1; branch <= plan.branches; ++branch) {
        NetworkTrainingPlan own = plan;
        own.seed += 1'000 * static_cast<std::uint64_t>(branch);
        models::RecurrentNetwork network = start;
        descend(network, music.from, plan.branch_steps, plan.branch_rate, own, reporter);
        for (std::size_t i = 0; i < mean.parameters().size(); ++i) {
            mean.parameters()[i] += network.parameters()[i] / static_cast<float>(plan.branches);
        }
    }
    return mean;
}

models::RecurrentNetwork tune_network(const models::RecurrentNetwork& start,
                                      std::span<const PieceFeatures* const> pieces,
                                      std::span<const std::size_t> classes,
                                      const NetworkTrainingPlan& plan) {
    models::RecurrentNetwork network = start;
    PieceDraw from(network.outputs(), plan.recorded_share);
    bool has_recordings = false;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        from.add(*pieces[i], classes[i]);
        has_recordings = has_recordings || pieces[i]->is_recorded();
    }
    // Without recordings there is nothing to tune on.
    if (has_recordings) {
        descend(network,
                from,
                plan.tuning_steps,
                plan.tuning_rate,
                plan,
                [](double, const NetworkDescent&) {});
    }
    return network;
}

namespace {

// One network with outputs for `genres` and none.
models::RecurrentNetwork widened(const models::RecurrentNetwork& network,
                                 std::span<const std::string> known,
                                 std::span<const std::string> genres) {
    models::RecurrentNetwork::Shape shape = network.shape();
    shape.outputs = genres.size() + 1;
    models::RecurrentNetwork wide(shape);
    // The layers do not depend on the outputs, and come first in the row of parameters.
    const auto from = network.parameters();
    const auto to = wide.parameters();
    std::copy_n(from.begin(), network.output_weights(), to.begin());
    const std::size_t none = known.size();
    // Which old output each new one copies. A genre that is not found gets the index known.size(),
    // which is that of none.
    std::vector<std::size_t> sources;
    for (const std::string& genre : genres) {
        sources.push_back(class_of(genre, known));
    }
    sources.push_back(none);
    // So many outputs share the probability of none: each bias falls by ln of that number.
    const auto shares = static_cast<float>(std::count(sources.begin(), sources.end(), none));
    for (std::size_t output = 0; output < sources.size(); ++output) {
        const std::size_t source = sources[output];
        for (std::size_t unit = 0; unit < network.units(); ++unit) {
            to[wide.output_weights() + unit * wide.outputs() + output] =
                from[network.output_weights() + unit * network.outputs() + source];
        }
        to[wide.output_biases() + output] =
            from[network.output_biases() + source] - (source == none ? std::log(shares) : 0.0F);
    }
    return wide;
}

}  // namespace

std::vector<std::shared_ptr<const models::RecurrentNetwork>> with_outputs(
    std::span<const std::shared_ptr<const models::RecurrentNetwork>> networks,
    std::span<const std::string> known,
    std::span<const std::string> genres) {
    std::vector<std::shared_ptr<const models::RecurrentNetwork>> wide;
    for (const auto& network : networks) {
        wide.push_back(
            std::make_shared<const models::RecurrentNetwork>(widened(*network, known, genres)));
    }
    return wide;
}

}  // namespace raks::audio
