#include "training/beat/train_pulses.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace raks::audio {
namespace {

/// Strokes in the bass on each beat of two parts, or of three, with soft strokes above on the
/// parts. They show a hop before their time, as a window reaches beyond its hop.
TrainingExcerpt strokes(double period_hops, int parts) {
    constexpr int kHops = 1600;
    TrainingExcerpt excerpt;
    excerpt.mel.assign(kHops * 36, 0.01F);
    for (int hop = 0; hop < kHops; ++hop) {
        for (int part = 0; part < parts; ++part) {
            const double position = (hop - 19) / period_hops - static_cast<double>(part) / parts;
            if (std::abs(position - std::round(position)) * period_hops < 0.5) {
                for (std::size_t band = part == 0 ? 0 : 24; band < 36; ++band) {
                    excerpt.mel[static_cast<std::size_t>(hop) * 36 + band] =
                        part == 0 ? 1.0F : 0.3F;
                }
            }
        }
    }
    for (int beat = 0; 20 + beat * period_hops < kHops; ++beat) {
        excerpt.beats.push_back({.time = (20 + beat * period_hops) / 100.0});
    }
    return excerpt;
}

TEST(TrainPulses, the_right_pulse_has_the_beat_at_every_beat) {
    const PulseSequence sequence =
        make_pulse_sequence(strokes(60.0, 2), 0, 0, MelAugmentation::plain(), nullptr);
    ASSERT_GT(sequence.frames.size(), 20U);
    for (std::size_t i = 4; i < sequence.frames.size(); ++i) {
        EXPECT_EQ(sequence.places[i], 0U);
        // The bass rises in the first twelfth.
        EXPECT_GT(sequence.frames[i][0], 1.0F) << i;
        EXPECT_LT(sequence.frames[i][6 * PulseInput::kGroups], 0.0F) << i;
    }
}

TEST(TrainPulses, a_pulse_twice_as_fast_has_the_beat_at_every_other_one) {
    const std::size_t half = place_at(2, 0);  // kRivalPulses[1]: half as fast
    ASSERT_EQ(pulse_at(half).rate, 0.5);
    const PulseSequence sequence =
        make_pulse_sequence(strokes(60.0, 2), half, 0, MelAugmentation::plain(), nullptr);
    ASSERT_GT(sequence.frames.size(), 40U);
    for (std::size_t i = 4; i + 1 < sequence.frames.size(); ++i) {
        EXPECT_NE(sequence.places[i], sequence.places[i + 1]) << i;
        const bool is_beat = pulse_at(sequence.places[i]).offset == 0.0;
        EXPECT_EQ(sequence.frames[i][0] > 1.0F, is_beat) << i;
    }
}

TEST(TrainPulses, compound_music_that_is_followed_at_three_halves_is_recognised) {
    std::vector<TrainingExcerpt> corpus;
    corpus.reserve(64);
    for (int i = 0; i < 64; ++i) {
        corpus.push_back(strokes(44.0 + 0.5 * i, i % 2 == 0 ? 2 : 3));
    }
    PulsePlan plan;
    plan.units = 16;
    plan.copies = 2;
    plan.steps = 200;
    const auto network = std::make_shared<const PulseNetwork>(
        train_pulses(corpus, plan, [](const NetworkProgress&, const PulseNetwork&) {}));
    std::size_t dotted = 1;
    while (pulse_at(dotted).rate > 0.67 || pulse_at(dotted).rate < 0.66) {
        ++dotted;
    }
    const PulseSequence sequence =
        make_pulse_sequence(strokes(57.3, 3), dotted, 0, MelAugmentation::plain(), nullptr);
    PulseNetworkStream stream(network);
    int right = 0;
    for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
        const PulseEvidence evidence = stream.next(sequence.frames[i]);
        right += i >= 8 && std::max_element(evidence.begin(), evidence.end()) - evidence.begin() ==
                               static_cast<std::ptrdiff_t>(sequence.places[i]);
    }
    EXPECT_GT(right, static_cast<int>(sequence.frames.size() - 8) * 8 / 10);
}

}  // namespace
}  // namespace raks::audio
