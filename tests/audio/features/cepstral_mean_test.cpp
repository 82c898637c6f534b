#include "audio/features/cepstral_mean.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"

namespace raks::audio {
namespace {

using Frame = CepstralMean::Frame;

/// Noise around `offset` in every static, derivatives of 1.
MfccVector noisy(float offset, std::uint64_t frame) {
    const CounterRandom random(3, frame);
    MfccVector vector{};
    for (std::size_t i = 0; i < kMfccStatic; ++i) {
        vector[i] = offset + static_cast<float>(random.normal(i));
    }
    std::fill(vector.begin() + kMfccStatic, vector.end(), 1.0F);
    return vector;
}

TEST(CepstralMean, a_constant_offset_is_gone_after_four_time_constants) {
    CepstralMean with({.seconds = 5.0});
    CepstralMean without({.seconds = 5.0});
    for (std::uint64_t frame = 0; frame < 2000; ++frame) {
        MfccVector shifted = noisy(8.0F, frame);
        MfccVector plain = noisy(0.0F, frame);
        with.normalize(Frame::music, shifted);
        without.normalize(Frame::music, plain);
        if (frame == 1999) {
            for (std::size_t i = 0; i < kMfccStatic; ++i) {
                EXPECT_NEAR(shifted[i], plain[i], 0.12F) << "8 x e^-4 = 0.15 is left at most";
            }
        }
    }
}

TEST(CepstralMean, starts_from_the_given_mean) {
    CepstralMeanConfig config;
    config.start.fill(5.0F);
    CepstralMean mean(config);
    MfccVector vector = noisy(5.0F, 1);
    const MfccVector before = vector;
    mean.normalize(Frame::music, vector);
    for (std::size_t i = 0; i < kMfccStatic; ++i) {
        EXPECT_NEAR(vector[i], before[i] - 5.0F, 0.05F);
    }
}

TEST(CepstralMean, silence_does_not_move_it) {
    CepstralMean mean;
    for (std::uint64_t frame = 0; frame < 800; ++frame) {
        MfccVector vector = noisy(3.0F, frame);
        mean.normalize(Frame::music, vector);
    }
    const auto before = mean.mean();
    for (int frame = 0; frame < 3000; ++frame) {
        MfccVector zeros{};
        mean.normalize(Frame::silence, zeros);
        ASSERT_EQ(zeros[0], -static_cast<float>(before[0])) << "the mean is still taken off";
    }
    EXPECT_EQ(mean.mean(), before);
}

TEST(CepstralMean, derivatives_are_left_alone) {
    CepstralMean mean;
    MfccVector vector = noisy(9.0F, 0);
    mean.normalize(Frame::music, vector);
    for (std::size_t i = kMfccStatic; i < vector.size(); ++i) {
        EXPECT_EQ(vector[i], 1.0F);
    }
}

TEST(CepstralMean, a_time_constant_of_7_s_forgets_by_e_in_7_s) {
    CepstralMean mean({.seconds = 7.0});
    MfccVector vector{};
    for (int frame = 0; frame < 5000; ++frame) {
        vector.fill(0.0F);
        mean.normalize(Frame::music, vector);
    }
    for (int frame = 0; frame < 700; ++frame) {
        vector.fill(1.0F);
        mean.normalize(Frame::music, vector);
    }
    EXPECT_NEAR(mean.mean()[0], 1.0 - std::exp(-1.0), 2e-3);
}

}  // namespace
}  // namespace raks::audio
