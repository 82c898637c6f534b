#include "training/genre/pattern_trainer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/assert.hpp"
#include "base/dice.hpp"
#include "training/networks/adam.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kInputs = PatternNetwork::kInputs;
constexpr int kBatch = 64;                // windows of a batch
constexpr float kSmoothing = 0.05F;       // of the labels: this share is spread over all classes
constexpr double kInputNoise = 0.25;      // uniform noise on standardized inputs, at most
constexpr double kLeastDeviation = 1e-3;  // keeps constant features from a division by 0

/// Mean and deviation of all features over all windows. Every piece weighs alike, however many
/// windows it has.
void measure_inputs(std::span<const PieceFeatures* const> pieces, PatternNetwork& network) {
    std::array<double, kInputs> sum{};
    std::array<double, kInputs> squares{};
    double weight = 0.0;
    for (const PieceFeatures* piece : pieces) {
        for (const WindowFeatures& window : piece->windows) {
            const double share = 1.0 / static_cast<double>(piece->windows.size());
            weight += share;
            for (std::size_t i = 0; i < kInputs; ++i) {
                // The last input is the logarithm of the window's length.
                const double value = i < window.features.size()
                                         ? static_cast<double>(window.features[i])
                                         : std::log(window.segments);
                sum[i] += share * value;
                squares[i] += share * value * value;
            }
        }
    }
    network.mean.resize(kInputs);
    network.deviation.resize(kInputs);
    for (std::size_t i = 0; i < kInputs; ++i) {
        const double mean = sum[i] / std::max(weight, 1e-9);
        const double variance = squares[i] / std::max(weight, 1e-9) - mean * mean;
        network.mean[i] = static_cast<float>(mean);
        network.deviation[i] =
            static_cast<float>(std::max(kLeastDeviation, std::sqrt(std::max(0.0, variance))));
    }
}

/// A list of weights with its gradient and Adam. The first weights are drawn from a normal
/// distribution of this deviation.
class Weights {
 public:
    Weights(std::vector<float>& values, double deviation, Dice& dice)
        : values_(values), gradient_(values.size()), adam_(values.size(), kConstants) {
        for (float& value : values_) {
            value = static_cast<float>(dice.normal(deviation));
        }
    }
    [[nodiscard]] std::span<float> gradient() { return gradient_; }

    /// One Adam step on the mean gradient of a batch plus `decay` times the weights (L2); clears
    /// the gradient.
    void step(double rate, double decay) {
        const auto pull = static_cast<float>(decay);
        for (std::size_t i = 0; i < gradient_.size(); ++i) {
            gradient_[i] = gradient_[i] / kBatch + pull * values_[i];
        }
        adam_.step(gradient_, rate, values_);
        std::fill(gradient_.begin(), gradient_.end(), 0.0F);
    }

 private:
    static constexpr AdamConstants kConstants = {.epsilon = 1e-7,
                                                 .correction = AdamConstants::Correction::of_rate};

    std::vector<float>& values_;
    std::vector<float> gradient_;
    Adam<float, float> adam_;
};

/// 1 for the inputs of these parts and for the window's length (the last input), 0 for the others.
std::array<float, kInputs> mask_of(const std::vector<std::string_view>& parts) {
    std::array<float, kInputs> mask{};
    mask.back() = 1.0F;
    std::size_t at = 0;
    for (const BarPatterns::Part& part : BarPatterns::kParts) {
        const bool is_used =
            parts.empty() || std::find(parts.begin(), parts.end(), part.name) != parts.end();
        for (int i = 0; i < part.size; ++i) {
            mask[at++] = is_used ? 1.0F : 0.0F;
        }
    }
    return mask;
}

/// Draws a class uniformly, then recorded or written by the plan's share, then a piece and one of
/// its windows uniformly.
class WindowDraw {
 public:
    WindowDraw(std::span<const PieceFeatures* const> pieces,
               std::span<const std::size_t> classes,
               std::size_t class_count,
               double recorded_share)
        : recorded_(class_count), written_(class_count), recorded_share_(recorded_share) {
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            if (!pieces[i]->windows.empty()) {
                (pieces[i]->is_recorded() ? recorded_ : written_)[classes[i]].push_back(pieces[i]);
            }
        }
        // Only classes with windows are drawn.
        for (std::size_t c = 0; c < class_count; ++c) {
            if (!recorded_[c].empty() || !written_[c].empty()) {
                learnt_.push_back(c);
            }
        }
    }
    [[nodiscard]] bool is_empty() const { return learnt_.empty(); }

    struct Drawn {
        const WindowFeatures* window;
        std::size_t class_number;
    };
    Drawn draw(Dice& dice) const {
        const std::size_t c = dice.pick<std::size_t>(learnt_);
        const bool is_recorded =
            written_[c].empty() || (!recorded_[c].empty() && dice.chance(recorded_share_));
        const auto& from = is_recorded ? recorded_[c] : written_[c];
        const PieceFeatures* piece = dice.pick<const PieceFeatures*>(from);
        return {&dice.pick<WindowFeatures>(piece->windows), c};
    }

 private:
    std::vector<std::vector<const PieceFeatures*>> recorded_;
    std::vector<std::vector<const PieceFeatures*>> written_;
    std::vector<std::size_t> learnt_;
    double recorded_share_;
};

/// One network and the state of its training. With 0 units the inputs feed the outputs directly.
class Descent {
 public:
    Descent(PatternNetwork& network, const PatternTrainingPlan& plan, Dice& dice)
        : network_(network),
          plan_(plan),
          mask_(mask_of(plan.parts)),
          dice_(dice),
          hidden_weights_(network.hidden_weights, std::sqrt(1.0 / kInputs), dice),
          hidden_bias_(network.hidden_bias, 0.0, dice),
          output_weights_(
              network.output_weights,
              network.units > 0 ? std::sqrt(1.0 / static_cast<double>(network.units)) : 0.0,
              dice),
          output_bias_(network.output_bias, 0.0, dice),
          hidden_(network.last_inputs()),
          hidden_slope_(network.last_inputs()),
          logs_(network.classes) {
        // Masked inputs get weight 0 and keep it: their input is 0, so is their gradient.
        silence(network_.hidden_weights);
        if (network_.units == 0) {
            silence(network_.output_weights);
        }
    }

    // Adds the gradient of one window.
    void learn(const WindowDraw::Drawn& drawn) {
        std::array<float, kInputs> inputs{};
        network_.standardize(drawn.window->features, drawn.window->segments, inputs);
        // Inverted dropout: the inputs kept are scaled up, so that the network is used without a
        // change.
        const auto keep = static_cast<float>(1.0 / (1.0 - plan_.input_dropout));
        for (std::size_t i = 0; i < kInputs; ++i) {
            const bool is_dropped = mask_[i] == 0.0F || dice_.chance(plan_.input_dropout);
            inputs[i] = is_dropped ? 0.0F : keep * (inputs[i] + noise());
        }
        if (network_.units == 0) {
            std::copy(inputs.begin(), inputs.end(), hidden_.begin());
        } else {
            hide(inputs);
        }
        // Forward through the outputs, then the gradients.
        judge();
        backward(inputs, drawn.class_number);
    }

    void step(double rate) {
        hidden_weights_.step(rate, plan_.weight_decay);
        hidden_bias_.step(rate, 0.0);
        output_weights_.step(rate, plan_.weight_decay);
        output_bias_.step(rate, 0.0);
    }

 private:
    float noise() { return static_cast<float>(dice_.uniform(-kInputNoise, kInputNoise)); }

    /// Sets the weights of masked inputs to 0. Rows are kInputs long.
    void silence(std::vector<float>& weights) const {
        for (std::size_t i = 0; i < weights.size(); ++i) {
            weights[i] *= mask_[i % kInputs];
        }
    }

    // Hidden units: rectified linear, with inverted dropout.
    void hide(std::span<const float, kInputs> inputs) {
        const auto keep = static_cast<float>(1.0 / (1.0 - plan_.hidden_dropout));
        for (std::size_t unit = 0; unit < network_.units; ++unit) {
            const float* const row = network_.hidden_weights.data() + unit * kInputs;
            float sum = network_.hidden_bias[unit];
            for (std::size_t i = 0; i < kInputs; ++i) {
                sum += row[i] * inputs[i];
            }
            const bool is_dropped = dice_.chance(plan_.hidden_dropout);
            hidden_[unit] = sum <= 0.0F || is_dropped ? 0.0F : keep * sum;
        }
    }

    // Output log-probabilities, by softmax.
    void judge() {
        for (std::size_t c = 0; c < network_.classes; ++c) {
            const float* const row = network_.output_weights.data() + c * hidden_.size();
            float sum = network_.output_bias[c];
            for (std::size_t i = 0; i < hidden_.size(); ++i) {
                sum += row[i] * hidden_[i];
            }
            logs_[c] = sum;
        }
        normalize_logs(logs_);
    }

    // Cross-entropy against the smoothed label: the slope by a logit is probability minus target.
    void backward(std::span<const float, kInputs> inputs, std::size_t truth) {
        std::fill(hidden_slope_.begin(), hidden_slope_.end(), 0.0F);
        const float rest = kSmoothing / static_cast<float>(network_.classes);
        for (std::size_t c = 0; c < network_.classes; ++c) {
            const float wanted = rest + (c == truth ? 1.0F - kSmoothing : 0.0F);
            const float slope = std::exp(logs_[c]) - wanted;
            output_bias_.gradient()[c] += slope;
            float* const row = output_weights_.gradient().data() + c * hidden_.size();
            const float* const weights = network_.output_weights.data() + c * hidden_.size();
            for (std::size_t i = 0; i < hidden_.size(); ++i) {
                row[i] += slope * hidden_[i];
                hidden_slope_[i] += slope * weights[i];
            }
        }
        // A unit that is 0 (inactive or dropped) passes no gradient.
        for (std::size_t unit = 0; unit < network_.units; ++unit) {
            if (hidden_[unit] <= 0.0F) {
                continue;
            }
            hidden_bias_.gradient()[unit] += hidden_slope_[unit];
            float* const row = hidden_weights_.gradient().data() + unit * kInputs;
            for (std::size_t i = 0; i < kInputs; ++i) {
                row[i] += hidden_slope_[unit] * inputs[i];
            }
        }
    }

    PatternNetwork& network_;
    const PatternTrainingPlan& plan_;
    std::array<float, kInputs> mask_;
    Dice& dice_;
    Weights hidden_weights_;
    Weights hidden_bias_;
    Weights output_weights_;
    Weights output_bias_;
    std::vector<float> hidden_;
    std::vector<float> hidden_slope_;
    std::vector<float> logs_;
};

}  // namespace

// Features over the bar and the beat, with the default hidden layer.
PatternTrainingPlan rhythm_training() {
    PatternTrainingPlan plan;
    plan.parts = {"beat", "series", "bar", "phases", "three", "swing", "pulse", "tempo", "rhythms"};
    return plan;
}

// Spectrum and onset shares: linear, with strong decay and no dropout.
PatternTrainingPlan sound_training() {
    PatternTrainingPlan plan;
    plan.parts = {"shape", "spread", "onsets", "swing"};
    plan.units = 0;
    plan.steps = 1'500;
    plan.rate = 1e-2;
    plan.weight_decay = 0.06;
    plan.input_dropout = 0.0;
    return plan;
}

PatternNetwork train_patterns(std::span<const PieceFeatures* const> pieces,
                              std::span<const std::size_t> classes,
                              std::size_t class_count,
                              const PatternTrainingPlan& plan) {
    RAKS_ASSERT(pieces.size() == classes.size());
    PatternNetwork network;
    network.units = static_cast<std::size_t>(plan.units);
    network.classes = class_count;
    network.hidden_weights.resize(network.units * kInputs);
    network.hidden_bias.resize(network.units);
    network.output_weights.resize(class_count * network.last_inputs());
    network.output_bias.resize(class_count);
    // Standardization comes first: learn() uses it.
    measure_inputs(pieces, network);
    Dice dice(plan.seed, 77);
    Descent descent(network, plan, dice);
    const WindowDraw draw(pieces, classes, class_count, plan.recorded_share);
    for (int step = 1; step <= plan.steps && !draw.is_empty(); ++step) {
        for (int i = 0; i < kBatch; ++i) {
            descent.learn(draw.draw(dice));
        }
        // Cosine schedule from the full rate to 2 % of it.
        const double share = static_cast<double>(step) / plan.steps;
        descent.step(plan.rate * (0.02 + 0.98 * 0.5 * (1.0 + std::cos(M_PI * share))));
    }
    return network;
}

}  // namespace raks::audio
