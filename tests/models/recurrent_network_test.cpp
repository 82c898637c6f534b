#include "models/recurrent_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "models/dense_product.hpp"
#include "models/gates.hpp"

namespace raks::models {
namespace {

std::vector<float> random_values(std::size_t count, std::uint64_t seed) {
    const CounterRandom random(seed);
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = static_cast<float>(random.normal(i));
    }
    return values;
}

// Not inlined: a product that is rounded by itself, whatever the compiler makes of a multiply-add.
[[gnu::noinline]] float times(float a, float b) { return a * b; }

// The product of a dense layer, output by output.
void add_plainly(std::span<const float> input,
                 const float* weights,
                 std::size_t width,
                 std::vector<float>& sums) {
    for (std::size_t i = 0; i < input.size(); ++i) {
        for (std::size_t j = 0; j < width; ++j) {
            sums[j] += times(input[i], weights[i * width + j]);
        }
    }
}

// Widths that need every size of block, and what is left beside them.
TEST(DenseProduct, has_the_bits_of_a_plain_loop) {
    for (const std::size_t width : {1U, 3U, 8U, 17U, 40U, 96U, 144U, 192U, 203U, 384U}) {
        for (const std::size_t inputs : {0U, 1U, 2U, 54U, 64U}) {
            const std::vector<float> input = random_values(inputs, 1);
            const std::vector<float> weights = random_values(inputs * width, 2);
            std::vector<float> sums = random_values(width, 3);
            std::vector<float> expected = sums;
            add_plainly(input, weights.data(), width, expected);
            add_product(input.data(), inputs, weights.data(), width, sums.data());
            EXPECT_EQ(sums, expected) << inputs << " x " << width;
        }
    }
}

// One gated unit after the other, by the formula of the header.
std::vector<float> next_hidden(const RecurrentNetwork& network,
                               std::span<const float> input,
                               const std::vector<float>& hidden) {
    const RecurrentNetwork::Layer& layer = network.layers().front();
    const float* const parameters = network.parameters().data();
    const std::size_t units = layer.units;
    std::vector<float> x(parameters + layer.biases, parameters + layer.biases + 3 * units);
    std::vector<float> h(3 * units);
    std::copy_n(parameters + layer.candidate_biases, units, &h[2 * units]);
    add_plainly(input, parameters + layer.input_weights, 3 * units, x);
    add_plainly(hidden, parameters + layer.recurrent_weights, 3 * units, h);
    std::vector<float> next(units);
    for (std::size_t i = 0; i < units; ++i) {
        const float reset = logistic(x[i] + h[i]);
        const float keep = logistic(x[units + i] + h[units + i]);
        const float candidate = fast_tanh(x[2 * units + i] + times(reset, h[2 * units + i]));
        next[i] = times(1.0F - keep, candidate) + times(keep, hidden[i]);
    }
    return next;
}

// Weights large enough that some gates reach the ends of their range.
TEST(RecurrentNetwork, has_the_bits_of_one_unit_after_the_other) {
    for (const std::size_t units : {4U, 17U, 64U, 128U}) {
        RecurrentNetwork network({.inputs = 54, .units = units, .layers = 1, .outputs = 3});
        const std::vector<float> weights = random_values(network.parameters().size(), units);
        std::transform(weights.begin(), weights.end(), network.parameters().begin(), [](float w) {
            return 2.0F * w;
        });
        RecurrentStream stream;
        std::vector<float> hidden(units);
        for (std::uint64_t frame = 0; frame < 20; ++frame) {
            const std::vector<float> input = random_values(54, 100 + frame);
            hidden = next_hidden(network, input, hidden);
            const auto out = network.parameters().subspan(network.output_weights());
            std::vector<float> expected(out.end() - 3, out.end());
            add_plainly(hidden, out.data(), 3, expected);
            const auto logits = stream.next(network, input);
            ASSERT_TRUE(std::equal(expected.begin(), expected.end(), logits.begin()))
                << units << " units, frame " << frame;
        }
    }
}

}  // namespace
}  // namespace raks::models
