#include "training/beat/train_network.hpp"

#include <algorithm>
#include <array>

#include "training/beat/training_batches.hpp"
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
    constexpr std::array kBiases = {-3.0F, -4.0F, -3.0F};
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

}  // namespace raks::audio
