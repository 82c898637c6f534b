#include "audio/beat/beat_pointer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

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

// A pulse alone may be a beat or every second one. What the file tells decides, and only that.
TEST(BeatPointer, a_told_tempo_decides_between_octaves) {
    const auto found = [](double told_bpm, double bpm) {
        BeatPointer pointer({.told_bpm = told_bpm});
        for (int hop = 0; hop < 1500; ++hop) {
            pointer.advance(pulse(hop, 6000.0 / bpm));
        }
        return 6000.0 / pointer.estimate().period_hops;
    };
    EXPECT_NEAR(found(0.0, 210.0), 210.0, 4.0);
    EXPECT_NEAR(found(105.0, 210.0), 105.0, 2.0);
    EXPECT_NEAR(found(210.0, 210.0), 210.0, 4.0);
    EXPECT_NEAR(found(107.0, 107.0), 107.0, 2.0);
    // A tempo of which neither it nor its double is an octave, 3:2 or 4:3 changes nothing.
    for (const double told : {66.0, 88.0, 119.0, 190.0}) {
        EXPECT_NEAR(found(told, 107.0), found(0.0, 107.0), 2.0) << told;
    }
}

TEST(PointerStates, a_told_tempo_weakens_what_is_easily_taken_for_it_and_nothing_else) {
    const PointerStates plain({});
    const PointerStates told({.told_bpm = 100.0});
    const std::span<const PointerStates::Tempo> tempi = plain.tempi();
    const auto share = [](const PointerStates& states, const PointerStates::Tempo& tempo) {
        return static_cast<double>(states.prior()[tempo.state(0)]);
    };
    const auto of_100 = std::find_if(
        tempi.begin(), tempi.end(), [](const auto& tempo) { return tempo.hops <= 60; });
    ASSERT_NE(of_100, tempi.end());
    // How often each tempo is where 100 BPM is, compared with how often it was.
    for (std::size_t i = 0; i < tempi.size(); ++i) {
        const double bpm = hops_of(1.0) / tempi[i].hops;
        const double change = share(told, tempi[i]) / share(plain, tempi[i]) /
                              (share(told, *of_100) / share(plain, *of_100));
        const double stays =
            std::accumulate(told.transitions(i).begin(), told.transitions(i).end(), 0.0);
        bool is_mistaken = false;
        for (const double ratio : {0.5, 2.0 / 3.0, 0.75, 4.0 / 3.0, 1.5, 2.0}) {
            is_mistaken = is_mistaken || std::abs(std::log(bpm / (100.0 * ratio))) < 0.05;
        }
        EXPECT_NEAR(change, is_mistaken ? 0.05 : 1.0, 1e-4) << bpm;
        EXPECT_NEAR(stays, is_mistaken ? 0.12 : 1.0, 1e-4) << bpm;
    }
}

TEST(BeatPointer, does_not_allocate_and_stays_finite) {
    BeatPointer pointer;
    raks::test::RealtimeScope scope;
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

TEST(PointerStates, another_told_tempo_leaves_nothing_of_the_one_before) {
    PointerStates states({.told_bpm = 97.0});
    for (const double bpm : {100.0, 0.0, 133.0}) {
        raks::test::RealtimeScope scope;
        states.expect_told(bpm);
        EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
        const PointerStates fresh({.told_bpm = bpm});
        EXPECT_TRUE(std::equal(states.prior().begin(),
                               states.prior().end(),
                               fresh.prior().begin(),
                               fresh.prior().end()));
        EXPECT_TRUE(std::equal(states.transitions().begin(),
                               states.transitions().end(),
                               fresh.transitions().begin(),
                               fresh.transitions().end()));
    }
}

}  // namespace
}  // namespace raks::audio
