// The trainer of the beat network, against finite differences and against the listener.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "audio/beat/network/beat_network.hpp"
#include "base/random.hpp"
#include "training/networks/network_gradient.hpp"

namespace raks::audio {
namespace {

BeatNetwork small_network() {
    BeatNetwork network(4, 2, 0);
    initialize(network, 3);
    return network;
}

TrainingBatch random_batch(std::size_t steps, std::size_t chunks) {
    const CounterRandom random(11);
    TrainingBatch batch{steps, chunks, {}, {}, {}};
    std::uint64_t i = 0;
    for (std::size_t frame = 0; frame < steps * chunks; ++frame) {
        for (std::size_t input = 0; input < NetworkInput::kSize; ++input) {
            batch.inputs.push_back(static_cast<float>(random.normal(i++)));
        }
        for (std::size_t output = 0; output < BeatNetwork::kOutputs; ++output) {
            batch.targets.push_back(static_cast<float>(random.uniform(i++)));
            batch.weights.push_back(static_cast<float>(0.5 + random.uniform(i++)));
        }
    }
    return batch;
}

class NetworkTrainingLoss : public testing::TestWithParam<TrainingBatch::Loss> {};

TEST_P(NetworkTrainingLoss, gradient_is_that_of_finite_differences) {
    BeatNetwork network = small_network();
    TrainingBatch batch = random_batch(7, 3);
    batch.loss = GetParam();
    NetworkGradient gradient;
    std::vector<float> analytic(network.parameters().size());
    gradient.accumulate(network, batch, analytic);
    constexpr float kStep = 3e-3F;
    for (std::size_t i = 0; i < analytic.size(); i += 13) {
        const float was = network.parameters()[i];
        network.parameters()[i] = was + kStep;
        const double above = gradient.accumulate(network, batch, {});
        network.parameters()[i] = was - kStep;
        const double below = gradient.accumulate(network, batch, {});
        network.parameters()[i] = was;
        const double numeric = (above - below) / (2.0 * static_cast<double>(kStep));
        EXPECT_NEAR(static_cast<double>(analytic[i]), numeric, 2e-3 + 0.01 * std::abs(numeric))
            << "parameter " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Both,
                         NetworkTrainingLoss,
                         testing::Values(TrainingBatch::Loss::logistic,
                                         TrainingBatch::Loss::softmax));

TEST(NetworkTraining, a_choice_among_equals_costs_the_logarithm_of_their_number) {
    const models::RecurrentNetwork network(
        {NetworkInput::kSize, 4, 1, 5});  // all 0: it knows nothing
    TrainingBatch batch{2, 1, std::vector<float>(2 * NetworkInput::kSize), {}, {}};
    batch.loss = TrainingBatch::Loss::softmax;
    batch.targets = {0, 1, 0, 0, 0, 0, 0, 0, 0.5F, 0.5F};
    batch.weights.assign(10, 3.0F);
    NetworkGradient gradient;
    EXPECT_NEAR(gradient.accumulate(network, batch, {}), 2 * 3.0 * std::log(5.0), 1e-5);
}

TEST(NetworkTraining, listener_hears_what_the_trainer_computes) {
    // A loss of targets 0 and weights 1 in one output is -log(1 - p): p of the listener gives it.
    const auto network = std::make_shared<BeatNetwork>(small_network());
    TrainingBatch batch = random_batch(20, 1);
    std::fill(batch.targets.begin(), batch.targets.end(), 0.0F);
    std::fill(batch.weights.begin(), batch.weights.end(), 1.0F);
    BeatNetworkStream listener(network);
    double expected = 0.0;
    for (std::size_t t = 0; t < batch.steps; ++t) {
        NetworkInput::Frame frame{};
        std::copy_n(batch.inputs.begin() + static_cast<std::ptrdiff_t>(t * frame.size()),
                    frame.size(),
                    frame.begin());
        const BeatEvidence heard = listener.next(frame);
        for (const float p : {heard.beat, heard.downbeat, heard.half, heard.third}) {
            expected -= std::log(1.0 - static_cast<double>(p));
        }
    }
    NetworkGradient gradient;
    EXPECT_NEAR(gradient.accumulate(*network, batch, {}), expected, 1e-4 * expected);
}

}  // namespace
}  // namespace raks::audio
