#include "training/beat/train_network.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "audio/beat/network/beat_network.hpp"
#include "training/networks/mel_augmentation.hpp"
#include "training/networks/network_descent.hpp"

namespace raks::audio {
namespace {

constexpr int kReportEvery = 100;              // steps
constexpr std::size_t kValidationEvery = 16;   // every such excerpt is for validation
constexpr std::size_t kValidationHops = 2000;  // hops of each, 20 s

/// Size of one step's batch.
struct BatchShape {
    std::size_t chunks = 24;
    std::size_t hops = 1000;
};

/// First weights, with output biases at the logits of rare events: most hops have no beat.
BeatNetwork fresh_network(const NetworkPlan& plan) {
    BeatNetwork network(plan.units, plan.layers, plan.lookahead);
    initialize(network, plan.seed);
    constexpr std::array kBiases = {-3.0F, -4.0F, -3.0F, -4.0F};
    std::copy(kBiases.begin(),
              kBiases.end(),
              network.parameters().begin() + static_cast<std::ptrdiff_t>(network.output_biases()));
    return network;
}

// Owns the network while it is trained.
class NetworkTrainer {
 public:
    NetworkTrainer(const std::vector<TrainingExcerpt>& corpus, const NetworkPlan& plan)
        : plan_(plan),
          network_(plan.start ? *plan.start : fresh_network(plan)),
          descent_(network_, plan.threads) {
        std::vector<const TrainingExcerpt*> kept;
        for (std::size_t i = 0; i < corpus.size(); ++i) {
            if (corpus[i].hops() > 0) {
                (i % kValidationEvery == 0 ? kept : training_).push_back(&corpus[i]);
            }
        }
        // Batches of 16 excerpts, to bound the memory of each.
        for (std::size_t i = 0; i < kept.size(); i += 16) {
            const auto first = kept.begin() + static_cast<std::ptrdiff_t>(i);
            const auto count =
                static_cast<std::ptrdiff_t>(std::min<std::size_t>(16, kept.size() - i));
            validation_.push_back(
                plain_batch({first, first + count}, kValidationHops, network_.lookahead()));
        }
    }

    BeatNetwork run(const std::function<void(const NetworkProgress&, const BeatNetwork&)>& report) {
        // The last steps, at a low rate, use fewer but longer chunks.
        const int long_steps = plan_.steps / 7;
        const int total = plan_.steps + long_steps;
        double loss = 0.0;
        int since = 0;
        for (int step = 0; step < total; ++step) {
            const bool is_long = step >= plan_.steps;
            loss += train_step(step,
                               is_long ? BatchShape{16, 2000} : BatchShape{},
                               rate_at(plan_.rate, step, total));
            ++since;
            if ((step + 1) % kReportEvery == 0 || step + 1 == total) {
                report({step + 1, total, loss / since, descent_.loss_of(validation_)}, network_);
                loss = 0.0;
                since = 0;
            }
        }
        return std::move(network_);
    }

 private:
    double train_step(int step, const BatchShape& shape, double rate) {
        // Each shard of each step has its own stream of draws.
        constexpr std::size_t kShards = NetworkDescent::kShards;
        return descent_.step(rate, [&](std::size_t shard) {
            Dice dice(plan_.seed, 1000 + static_cast<std::uint64_t>(step) * kShards + shard);
            return draw_batch(training_,
                              shape.chunks / kShards,
                              shape.hops,
                              network_.lookahead(),
                              plan_.cut_chance,
                              dice);
        });
    }

    NetworkPlan plan_;
    BeatNetwork network_;
    NetworkDescent descent_;
    std::vector<const TrainingExcerpt*> training_;
    std::vector<TrainingBatch> validation_;
};

}  // namespace

BeatNetwork train_network(
    const std::vector<TrainingExcerpt>& corpus,
    const NetworkPlan& plan,
    const std::function<void(const NetworkProgress&, const BeatNetwork&)>& report) {
    return NetworkTrainer(corpus, plan).run(report);
}

namespace {

constexpr std::size_t kOutputs = BeatNetwork::kOutputs;
constexpr double kHopsPerSecond = 100.0;
constexpr std::size_t kWarmUpHops = 120;  // of a chunk: the network has not seen what came before
constexpr float kWarmUpWeight = 0.2F;
// Downbeats weigh more: to place them the network has to count beats, which it learns last.
constexpr float kDownbeatWeight = 2.0F;
constexpr float kPartWeight = 0.7F;  // of halves and thirds

constexpr double kMostStretch = 0.16;  // ln of the time stretch

// Where in a chunk another piece may begin.
constexpr double kEarliestCut = 0.25;  // of the chunk
constexpr double kLatestCut = 0.6;

/// Hops [begin, end) of a chunk that one excerpt fills.
struct Span {
    std::size_t begin = 0;
    std::size_t end = 0;
};

// Fills one batch, rows hop-major: hop * chunks + chunk.
class BatchWriter {
 public:
    BatchWriter(std::size_t chunks, std::size_t hops, int lookahead) : lookahead_(lookahead) {
        batch_.steps = hops;
        batch_.chunks = chunks;
        batch_.inputs.resize(hops * chunks * NetworkInput::kSize);
        batch_.targets.resize(hops * chunks * kOutputs);
        batch_.weights.resize(hops * chunks * kOutputs);
    }

    // Inputs and targets of one excerpt in a span of a chunk. `input` carries on from the span
    // before.
    void write(std::size_t chunk,
               const Span& span,
               const TrainingExcerpt& excerpt,
               const MelAugmentation& augmentation,
               NetworkInput& input,
               Dice* dice) {
        const auto put = [&](std::size_t t, const NetworkInput::Frame& frame) {
            const std::size_t row = (span.begin + t) * batch_.chunks + chunk;
            std::copy(frame.begin(),
                      frame.end(),
                      batch_.inputs.begin() + static_cast<std::ptrdiff_t>(row * frame.size()));
        };
        augment_mel(excerpt.mel, augmentation, span.end - span.begin, input, dice, put);
        write_targets(chunk, span, excerpt, augmentation);
    }
    TrainingBatch finish() { return std::move(batch_); }

 private:
    // Outputs: 0 beat, 1 downbeat, 2 half-way between beats, 3 at thirds of beats of three parts.
    // Each is 1 where it happens.
    void write_targets(std::size_t chunk,
                       const Span& span,
                       const TrainingExcerpt& excerpt,
                       const MelAugmentation& augmentation) {
        // Seconds in the piece to a hop in the chunk: shift, stretch, and the network's look-ahead.
        const auto hop_of = [&](double seconds) {
            return static_cast<double>(span.begin) + lookahead_ +
                   (seconds * kHopsPerSecond - augmentation.first_hop) / augmentation.stretch;
        };
        const std::vector<PlayedBeat>& beats = excerpt.beats;
        double known_until = 0.0;  // hop up to which the annotations reach
        for (std::size_t i = 0; i < beats.size(); ++i) {
            const double at = hop_of(beats[i].time);
            mark(chunk, span, at, 0);
            if (beats[i].bar_position == 1) {
                mark(chunk, span, at, 1);
            }
            if (i + 1 < beats.size()) {
                const double next = hop_of(beats[i + 1].time);
                if (beats[i].parts == 3) {
                    mark(chunk, span, (2.0 * at + next) / 3.0, 3);
                    mark(chunk, span, (at + 2.0 * next) / 3.0, 3);
                } else {
                    mark(chunk, span, 0.5 * (at + next), 2);
                }
                // A little past the last beat; further on there may be beats that are not
                // annotated.
                known_until = next + 0.4 * (next - at);
            }
        }
        for (std::size_t t = span.begin; t < span.end; ++t) {
            // No weight after the annotations or after the end of the excerpt. Without any beat the
            // whole excerpt counts as having none.
            const std::size_t since = t - span.begin;
            const bool is_known =
                (beats.empty() || static_cast<double>(t) < known_until) &&
                augmentation.first_hop + static_cast<double>(since) * augmentation.stretch <
                    static_cast<double>(excerpt.hops());
            const float weight = !is_known ? 0.0F : since < kWarmUpHops ? kWarmUpWeight : 1.0F;
            float* const weights = &batch_.weights[(t * batch_.chunks + chunk) * kOutputs];
            weights[0] = weight;
            weights[1] = kDownbeatWeight * weight;
            weights[2] = kPartWeight * weight;
            weights[3] = kPartWeight * weight;
        }
    }
    /// Marks an output at a fractional hop: a triangle, 1 at the hop, 0 from two hops away.
    void mark(std::size_t chunk, const Span& span, double at, std::size_t output) {
        for (auto t = static_cast<std::ptrdiff_t>(std::floor(at)) - 1;
             t <= static_cast<std::ptrdiff_t>(std::floor(at)) + 2;
             ++t) {
            if (t < static_cast<std::ptrdiff_t>(span.begin) ||
                t >= static_cast<std::ptrdiff_t>(span.end)) {
                continue;
            }
            const auto index = (static_cast<std::size_t>(t) * batch_.chunks + chunk) * kOutputs;
            const auto value = static_cast<float>(
                std::max(0.0, 1.0 - 0.5 * std::abs(static_cast<double>(t) - at)));
            batch_.targets[index + output] = std::max(batch_.targets[index + output], value);
        }
    }

    int lookahead_;
    TrainingBatch batch_;
};

}  // namespace

TrainingBatch draw_batch(const std::vector<const TrainingExcerpt*>& from,
                         std::size_t chunks,
                         std::size_t hops,
                         int lookahead,
                         double cut_chance,
                         Dice& dice) {
    BatchWriter writer(chunks, hops, lookahead);
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        // Without a chance of a cut nothing is drawn for it, so older seeds give the same batches.
        std::vector<Span> spans = {{0, hops}};
        if (cut_chance > 0.0) {
            const double length = static_cast<double>(hops);
            const std::size_t cut = dice.chance(cut_chance)
                                        ? static_cast<std::size_t>(dice.uniform(
                                              kEarliestCut * length, kLatestCut * length))
                                        : hops;
            spans = {{0, cut}, {cut, hops}};  // the second is empty where nothing is cut
        }
        // One input for the whole chunk: its level and history carry over the cut.
        NetworkInput input;
        for (const Span& span : spans) {
            const TrainingExcerpt& excerpt =
                *dice.pick(std::span<const TrainingExcerpt* const>(from));
            const MelAugmentation augmentation =
                MelAugmentation::draw(excerpt.hops(), span.end - span.begin, kMostStretch, dice);
            writer.write(chunk, span, excerpt, augmentation, input, &dice);
        }
    }
    return writer.finish();
}

TrainingBatch plain_batch(const std::vector<const TrainingExcerpt*>& excerpts,
                          std::size_t hops,
                          int lookahead) {
    BatchWriter writer(excerpts.size(), hops, lookahead);
    const MelAugmentation augmentation = MelAugmentation::plain();
    for (std::size_t chunk = 0; chunk < excerpts.size(); ++chunk) {
        NetworkInput input;
        writer.write(chunk, {0, hops}, *excerpts[chunk], augmentation, input, nullptr);
    }
    return writer.finish();
}

}  // namespace raks::audio
