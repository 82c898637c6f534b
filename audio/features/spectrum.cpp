#include "audio/features/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/assert.hpp"
#include "base/simd_lanes.hpp"

namespace raks::audio {

namespace {

RAKS_SIMD_CLONES void multiply(const float* a,
                               const float* b,
                               std::size_t count,
                               float* __restrict product) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        product[i] = a[i] * b[i];
    }
}

RAKS_SIMD_CLONES void take_roots(const float* values,
                                 std::size_t count,
                                 float* __restrict roots) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        roots[i] = std::sqrt(values[i]);
    }
}

}  // namespace

PowerSpectrum::PowerSpectrum(std::vector<float> window, int fft_size)
    : window_(std::move(window)),
      samples_(static_cast<std::size_t>(fft_size)),
      power_(samples_.size() / 2 + 1),
      magnitudes_(power_.size()),
      transform_(samples_.size()) {}

std::span<const float> PowerSpectrum::compute(std::span<const float> samples) noexcept
    RAKS_NONBLOCKING {
    RAKS_ASSERT(samples.size() == window_.size());
    multiply(samples.data(), window_.data(), samples.size(), samples_.data());
    transform_.power_spectrum(samples_, power_);
    return power_;
}

std::span<const float> PowerSpectrum::compute_magnitudes(std::span<const float> samples) noexcept
    RAKS_NONBLOCKING {
    take_roots(compute(samples).data(), power_.size(), magnitudes_.data());
    return magnitudes_;
}

namespace {

// constant - amplitude x cosine over one period; both ends are equal.
std::vector<float> cosine_window(int size, double constant, double amplitude) {
    std::vector<float> window(static_cast<std::size_t>(size));
    for (std::size_t i = 0; i < window.size(); ++i) {
        const double angle = 2.0 * M_PI * static_cast<double>(i) / (size - 1);
        window[i] = static_cast<float>(constant - amplitude * std::cos(angle));
    }
    return window;
}

}  // namespace

std::vector<float> hann_window(int size) { return cosine_window(size, 0.5, 0.5); }
std::vector<float> hamming_window(int size) { return cosine_window(size, 0.54, 0.46); }

namespace {

// HTK's mel scale and its inverse.
double mel_of(double hertz) { return 1127.0 * std::log(1.0 + hertz / 700.0); }
double hertz_of(double mel) { return 700.0 * (std::exp(mel / 1127.0) - 1.0); }

using DenseFilters = std::vector<std::vector<double>>;  // bands x bins

// Keeps the bins from the first to the last with a positive weight. A filter without any stays
// empty and gives 0.
FilterBank sparse(const DenseFilters& dense) {
    std::vector<FilterBank::Filter> filters;
    for (const std::vector<double>& row : dense) {
        const auto is_used = [](double weight) { return weight > 0.0; };
        const auto first = std::find_if(row.begin(), row.end(), is_used);
        const auto last = std::find_if(row.rbegin(), row.rend(), is_used).base();
        FilterBank::Filter filter;
        if (first < last) {
            filter.first_bin = static_cast<int>(first - row.begin());
            filter.weights.assign(first, last);
        }
        filters.push_back(std::move(filter));
    }
    return FilterBank(std::move(filters));
}

}  // namespace

namespace {

// The bands of a spectrum: eight bins at a time, then those that are left.
RAKS_SIMD_CLONES void weigh_bins(std::span<const FilterBank::Filter> filters,
                                 const float* spectrum,
                                 float* __restrict bands) noexcept {
    for (std::size_t band = 0; band < filters.size(); ++band) {
        const FilterBank::Filter& filter = filters[band];
        const float* const bins = spectrum + filter.first_bin;
        const float* const weights = filter.weights.data();
        const std::size_t count = filter.weights.size();
        std::size_t i = 0;
        Lanes sums{};
        for (; i + kLanes <= count; i += kLanes) {
            sums += lanes_at(bins + i) * lanes_at(weights + i);
        }
        float sum = count < kLanes ? 0.0F : sum_of_lanes(sums);
        for (; i < count; ++i) {
            sum += bins[i] * weights[i];
        }
        bands[band] = sum;
    }
}

}  // namespace

FilterBank::FilterBank(std::vector<Filter> filters) : filters_(std::move(filters)) {}

int FilterBank::size_below(int bin) const noexcept {
    // Filters end at ascending bins, so the first that reaches beyond `bin` bounds the count.
    const auto above = std::find_if(filters_.begin(), filters_.end(), [bin](const Filter& filter) {
        return filter.first_bin + static_cast<int>(filter.weights.size()) > bin + 1;
    });
    return static_cast<int>(above - filters_.begin());
}

void FilterBank::apply(std::span<const float> spectrum,
                       std::span<float> bands) const noexcept RAKS_NONBLOCKING {
    RAKS_ASSERT(bands.size() == filters_.size());
    weigh_bins(filters_, spectrum.data(), bands.data());
}

FilterBank htk_filter_bank(const MelConfig& config) {
    const double low = mel_of(config.low_hz);
    const double high = mel_of(config.high_hz);
    std::vector<double> centres;  // of the bands, then the upper edge of the last one
    for (int k = 1; k <= config.bands + 1; ++k) {
        centres.push_back(low + k / (config.bands + 1.0) * (high - low));
    }
    const double bin_hz = static_cast<double>(config.sample_rate) / config.fft_size;
    // First bin and end rounded as HTK does; DC (bin 0) and Nyquist never count.
    const int first = std::max(1, static_cast<int>(std::floor(config.low_hz / bin_hz + 1.5)));
    const int end =
        std::min(config.fft_size / 2, static_cast<int>(std::lround(config.high_hz / bin_hz)));
    DenseFilters dense(static_cast<std::size_t>(config.bands),
                       std::vector<double>(static_cast<std::size_t>(config.fft_size / 2 + 1)));
    std::size_t channel = 0;  // filter whose rising side covers the bin
    for (int bin = first; bin < end; ++bin) {
        // Each bin lies between two neighbouring centres: its weight falls from 1 to 0 on the lower
        // filter and rises on the upper one, linearly in mel, so the two weights sum to 1.
        const double mel = mel_of(bin * bin_hz);
        while (channel < dense.size() && centres[channel] < mel) {
            ++channel;
        }
        const double lower = channel > 0 ? centres[channel - 1] : low;
        const double weight = (centres[channel] - mel) / (centres[channel] - lower);
        if (channel > 0) {
            dense[channel - 1][static_cast<std::size_t>(bin)] = weight;
        }
        if (channel < dense.size()) {
            dense[channel][static_cast<std::size_t>(bin)] = 1.0 - weight;
        }
    }
    return sparse(dense);
}

FilterBank triangular_filter_bank(const MelConfig& config) {
    const double low = mel_of(config.low_hz);
    const double step = (mel_of(config.high_hz) - low) / (config.bands + 1);
    const double bin_hz = static_cast<double>(config.sample_rate) / config.fft_size;
    const std::size_t bins = static_cast<std::size_t>(config.fft_size) / 2 + 1;
    DenseFilters dense(static_cast<std::size_t>(config.bands), std::vector<double>(bins));
    for (std::size_t band = 0; band < dense.size(); ++band) {
        const double left = hertz_of(low + step * static_cast<double>(band));
        const double middle = hertz_of(low + step * static_cast<double>(band + 1));
        const double right = hertz_of(low + step * static_cast<double>(band + 2));
        double total = 0.0;
        for (std::size_t bin = 0; bin < bins; ++bin) {
            const double hertz = static_cast<double>(bin) * bin_hz;
            const double weight =
                std::min((hertz - left) / (middle - left), (right - hertz) / (right - middle));
            dense[band][bin] = std::max(0.0, weight);
            total += dense[band][bin];
        }
        // At low frequencies a triangle may fit between two bins and would always give 0.
        if (total == 0.0) {
            dense[band]
                 [std::min(bins - 1, static_cast<std::size_t>(std::lround(middle / bin_hz)))] = 1.0;
        }
    }
    return sparse(dense);
}

}  // namespace raks::audio
