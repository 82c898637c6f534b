#include "audio/beat/beat_pointer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "models/fast_exp.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

TEST(FastExp, is_exp_within_a_millionth) {
    for (float x = -80.0F; x <= 80.0F; x += 0.0137F) {
        const double exact = std::exp(static_cast<double>(x));
        EXPECT_NEAR(static_cast<double>(models::fast_exp(x)) / exact, 1.0, 1e-6) << x;
    }
}

/// Onset strength of a pulse every `period` hops, between hops as two parts.
float pulse(int hop, double period) {
    double distance = hop - period * std::round(hop / period);
    distance = std::abs(distance);
    return distance < 1.0 ? static_cast<float>(3.0 * (1.0 - distance)) : -0.3F;
}

TEST(BeatPointer, finds_period_and_phase_of_a_pulse) {
    for (const double bpm : {62.0, 90.0, 120.0, 150.0, 184.0, 205.0}) {
        const double period = 6000.0 / bpm;
        BeatPointer pointer;
        for (int hop = 0; hop < 1000; ++hop) {
            pointer.advance(pulse(hop, period));
        }
        const PointerEstimate estimate = pointer.estimate();
        EXPECT_NEAR(estimate.period_hops / period, 1.0, 0.02) << bpm;
        const double phase = estimate.phase - 999.0 / period;
        EXPECT_NEAR((phase - std::round(phase)) * period, 0.0, 2.5) << bpm << " in hops";
        EXPECT_GT(estimate.mass, 0.5F) << bpm;
    }
}

TEST(BeatPointer, does_not_allocate_and_stays_finite) {
    BeatPointer pointer;
    test::RealtimeScope scope;
    for (int hop = 0; hop < 500; ++hop) {
        pointer.advance(hop % 7 == 0 ? 3.5F : -0.8F);
        ASSERT_TRUE(std::isfinite(pointer.estimate().period_hops));
    }
    pointer.expect_tempo(180.0);
    pointer.expect_beat();
    pointer.open_positions();
    pointer.advance_blind();
    pointer.reset();
    EXPECT_TRUE(std::isfinite(pointer.estimate().period_hops));
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::audio
