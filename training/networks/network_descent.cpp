#include "training/networks/network_descent.hpp"

#include <cblas.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

#include "base/time.hpp"

namespace raks::audio {
namespace {

constexpr int kWarmUpSteps = 30;          // until the rate is at its full height
constexpr double kLongestGradient = 1.0;  // Euclidean norm above which a gradient is scaled down

/// Runs work(i) for i = 0 .. count - 1 on some threads; returns when all is done. Thread n takes n,
/// n + threads, ...
template <class Work>
void share(std::size_t count, int wanted_threads, const Work& work) {
    const auto threads = static_cast<std::size_t>(std::max(1, wanted_threads));
    std::vector<std::jthread> running;
    for (std::size_t first = 0; first < std::min(threads, count); ++first) {
        running.emplace_back([first, threads, count, &work] {
            // Gradients that decay into denormal numbers would slow training down.
            const FlushToZeroScope flush_to_zero;
            for (std::size_t i = first; i < count; i += threads) {
                work(i);
            }
        });
    }
}

// What a gradient is scaled by, clipped by norm: a single batch must not throw the weights far off.
double clipping_of(std::span<const float> gradient) {
    double norm = 0.0;
    for (const float value : gradient) {
        norm += static_cast<double>(value) * static_cast<double>(value);
    }
    norm = std::sqrt(norm);
    return norm > kLongestGradient ? 1.0 / norm : 1.0;
}

// Frames of all chunks together.
double frames_of(const TrainingBatch& batch) {
    return static_cast<double>(batch.steps * batch.chunks);
}

}  // namespace

NetworkDescent::NetworkDescent(models::RecurrentNetwork& network, int threads)
    : network_(network), threads_(threads), adam_(network.parameters().size()) {
    // The shards run in parallel already; BLAS threads on top would only compete.
    openblas_set_num_threads(1);
}

double NetworkDescent::step(double rate,
                            const std::function<TrainingBatch(std::size_t shard)>& draw) {
    // Each shard has its own gradient, loss and count, so threads share nothing.
    std::vector<std::vector<float>> gradients(kShards);
    std::array<double, kShards> losses{};
    std::array<double, kShards> frames{};
    share(kShards, threads_, [&](std::size_t shard) {
        const TrainingBatch batch = draw(shard);
        frames[shard] = frames_of(batch);
        gradients[shard].assign(network_.parameters().size(), 0.0F);
        losses[shard] = gradients_[shard].accumulate(network_, batch, gradients[shard]);
    });
    // Summed in the order of the shards: floating-point sums depend on it.
    double loss = losses[0];
    double all = frames[0];
    for (std::size_t shard = 1; shard < kShards; ++shard) {
        loss += losses[shard];
        all += frames[shard];
        for (std::size_t i = 0; i < gradients[0].size(); ++i) {
            gradients[0][i] += gradients[shard][i];
        }
    }
    // Losses and gradients are sums over frames; the step is on the mean.
    const auto scale = static_cast<float>(1.0 / all);
    for (float& value : gradients[0]) {
        value *= scale;
    }
    adam_.step(gradients[0], rate, network_.parameters(), clipping_of(gradients[0]));
    return loss / all;
}

double NetworkDescent::loss_of(std::span<const TrainingBatch> batches) const {
    std::vector<double> losses(batches.size());
    share(batches.size(), threads_, [&](std::size_t i) {
        // Buffers of its own: batches may be more than shards.
        NetworkGradient gradient;
        losses[i] = gradient.accumulate(network_, batches[i], {});
    });
    double sum = 0.0;
    double frames = 0.0;
    for (std::size_t i = 0; i < batches.size(); ++i) {
        sum += losses[i];
        frames += frames_of(batches[i]);
    }
    return frames > 0.0 ? sum / frames : 0.0;
}

double rate_at(double highest, int step, int steps) {
    // At most 1; the first step is not 0.
    const double warm_up = std::min(1.0, (step + 1.0) / kWarmUpSteps);
    return highest * warm_up * 0.5 * (1.0 + std::cos(std::numbers::pi * step / steps));
}

}  // namespace raks::audio
