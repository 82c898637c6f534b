#include "audio/beat/training/train_network.hpp"

#include <cblas.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <thread>

#include "audio/beat/training/network_trainer.hpp"
#include "audio/beat/training/training_batches.hpp"
#include "base/time.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kShards = 4;  // of a batch, summed in order whatever the threads
constexpr int kWarmUpSteps = 30;
constexpr int kReportEvery = 100;
constexpr std::size_t kValidationEvery = 16;
constexpr std::size_t kValidationHops = 2000;

/// What one step trains on.
struct BatchShape {
    std::size_t chunks = 24;
    std::size_t hops = 1000;
};

double mean_loss(double sum, const std::vector<TrainingBatch>& batches) {
    double frames = 0.0;
    for (const TrainingBatch& batch : batches) {
        frames += static_cast<double>(batch.steps * batch.chunks);
    }
    return sum / frames;
}

class NetworkTrainer {
 public:
    NetworkTrainer(const std::vector<TrainingExcerpt>& corpus, const NetworkPlan& plan)
        : plan_(plan),
          network_(plan.start ? *plan.start : BeatNetwork(plan.units, plan.layers, plan.lookahead)),
          adam_(network_.parameters().size()) {
        std::vector<const TrainingExcerpt*> kept;
        for (std::size_t i = 0; i < corpus.size(); ++i) {
            if (corpus[i].hops() > 0) {
                (i % kValidationEvery == 0 ? kept : training_).push_back(&corpus[i]);
            }
        }
        for (std::size_t i = 0; i < kept.size(); i += 16) {
            const auto first = kept.begin() + static_cast<std::ptrdiff_t>(i);
            const auto count =
                static_cast<std::ptrdiff_t>(std::min<std::size_t>(16, kept.size() - i));
            validation_.push_back(
                plain_batch({first, first + count}, kValidationHops, network_.lookahead()));
        }
        if (!plan.start) {
            initialize(network_, plan.seed);
        }
        openblas_set_num_threads(1);
    }

    BeatNetwork run(const std::function<void(const NetworkProgress&, const BeatNetwork&)>& report) {
        const int long_steps = plan_.steps / 7;
        const int total = plan_.steps + long_steps;
        double loss = 0.0;
        int since = 0;
        for (int step = 0; step < total; ++step) {
            const bool is_long = step >= plan_.steps;
            loss += train_step(
                step, is_long ? BatchShape{16, 2000} : BatchShape{}, rate_at(step, total));
            ++since;
            if ((step + 1) % kReportEvery == 0 || step + 1 == total) {
                report({step + 1, total, loss / since, validate()}, network_);
                loss = 0.0;
                since = 0;
            }
        }
        return std::move(network_);
    }

 private:
    [[nodiscard]] double rate_at(int step, int total) const {
        const double warm_up = std::min(1.0, (step + 1.0) / kWarmUpSteps);
        return plan_.rate * warm_up * 0.5 * (1.0 + std::cos(std::numbers::pi * step / total));
    }

    /// Runs work(i) for i = 0 .. count - 1 on the plan's threads.
    template <class Work>
    void share(std::size_t count, const Work& work) const {
        const auto threads = static_cast<std::size_t>(std::max(1, plan_.threads));
        std::vector<std::jthread> running;
        for (std::size_t first = 0; first < std::min(threads, count); ++first) {
            running.emplace_back([first, threads, count, &work] {
                const FlushToZeroScope flush_to_zero;
                for (std::size_t i = first; i < count; i += threads) {
                    work(i);
                }
            });
        }
    }

    double train_step(int step, const BatchShape& shape, double rate) {
        std::vector<std::vector<float>> gradients(kShards);
        std::array<double, kShards> losses{};
        const std::size_t chunks = shape.chunks / kShards;
        share(kShards, [&](std::size_t shard) {
            Dice dice(plan_.seed, 1000 + static_cast<std::uint64_t>(step) * kShards + shard);
            const TrainingBatch batch = draw_batch(
                training_, chunks, shape.hops, network_.lookahead(), plan_.cut_chance, dice);
            gradients[shard].assign(network_.parameters().size(), 0.0F);
            losses[shard] = gradients_[shard].accumulate(network_, batch, gradients[shard]);
        });
        const double frames = static_cast<double>(shape.chunks * shape.hops);
        const auto scale = static_cast<float>(1.0 / frames);
        double loss = losses[0];
        for (std::size_t shard = 1; shard < kShards; ++shard) {
            loss += losses[shard];
            for (std::size_t i = 0; i < gradients[0].size(); ++i) {
                gradients[0][i] += gradients[shard][i];
            }
        }
        for (float& value : gradients[0]) {
            value *= scale;
        }
        adam_.step(gradients[0], rate, network_.parameters());
        return loss / frames;
    }

    double validate() {
        std::vector<double> losses(validation_.size());
        share(validation_.size(), [&](std::size_t i) {
            NetworkGradient gradient;
            losses[i] = gradient.accumulate(network_, validation_[i], {});
        });
        double sum = 0.0;
        for (const double loss : losses) {
            sum += loss;
        }
        return validation_.empty() ? 0.0 : mean_loss(sum, validation_);
    }

    NetworkPlan plan_;
    BeatNetwork network_;
    Adam adam_;
    std::vector<const TrainingExcerpt*> training_;
    std::vector<TrainingBatch> validation_;
    std::array<NetworkGradient, kShards> gradients_;
};

}  // namespace

BeatNetwork train_network(
    const std::vector<TrainingExcerpt>& corpus,
    const NetworkPlan& plan,
    const std::function<void(const NetworkProgress&, const BeatNetwork&)>& report) {
    return NetworkTrainer(corpus, plan).run(report);
}

}  // namespace raks::audio
