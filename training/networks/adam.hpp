#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace raks::audio {

/// Constants of Adam; beta 1, beta 2 and epsilon of the paper.
struct AdamConstants {
    double mean_decay = 0.9;
    double square_decay = 0.999;
    double epsilon = 1e-8;
    /// Where the bias of the running means, which start at 0, is corrected. of_means: each by
    /// itself, the algorithm; of_rate: both in one factor, so that epsilon stands beside an
    /// uncorrected root (both in Kingma, Ba 2015, section 2).
    enum class Correction : std::uint8_t { of_means, of_rate };
    Correction correction = Correction::of_means;
};

/// Adam (Kingma, Ba 2015): steps down the gradient of a list of numbers. `Number`: their type and
/// that of the running means; `Computed`: in which a step is computed.
/// Threads: one. Real-time: no.
template <typename Number, typename Computed = double>
class Adam {
 public:
    /// `count`: of the numbers.
    explicit Adam(std::size_t count, const AdamConstants& constants = {})
        : constants_(constants), mean_(count), square_(count) {}

    /// One step against `scale` times `gradient` at the given rate, in place.
    void step(std::span<const Number> gradient,
              double rate,
              std::span<Number> numbers,
              Computed scale = 1) {
        const auto keep_mean = static_cast<Computed>(constants_.mean_decay);
        const auto keep_square = static_cast<Computed>(constants_.square_decay);
        const auto epsilon = static_cast<Computed>(constants_.epsilon);
        ++steps_;
        const double mean_told = 1.0 - std::pow(constants_.mean_decay, static_cast<double>(steps_));
        const double square_told =
            1.0 - std::pow(constants_.square_decay, static_cast<double>(steps_));
        auto size = static_cast<Computed>(rate);
        auto mean_share = static_cast<Computed>(mean_told);
        auto square_share = static_cast<Computed>(square_told);
        if (constants_.correction == AdamConstants::Correction::of_rate) {
            size *= static_cast<Computed>(std::sqrt(square_told) / mean_told);
            mean_share = square_share = 1;
        }
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const Computed slope = scale * static_cast<Computed>(gradient[i]);
            const Computed mean =
                keep_mean * static_cast<Computed>(mean_[i]) + (1 - keep_mean) * slope;
            const Computed square =
                keep_square * static_cast<Computed>(square_[i]) + (1 - keep_square) * slope * slope;
            mean_[i] = static_cast<Number>(mean);
            square_[i] = static_cast<Number>(square);
            numbers[i] -= static_cast<Number>(size * (mean / mean_share) /
                                              (std::sqrt(square / square_share) + epsilon));
        }
    }

 private:
    AdamConstants constants_;
    std::vector<Number> mean_;
    std::vector<Number> square_;
    std::int64_t steps_ = 0;
};

}  // namespace raks::audio
