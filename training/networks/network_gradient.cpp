#include "training/networks/network_gradient.hpp"

#include <cblas.h>
#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "base/simd_clones.hpp"
#include "models/gates.hpp"

namespace raks::audio {
namespace {

/// How B enters a product.
enum class Right { plain, transposed };

/// C (m x n) = A (m x k) B (k x n, or its transpose) + beta C, row-major.
void multiply(std::size_t m,
              std::size_t n,
              std::size_t k,
              const float* a,
              const float* b,
              Right right,
              float beta,
              float* c) {
    const auto size = [](std::size_t value) { return static_cast<blasint>(value); };
    const bool is_plain = right == Right::plain;
    cblas_sgemm(CblasRowMajor,
                CblasNoTrans,
                is_plain ? CblasNoTrans : CblasTrans,
                size(m),
                size(n),
                size(k),
                1.0F,
                a,
                size(k),
                b,
                size(is_plain ? n : k),
                beta,
                c,
                size(n));
}

/// C (m x n) += A^T (A is k x m) B (k x n).
void add_outer(
    std::size_t m, std::size_t n, std::size_t k, const float* a, const float* b, float* c) {
    const auto size = [](std::size_t value) { return static_cast<blasint>(value); };
    cblas_sgemm(CblasRowMajor,
                CblasTrans,
                CblasNoTrans,
                size(m),
                size(n),
                size(k),
                1.0F,
                a,
                size(m),
                b,
                size(n),
                1.0F,
                c,
                size(n));
}

// Sums over rows: the gradient of a bias, which every frame shares.
void add_columns(std::size_t rows, std::size_t width, const float* values, float* sums) {
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t i = 0; i < width; ++i) {
            sums[i] += values[row * width + i];
        }
    }
}

/// Forward step of one chunk: gates and next hidden values. Everything that the backward pass needs
/// is kept. `projected`: from the input, with biases; `recurrent`: from the hidden values.
RAKS_SIMD_CLONES void open_gates(const float* __restrict projected,
                                 const float* __restrict recurrent,
                                 const float* __restrict candidate_biases,
                                 std::size_t units,
                                 const float* __restrict before,
                                 float* __restrict reset,
                                 float* __restrict keep,
                                 float* __restrict candidate,
                                 float* __restrict product,
                                 float* __restrict after) {
    for (std::size_t i = 0; i < units; ++i) {
        // h Un + cn of the candidate, kept without its factor r, because the gradient of r needs
        // it.
        product[i] = recurrent[2 * units + i] + candidate_biases[i];
        reset[i] = models::logistic(projected[i] + recurrent[i]);
        keep[i] = models::logistic(projected[units + i] + recurrent[units + i]);
        candidate[i] = models::fast_tanh(projected[2 * units + i] + reset[i] * product[i]);
        after[i] = (1.0F - keep[i]) * candidate[i] + keep[i] * before[i];
    }
}

/// Backward step of open_gates. `later` enters as the gradient by the hidden values after the step,
/// through later steps; it leaves as the part of the gradient by those before it that does not pass
/// through the recurrent weights (the rest is added by the caller).
RAKS_SIMD_CLONES void close_gates(const float* __restrict reset,
                                  const float* __restrict keep,
                                  const float* __restrict candidate,
                                  const float* __restrict product,
                                  const float* __restrict before,
                                  const float* __restrict from_above,
                                  std::size_t units,
                                  float* __restrict projected,
                                  float* __restrict recurrent,
                                  float* __restrict later) {
    for (std::size_t i = 0; i < units; ++i) {
        // dh: gradient by the new hidden value; dn, dz, dr: by the values before tanh and logistic.
        const float r = reset[i];
        const float z = keep[i];
        const float n = candidate[i];
        const float dh = from_above[i] + later[i];
        const float dn = dh * (1.0F - z) * (1.0F - n * n);
        const float dz = dh * (before[i] - n) * z * (1.0F - z);
        const float dr = dn * product[i] * r * (1.0F - r);
        // r and z get both sums unchanged, so both products have the same gradient there; in the
        // candidate the recurrent product is multiplied by r first.
        projected[i] = recurrent[i] = dr;
        projected[units + i] = recurrent[units + i] = dz;
        projected[2 * units + i] = dn;
        recurrent[2 * units + i] = dn * r;
        // h' = (1 - z) n + z h: the direct path.
        later[i] = dh * z;
    }
}

/// Weighted binary cross-entropy of all outputs. `logits` become the gradient by the logits.
double logistic_loss(const TrainingBatch& batch, std::span<float> logits) {
    double loss = 0.0;
    for (std::size_t i = 0; i < logits.size(); ++i) {
        const double logit = static_cast<double>(logits[i]);
        const double target = static_cast<double>(batch.targets[i]);
        const double weight = static_cast<double>(batch.weights[i]);
        const double odds = std::exp(-std::abs(logit));  // of the less likely
        // log(1 + e^l) - t l, without overflow.
        loss += weight * (std::max(logit, 0.0) + std::log1p(odds) - target * logit);
        // sigmoid(logit), in the form that does not overflow.
        const double probability = (logit >= 0.0 ? 1.0 : odds) / (1.0 + odds);
        logits[i] = static_cast<float>(weight * (probability - target));
    }
    return loss;
}

// Weighted cross-entropy of one choice a frame. `logits` become the gradient by the logits.
double softmax_loss(const TrainingBatch& batch, std::size_t outputs, std::span<float> logits) {
    double loss = 0.0;
    for (std::size_t from = 0; from < logits.size(); from += outputs) {
        const std::span<float> frame = logits.subspan(from, outputs);
        // ln sum exp, with the highest logit taken out against overflow.
        const double highest = static_cast<double>(*std::max_element(frame.begin(), frame.end()));
        double sum = 0.0;
        for (const float logit : frame) {
            sum += std::exp(static_cast<double>(logit) - highest);
        }
        const double all = highest + std::log(sum);
        double weight = 0.0;  // of the frame: that of all its targets
        for (std::size_t i = 0; i < outputs; ++i) {
            const double share = static_cast<double>(batch.weights[from + i]) *
                                 static_cast<double>(batch.targets[from + i]);
            loss += share * (all - static_cast<double>(frame[i]));
            weight += share;
        }
        // Softmax minus target, times weights. In a second loop, because it needs the frame's whole
        // weight.
        for (std::size_t i = 0; i < outputs; ++i) {
            const double share = static_cast<double>(batch.weights[from + i]) *
                                 static_cast<double>(batch.targets[from + i]);
            frame[i] =
                static_cast<float>(weight * std::exp(static_cast<double>(frame[i]) - all) - share);
        }
    }
    return loss;
}

}  // namespace

void NetworkGradient::forward(const models::RecurrentNetwork& network,
                              std::size_t index,
                              const float* below,
                              const TrainingBatch& batch) {
    const models::RecurrentNetwork::Layer& layer = network.layers()[index];
    LayerTrace& trace = traces_[index];
    const float* const parameters = network.parameters().data();
    const std::size_t frames = batch.steps * batch.chunks;
    const std::size_t units = layer.units;
    const std::size_t width = 3 * units;
    // Rows are frames: t * chunks + chunk. `hidden` has one step more, the zero state before t = 0.
    trace.projected.resize(frames * width);
    trace.recurrent.resize(frames * width);
    for (auto* values : {&trace.reset, &trace.keep, &trace.candidate, &trace.product}) {
        values->resize(frames * units);
    }
    trace.hidden.assign((frames + batch.chunks) * units, 0.0F);
    // The input's products do not depend on the hidden values: one matrix product for all frames.
    // The biases are its start value.
    for (std::size_t frame = 0; frame < frames; ++frame) {
        std::copy_n(parameters + layer.biases, width, &trace.projected[frame * width]);
    }
    multiply(frames,
             width,
             layer.inputs,
             below,
             parameters + layer.input_weights,
             Right::plain,
             1.0F,
             trace.projected.data());
    // Step by step, because each needs the hidden values of the one before; all chunks at once.
    for (std::size_t t = 0; t < batch.steps; ++t) {
        float* const recurrent = &trace.recurrent[t * batch.chunks * width];
        const float* const before = &trace.hidden[t * batch.chunks * units];
        multiply(batch.chunks,
                 width,
                 units,
                 before,
                 parameters + layer.recurrent_weights,
                 Right::plain,
                 0.0F,
                 recurrent);
        for (std::size_t chunk = 0; chunk < batch.chunks; ++chunk) {
            const std::size_t frame = t * batch.chunks + chunk;
            const std::size_t at = frame * units;
            open_gates(&trace.projected[frame * width],
                       recurrent + chunk * width,
                       parameters + layer.candidate_biases,
                       units,
                       before + chunk * units,
                       &trace.reset[at],
                       &trace.keep[at],
                       &trace.candidate[at],
                       &trace.product[at],
                       &trace.hidden[(frame + batch.chunks) * units]);
        }
    }
}

// Logits of all frames, written to output_gradient_, where the loss turns them into gradients.
void NetworkGradient::forward_outputs(const models::RecurrentNetwork& network,
                                      const TrainingBatch& batch) {
    const std::size_t frames = batch.steps * batch.chunks;
    const std::size_t outputs = network.outputs();
    const float* const parameters = network.parameters().data();
    output_gradient_.resize(frames * outputs);
    for (std::size_t frame = 0; frame < frames; ++frame) {
        std::copy_n(
            parameters + network.output_biases(), outputs, &output_gradient_[frame * outputs]);
    }
    multiply(frames,
             outputs,
             network.units(),
             &traces_.back().hidden[batch.chunks * network.units()],
             parameters + network.output_weights(),
             Right::plain,
             1.0F,
             output_gradient_.data());
}

void NetworkGradient::backward(const models::RecurrentNetwork& network,
                               std::size_t index,
                               const float* below,
                               const TrainingBatch& batch,
                               std::vector<float>& from_above,
                               std::span<float> gradient) {
    const models::RecurrentNetwork::Layer& layer = network.layers()[index];
    LayerTrace& trace = traces_[index];
    const float* const parameters = network.parameters().data();
    const std::size_t units = layer.units;
    const std::size_t width = 3 * units;
    // Gradient by hidden values, from step t + 1.
    std::vector<float> later(batch.chunks * units, 0.0F);
    // Backwards in time. `projected` and `recurrent` are overwritten by their gradients.
    for (std::size_t t = batch.steps; t-- > 0;) {
        const float* const before = &trace.hidden[t * batch.chunks * units];
        for (std::size_t chunk = 0; chunk < batch.chunks; ++chunk) {
            const std::size_t frame = t * batch.chunks + chunk;
            const std::size_t at = frame * units;
            close_gates(&trace.reset[at],
                        &trace.keep[at],
                        &trace.candidate[at],
                        &trace.product[at],
                        before + chunk * units,
                        &from_above[at],
                        units,
                        &trace.projected[frame * width],
                        &trace.recurrent[frame * width],
                        &later[chunk * units]);
        }
        // The path through the recurrent weights: later += recurrent gradient x U^T.
        multiply(batch.chunks,
                 units,
                 width,
                 &trace.recurrent[t * batch.chunks * width],
                 parameters + layer.recurrent_weights,
                 Right::transposed,
                 1.0F,
                 later.data());
    }
    const std::size_t frames = batch.steps * batch.chunks;
    // Weight gradients: sums over all frames of the outer product of inputs and gradients.
    add_outer(
        layer.inputs, width, frames, below, trace.projected.data(), &gradient[layer.input_weights]);
    add_outer(units,
              width,
              frames,
              trace.hidden.data(),
              trace.recurrent.data(),
              &gradient[layer.recurrent_weights]);
    add_columns(frames, width, trace.projected.data(), &gradient[layer.biases]);
    // Only the candidate has a bias within the recurrent product (c).
    std::vector<float> sums(width, 0.0F);
    add_columns(frames, width, trace.recurrent.data(), sums.data());
    for (std::size_t i = 0; i < units; ++i) {
        gradient[layer.candidate_biases + i] += sums[2 * units + i];
    }
    // The layer below receives this layer's gradient by its inputs; the lowest has none.
    if (index > 0) {
        from_above.resize(frames * layer.inputs);
        multiply(frames,
                 layer.inputs,
                 width,
                 trace.projected.data(),
                 parameters + layer.input_weights,
                 Right::transposed,
                 0.0F,
                 from_above.data());
    }
}

double NetworkGradient::accumulate(const models::RecurrentNetwork& network,
                                   const TrainingBatch& batch,
                                   std::span<float> gradient) {
    const std::size_t layers = network.layers().size();
    traces_.resize(layers);
    // Inputs of a layer: the batch's, or the hidden values of the layer below from t = 0 on.
    const auto below = [&](std::size_t layer) {
        return layer == 0 ? batch.inputs.data()
                          : &traces_[layer - 1].hidden[batch.chunks * network.units()];
    };
    for (std::size_t layer = 0; layer < layers; ++layer) {
        forward(network, layer, below(layer), batch);
    }
    forward_outputs(network, batch);
    const double loss = batch.loss == TrainingBatch::Loss::logistic
                            ? logistic_loss(batch, output_gradient_)
                            : softmax_loss(batch, network.outputs(), output_gradient_);
    // Loss alone: for validation.
    if (gradient.empty()) {
        return loss;
    }
    const std::size_t frames = batch.steps * batch.chunks;
    const std::size_t outputs = network.outputs();
    // Gradient of the output layer, then its way down.
    const float* const top = &traces_.back().hidden[batch.chunks * network.units()];
    add_outer(network.units(),
              outputs,
              frames,
              top,
              output_gradient_.data(),
              &gradient[network.output_weights()]);
    add_columns(frames, outputs, output_gradient_.data(), &gradient[network.output_biases()]);
    from_above_.resize(frames * network.units());
    multiply(frames,
             network.units(),
             outputs,
             output_gradient_.data(),
             network.parameters().data() + network.output_weights(),
             Right::transposed,
             0.0F,
             from_above_.data());
    for (std::size_t layer = layers; layer-- > 0;) {
        backward(network, layer, below(layer), batch, from_above_, gradient);
    }
    return loss;
}

// One draw a parameter, by its index: the shape decides what each gets.
void initialize(models::RecurrentNetwork& network, std::uint64_t seed) {
    const CounterRandom random(seed);
    const double span = std::sqrt(1.0 / static_cast<double>(network.units()));
    const std::span<float> parameters = network.parameters();
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        parameters[i] = static_cast<float>(span * (2.0 * random.uniform(i) - 1.0));
    }
}

}  // namespace raks::audio
