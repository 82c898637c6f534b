#include "audio/features/onset.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

/// Onsets of every hop of `samples` at 32 kHz; hop n's window is centred on sample 320 n.
std::vector<Onset> onsets_of(const std::vector<float>& samples) {
    OnsetDetector detector;
    std::vector<float> window(OnsetDetector::kWindow);
    std::vector<Onset> onsets;
    const int half = OnsetDetector::kWindow / 2;
    for (int centre = 0; centre + half <= static_cast<int>(samples.size());
         centre += OnsetDetector::kHop) {
        for (int i = 0; i < OnsetDetector::kWindow; ++i) {
            const int at = centre - half + i;
            window[static_cast<std::size_t>(i)] =
                at < 0 ? 0.0F : samples[static_cast<std::size_t>(at)];
        }
        onsets.push_back(detector.compute(window, false));
    }
    return onsets;
}

std::vector<float> bursts(double hertz, double seconds, double every) {
    std::vector<float> samples(static_cast<std::size_t>(seconds * OnsetDetector::kSampleRate));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double t = static_cast<double>(i) / OnsetDetector::kSampleRate;
        const double since = std::fmod(t, every);
        samples[i] = static_cast<float>(0.5 * std::exp(-since / 0.02) *
                                        std::sin(2.0 * M_PI * hertz * since));
    }
    return samples;
}

TEST(Onset, peaks_where_a_tone_starts_and_in_its_band) {
    const struct {
        double hertz;
        std::size_t band;
    } cases[] = {{100, 0}, {1000, 1}, {6000, 2}};
    for (const auto& c : cases) {
        const std::vector<Onset> onsets = onsets_of(bursts(c.hertz, 4.0, 0.5));
        for (int beat = 2; beat < 8; ++beat) {
            const int at = beat * 50;
            int best = at - 20;
            for (int hop = at - 20; hop <= at + 20; ++hop) {
                if (onsets[static_cast<std::size_t>(hop)].total >
                    onsets[static_cast<std::size_t>(best)].total) {
                    best = hop;
                }
            }
            EXPECT_NEAR(best, at, 1) << c.hertz;
            const Onset& onset = onsets[static_cast<std::size_t>(best)];
            for (std::size_t band = 0; band < onset.flux.size(); ++band) {
                EXPECT_LE(onset.flux[band], onset.flux[c.band]) << c.hertz << " band " << band;
            }
        }
    }
}

TEST(Onset, is_zero_in_digital_silence) {
    for (const Onset& onset : onsets_of(std::vector<float>(64'000))) {
        EXPECT_EQ(onset.total, 0.0F);
    }
}

TEST(Onset, does_not_allocate) {
    OnsetDetector detector;
    std::vector<float> window(OnsetDetector::kWindow, 0.1F);
    test::RealtimeScope scope;
    detector.compute(window, false);
    detector.reset();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::audio
