#include "audio/sync/phase_correlator.hpp"

#include <kiss_fftr.h>

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"
#include "base/statistics.hpp"

namespace raks::audio {

// Plans and buffers for one length of transform.
struct PhaseCorrelator::Plan {
    Plan(int rate, Band band, std::size_t longest)
        : size(static_cast<std::size_t>(kiss_fftr_next_fast_size_real(static_cast<int>(longest)))),
          first(bin_of(band.low_hz, rate)),
          last(std::min(bin_of(band.high_hz, rate), size / 2)),
          forward(kiss_fftr_alloc(static_cast<int>(size), 0, nullptr, nullptr)),
          backward(kiss_fftr_alloc(static_cast<int>(size), 1, nullptr, nullptr)),
          samples(size),
          whole(size / 2 + 1),
          cross(size / 2 + 1) {}
    ~Plan() {
        kiss_fftr_free(forward);
        kiss_fftr_free(backward);
    }
    Plan(const Plan&) = delete;
    Plan& operator=(const Plan&) = delete;

    [[nodiscard]] std::size_t bin_of(double hertz, int rate) const {
        return static_cast<std::size_t>(std::lround(hertz * static_cast<double>(size) / rate));
    }
    // The spectrum of a sound with silence behind it.
    void transform(std::span<const float> sound, std::vector<kiss_fft_cpx>& spectrum) {
        std::copy(sound.begin(), sound.end(), samples.begin());
        std::fill(samples.begin() + static_cast<std::ptrdiff_t>(sound.size()), samples.end(), 0.0F);
        kiss_fftr(forward, samples.data(), spectrum.data());
    }

    std::size_t size;  // even
    std::size_t first;
    std::size_t last;
    kiss_fftr_cfg forward;
    kiss_fftr_cfg backward;
    std::vector<float> samples;
    std::vector<kiss_fft_cpx> whole;
    std::vector<kiss_fft_cpx> cross;
    std::size_t whole_size = 0;
};

PhaseCorrelator::PhaseCorrelator(int rate, Band band, std::size_t longest)
    : plan_(std::make_unique<Plan>(rate, band, longest)) {}
PhaseCorrelator::~PhaseCorrelator() = default;

void PhaseCorrelator::set_whole(std::span<const float> whole) {
    RAKS_ASSERT(whole.size() <= plan_->size);
    plan_->transform(whole, plan_->whole);
    plan_->whole_size = whole.size();
}

std::span<const float> PhaseCorrelator::correlate(std::span<const float> part) {
    Plan& plan = *plan_;
    RAKS_ASSERT(part.size() <= plan.whole_size);
    plan.transform(part, plan.cross);
    const float scale = 0.5F / static_cast<float>(plan.last - plan.first + 1);
    for (std::size_t bin = 0; bin < plan.cross.size(); ++bin) {
        const kiss_fft_cpx a = plan.whole[bin];
        const kiss_fft_cpx b = plan.cross[bin];
        const float real = a.r * b.r + a.i * b.i;
        const float imaginary = a.i * b.r - a.r * b.i;
        const float size = std::hypot(real, imaginary);
        const bool counts = bin >= plan.first && bin <= plan.last && size > 0.0F;
        const float factor = counts ? scale / size : 0.0F;
        plan.cross[bin] = {real * factor, imaginary * factor};
    }
    kiss_fftri(plan.backward, plan.cross.data(), plan.samples.data());
    // Further lags wrap around the end: there the part does not lie wholly within the whole.
    return std::span(plan.samples).first(plan.whole_size - part.size() + 1);
}

namespace {

// The summit of the parabola through a sample and its neighbours.
CorrelationPeak summit(std::span<const float> heights, std::size_t at) {
    CorrelationPeak peak{static_cast<double>(at), static_cast<double>(heights[at]), 0.0};
    if (at == 0 || at + 1 >= heights.size()) {
        return peak;
    }
    const auto before = static_cast<double>(heights[at - 1]);
    const auto behind = static_cast<double>(heights[at + 1]);
    const double curvature = before - 2.0 * peak.height + behind;
    if (curvature < 0.0) {
        const double shift = 0.5 * (before - behind) / curvature;
        peak.lag += shift;
        peak.height -= 0.25 * (before - behind) * shift;
    }
    return peak;
}

}  // namespace

std::vector<CorrelationPeak> highest_peaks(std::span<const float> heights,
                                           std::size_t count,
                                           std::size_t apart,
                                           double least) {
    std::vector<CorrelationPeak> peaks;
    if (heights.empty()) {
        return peaks;
    }
    std::vector<float> sizes(heights.size());
    std::transform(
        heights.begin(), heights.end(), sizes.begin(), [](float x) { return std::abs(x); });
    // Half of normal numbers are below 0.6745 standard deviations.
    const double deviation = static_cast<double>(upper_median(std::move(sizes))) / 0.6745;
    if (!(deviation > 0.0)) {
        return peaks;
    }
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        if (static_cast<double>(heights[i]) > least * deviation) {
            places.push_back(i);
        }
    }
    // Equal heights in the order of their places: the same on every machine.
    std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
        return heights[a] > heights[b];
    });
    for (const std::size_t place : places) {
        const bool is_near_a_higher =
            std::any_of(peaks.begin(), peaks.end(), [&](const CorrelationPeak& peak) {
                return std::abs(peak.lag - static_cast<double>(place)) < static_cast<double>(apart);
            });
        if (!is_near_a_higher) {
            CorrelationPeak peak = summit(heights, place);
            peak.deviations = peak.height / deviation;
            peaks.push_back(peak);
        }
        if (peaks.size() == count) {
            break;
        }
    }
    return peaks;
}

}  // namespace raks::audio
