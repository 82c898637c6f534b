#include "audio/features/spectrum.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"

#include <kiss_fftr.h>

namespace raks::audio {

// kissfft's plan and the buffers of one transform: compute() allocates nothing.
struct PowerSpectrum::Plan {
    Plan(std::vector<float> window_in, int fft_size)
        : window(std::move(window_in)),
          samples(static_cast<std::size_t>(fft_size)),
          bins(static_cast<std::size_t>(fft_size / 2 + 1)),
          power(bins.size()),
          config(kiss_fftr_alloc(fft_size, 0, nullptr, nullptr)) {}
    ~Plan() { kiss_fftr_free(config); }
    Plan(const Plan&) = delete;
    Plan& operator=(const Plan&) = delete;

    std::vector<float> window;
    std::vector<float> samples;  // longer than the window: what is behind it stays 0
    std::vector<kiss_fft_cpx> bins;
    std::vector<float> power;
    kiss_fftr_cfg config;
};

PowerSpectrum::PowerSpectrum(std::vector<float> window, int fft_size)
    : plan_(std::make_unique<Plan>(std::move(window), fft_size)) {}
PowerSpectrum::~PowerSpectrum() = default;
PowerSpectrum::PowerSpectrum(PowerSpectrum&&) noexcept = default;
PowerSpectrum& PowerSpectrum::operator=(PowerSpectrum&&) noexcept = default;

std::span<const float> PowerSpectrum::compute(std::span<const float> samples) noexcept
    RAKS_NONBLOCKING {
    Plan& plan = *plan_;
    RAKS_ASSERT(samples.size() == plan.window.size());
    std::transform(samples.begin(),
                   samples.end(),
                   plan.window.begin(),
                   plan.samples.begin(),
                   [](float sample, float weight) { return sample * weight; });
    kiss_fftr(plan.config, plan.samples.data(), plan.bins.data());
    std::transform(plan.bins.begin(), plan.bins.end(), plan.power.begin(), [](kiss_fft_cpx x) {
        return x.r * x.r + x.i * x.i;
    });
    return plan.power;
}

int PowerSpectrum::bins() const noexcept { return static_cast<int>(plan_->power.size()); }

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

}  // namespace raks::audio
