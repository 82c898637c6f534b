#include "audio/features/mfcc_hops.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

/// Tones up to 6 kHz that glide, swell and fade: no two windows are alike, and no rate from 16 kHz
/// on holds more of it than another.
std::vector<float> sound(double seconds, int hertz) {
    std::vector<float> samples(static_cast<std::size_t>(seconds * hertz));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double t = static_cast<double>(i) / hertz;
        double sum = 0.0;
        for (int partial = 1; partial <= 20; ++partial) {
            sum += std::sin(2.0 * M_PI * partial * (280.0 + 5.0 * t) * t) / partial;
        }
        samples[i] = static_cast<float>(0.2 * sum * (1.1 + std::sin(9.0 * t)));
    }
    return samples;
}

class CollectHops final : public MfccStream::Sink {
 public:
    void on_vector(const MfccVector& vector) noexcept override { vectors.push_back(vector); }
    std::vector<MfccVector> vectors;
};

TEST(MfccHops, at_16_khz_the_vectors_are_those_of_the_plain_stream) {
    const std::vector<float> samples = sound(2.0, 16'000);
    MfccHops hops;
    ASSERT_TRUE(hops.prepare(SampleRate(16'000)));
    std::vector<MfccVector> ours;
    for (std::size_t at = 0; at + 160 <= samples.size(); at += 160) {
        hops.push(std::span(samples).subspan(at, 160));
        const MfccVector* vector = hops.next();
        EXPECT_EQ(vector == nullptr, at / 160 < 6) << "one a hop, from the seventh on";
        if (vector != nullptr) {
            ours.push_back(*vector);
        }
    }
    std::vector<float> scaled;
    for (const float sample : samples) {
        scaled.push_back(sample * 32768.0F);
    }
    CollectHops plain;
    MfccStream().process(scaled, plain);
    ASSERT_EQ(ours.size(), plain.vectors.size());
    EXPECT_EQ(ours, plain.vectors);
}

TEST(MfccHops, the_source_rate_hardly_changes_the_vectors) {
    // Rates above 16 kHz hold the same band; the resampler's edge touches the uppermost filters.
    const auto at_rate = [](int hertz) {
        const std::vector<float> samples = sound(3.0, hertz);
        MfccHops hops;
        EXPECT_TRUE(hops.prepare(SampleRate(hertz)));
        std::vector<MfccVector> vectors;
        const std::size_t hop = static_cast<std::size_t>(hertz / 100);
        hops.push(std::span(samples).first(hop));
        for (std::size_t at = hop; at + hop <= samples.size(); at += hop) {
            hops.push(std::span(samples).subspan(at, hop));
            if (const MfccVector* vector = hops.next()) {
                vectors.push_back(*vector);
            }
        }
        return vectors;
    };
    const auto reference = at_rate(48'000);
    for (const int hertz : {44'100, 96'000, 192'000}) {
        const auto vectors = at_rate(hertz);
        ASSERT_EQ(vectors.size(), reference.size());
        double difference = 0.0;
        for (std::size_t i = 20; i < vectors.size(); ++i) {
            difference += std::abs(static_cast<double>(vectors[i].at(0) - reference[i].at(0)));
        }
        EXPECT_LT(difference / static_cast<double>(vectors.size()), 1.5) << hertz;
    }
}

TEST(MfccHops, a_gap_starts_the_frames_anew_and_keeps_the_hops_in_step) {
    const std::vector<float> samples = sound(2.0, 16'000);
    MfccHops whole;
    MfccHops cut;
    ASSERT_TRUE(whole.prepare(SampleRate(16'000)));
    ASSERT_TRUE(cut.prepare(SampleRate(16'000)));
    constexpr std::size_t kLostFrom = 50;  // hops
    constexpr std::size_t kLostTo = 80;
    constexpr std::size_t kUntilSame = 10;  // hops that a vector spans
    for (std::size_t hop = 0; hop < samples.size() / 160; ++hop) {
        const auto block = std::span(samples).subspan(hop * 160, 160);
        whole.push(block);
        const MfccVector* expected = whole.next();
        if (hop >= kLostFrom && hop < kLostTo) {
            cut.push_lost(160);
            cut.discard();
            continue;
        }
        cut.push(block);
        const MfccVector* vector = cut.next();
        if (hop >= kLostTo && hop < kLostTo + 6) {
            EXPECT_EQ(vector, nullptr) << hop;
        }
        if (hop >= kLostTo + kUntilSame) {
            ASSERT_NE(vector, nullptr);
            EXPECT_EQ(*vector, *expected) << hop;
        }
    }
}

TEST(MfccHops, nothing_allocates) {
    const std::vector<float> samples = sound(1.0, 44'100);
    MfccHops hops;
    ASSERT_TRUE(hops.prepare(SampleRate(44'100)));
    raks::test::RealtimeScope scope;
    hops.push(std::span(samples).first(600));
    for (std::size_t at = 600; at + 441 <= samples.size(); at += 441) {
        hops.push(std::span(samples).subspan(at, 441));
        (void)hops.next();
    }
    hops.push_lost(200);
    hops.discard();
    hops.reset();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::audio
