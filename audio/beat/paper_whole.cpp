#include <algorithm>
#include <cmath>

#include "audio/beat/paper_beat.hpp"

namespace raks::audio {
namespace {

constexpr double kWindowHops = PaperWindow::kHops;
constexpr double kTolerance = 0.1;  // of the period, before and after the expected beat

// A window's analysis in one go.
PaperEstimate estimate_of(std::span<const float> onsets) {
    PaperWindow window;
    window.begin(onsets);
    while (!window.is_done()) {
        window.step();
    }
    return window.estimate();
}

// Place of the strongest onset within `reach` of `expected`; `expected` when there is none.
double strongest_near(std::span<const float> onsets, double expected, double reach) {
    const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(expected - reach)));
    double best = expected;
    float highest = 0.0F;
    for (std::size_t i = first; i < onsets.size() && static_cast<double>(i) <= expected + reach;
         ++i) {
        if (onsets[i] > highest) {
            highest = onsets[i];
            best = static_cast<double>(i);
        }
    }
    return best;
}

}  // namespace

std::vector<BeatEvent> paper_beats(std::span<const PaperFlux::Frame> frames) {
    std::vector<float> onsets;
    onsets.reserve(frames.size());
    for (const PaperFlux::Frame& frame : frames) {
        onsets.push_back(frame.onset());
    }
    // A rest shorter than half a window has too few beats for an estimate of its own: it belongs to
    // the window before.
    std::vector<PaperEstimate> windows;
    for (std::size_t start = 0; start == 0 || start + PaperWindow::kHops / 2 < onsets.size();
         start += PaperWindow::kHops) {
        const std::size_t count = std::min(PaperWindow::kHops, onsets.size() - start);
        windows.push_back(estimate_of(std::span(onsets).subspan(start, count)));
    }
    std::vector<BeatEvent> beats;
    // The first window's phase, moved back to the start of the file.
    double beat = std::fmod(windows.front().last_beat, windows.front().period_hops);
    while (beat < static_cast<double>(onsets.size())) {
        const auto at = static_cast<std::size_t>(std::max(0.0, beat) / kWindowHops);
        const PaperEstimate& window = windows[std::min(at, windows.size() - 1)];
        if (window.confidence > 0.0F) {
            beats.push_back(
                {stream_time_from_seconds(std::max(0.0, beat + kPaperLagHops) / kHopsPerSecond),
                 0,
                 window.confidence});
        }
        // The next beat is expected a period later and moved to the strongest onset nearby.
        beat = strongest_near(onsets, beat + window.period_hops, kTolerance * window.period_hops);
    }
    return beats;
}

}  // namespace raks::audio
