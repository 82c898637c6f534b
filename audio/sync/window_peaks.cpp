#include "audio/sync/window_peaks.hpp"

#include <algorithm>
#include <cmath>

#include "audio/resample/interpolation.hpp"
#include "audio/sync/sync_track.hpp"

namespace raks::audio {
namespace {

constexpr double kFineRate = SyncTrack::kRate;
constexpr auto kWindowSamples = static_cast<std::size_t>(SyncTrack::kWindow * kFineRate);
constexpr std::size_t kStep = kWindowSamples / 2;
constexpr auto kReachSamples = static_cast<std::size_t>(WindowPeaks::kReach * kFineRate);
constexpr std::size_t kMostWindows = 60;
// Voices and instruments have most of their energy here, and small microphones hear it.
constexpr PhaseCorrelator::Band kWindowBand{150.0, 6'000.0};

}  // namespace

WindowPeaks::WindowPeaks(std::span<const float> part, std::span<const float> whole)
    : part_(part),
      whole_(whole),
      correlator_(SyncTrack::kRate, kWindowBand, kWindowSamples + 2 * kReachSamples + 2) {
    const std::size_t room = part.size() - kWindowSamples;
    const std::size_t step = std::max(kStep, room / kMostWindows + 1);
    for (std::size_t first = 0; first <= room; first += step) {
        firsts_.push_back(first);
    }
}

WindowMeasurements WindowPeaks::measure(const ClockLine& line) {
    WindowMeasurements result{{}, std::vector<float>(2 * kReachSamples + 1)};
    for (const std::size_t first : firsts_) {
        result.windows.push_back(measure_one(first, line, result.stack));
    }
    return result;
}

AlignmentWindow WindowPeaks::measure_one(std::size_t first,
                                         const ClockLine& line,
                                         std::span<float> stack) {
    const double place = line.at(static_cast<double>(first) / kFineRate) * kFineRate;
    const double end = place + static_cast<double>(kWindowSamples);
    if (place < 0.0 || end > static_cast<double>(whole_.size())) {
        return {};
    }
    const auto at = static_cast<std::size_t>(place);
    const std::size_t from = at - std::min(at, kReachSamples);
    const std::size_t to = std::min(at + kWindowSamples + kReachSamples, whole_.size());
    correlator_.set_whole(whole_.subspan(from, to - from));
    // At the other clock's pace, so that drift does not smear the peak.
    const double step = 1.0 / (1.0 + line.drift_ppm * 1e-6);
    const auto sound = read_between(part_, static_cast<double>(first), step, kWindowSamples);
    const auto heights = correlator_.correlate(sound);
    // The line's own lag is the middle of the stack.
    const auto middle = static_cast<std::size_t>(std::lround(place)) - from;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const std::size_t to_stack = i + kReachSamples - middle;
        if (to_stack < stack.size()) {
            stack[to_stack] += heights[i];
        }
    }
    const auto peaks = highest_peaks(heights, 1, 1, kLeast);
    AlignmentWindow window{true, std::nullopt};
    if (!peaks.empty()) {
        const double half = 0.5 * static_cast<double>(kWindowSamples);
        window.point =
            ClockPoint{(static_cast<double>(first) + half * step) / kFineRate,
                       (static_cast<double>(from) + peaks.front().lag + half) / kFineRate,
                       peaks.front().height,
                       peaks.front().deviations};
    }
    return window;
}

}  // namespace raks::audio
