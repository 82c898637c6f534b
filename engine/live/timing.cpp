#include "engine/live/timing.hpp"

#include <algorithm>
#include <cmath>

namespace raks::engine {
namespace {
// Lower edge of the first bin: 1 us.
constexpr double kFirstBinNanos = 1'000.0;
}  // namespace

void TimingHistogram::add(Nanos span) noexcept RAKS_NONBLOCKING {
    // Position on the logarithmic axis, in octaves above the first bin's lower edge.
    const double octaves =
        std::log2(std::max(1.0, static_cast<double>(span.count()) / kFirstBinNanos));
    const int bin = std::min(kBins - 1, static_cast<int>(octaves * kBinsPerOctave));
    bins_[static_cast<std::size_t>(bin)].fetch_add(1, std::memory_order_relaxed);
    // No compare-and-swap: one thread alone writes the maximum.
    if (span.count() > max_ns_.load(std::memory_order_relaxed)) {
        max_ns_.store(span.count(), std::memory_order_relaxed);
    }
}

std::int64_t TimingHistogram::count() const noexcept {
    std::int64_t total = 0;
    for (const auto& bin : bins_) {
        total += bin.load(std::memory_order_relaxed);
    }
    return total;
}

double TimingHistogram::quantile_ms(double share) const noexcept {
    // Walks the cumulative counts up to the wanted share; the answer is the bin's upper edge, which
    // never understates the time, but not above the exact maximum.
    const double wanted = share * static_cast<double>(count());
    std::int64_t seen = 0;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
        seen += bins_[i].load(std::memory_order_relaxed);
        if (seen > 0 && static_cast<double>(seen) >= wanted) {
            const double upper = std::exp2(static_cast<double>(i + 1) / kBinsPerOctave);
            return std::min(upper * kFirstBinNanos * 1e-6, max_ms());
        }
    }
    return 0.0;
}

double TimingHistogram::max_ms() const noexcept {
    return static_cast<double>(max_ns_.load(std::memory_order_relaxed)) * 1e-6;
}

}  // namespace raks::engine
