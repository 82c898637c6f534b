#include "audio/features/mfcc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/random.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

// HTK's statics are float32; deltas divide their error by 10 (tests/data/mfcc/README.md).
constexpr double kStaticTolerance = 5e-4;
constexpr double kDeltaTolerance = 1e-4;

std::string data_file(const std::string& name) {
    auto bytes = read_file(std::string(RAKS_SOURCE_DIR) + "/tests/data/mfcc/" + name);
    EXPECT_TRUE(bytes) << bytes.error().message;
    return bytes ? *bytes : std::string();
}

/// 16-bit mono samples behind a WAV head of 44 bytes, in 16-bit scale.
std::vector<float> speech() {
    const std::string bytes = data_file("speech_16k.wav");
    std::vector<float> samples;
    for (std::size_t i = 44; i + 1 < bytes.size(); i += 2) {
        std::int16_t sample = 0;
        std::memcpy(&sample, &bytes[i], sizeof sample);
        samples.push_back(sample);
    }
    return samples;
}

float big_endian_float(const char* bytes) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, bytes, sizeof bits);
    return std::bit_cast<float>(__builtin_bswap32(bits));
}

/// Rows of 39 of an HTK file (12 bytes of head, big-endian).
std::vector<MfccVector> htk_file(const std::string& name) {
    const std::string bytes = data_file(name);
    std::vector<MfccVector> rows;
    for (std::size_t at = 12; at + kMfccFeatures * 4 <= bytes.size(); at += kMfccFeatures * 4) {
        MfccVector& row = rows.emplace_back();
        for (std::size_t i = 0; i < row.size(); ++i) {
            row[i] = big_endian_float(&bytes[at + 4 * i]);
        }
    }
    return rows;
}

std::vector<MfccVector> float_file(const std::string& name) {
    const std::string bytes = data_file(name);
    std::vector<MfccVector> rows(bytes.size() / sizeof(MfccVector));
    std::memcpy(rows.data(), bytes.data(), rows.size() * sizeof(MfccVector));
    return rows;
}

class CollectVectors final : public MfccStream::Sink {
 public:
    CollectVectors() { vectors.reserve(1000); }
    void on_vector(const MfccVector& vector) noexcept override { vectors.push_back(vector); }
    std::vector<MfccVector> vectors;
};

std::vector<MfccVector> whole(const std::vector<float>& samples, const MfccConfig& config) {
    MfccStream stream(config);
    CollectVectors collect;
    stream.process(samples, collect);
    stream.finish(collect);
    return collect.vectors;
}

void expect_equal(const std::vector<MfccVector>& ours, const std::vector<MfccVector>& theirs) {
    ASSERT_EQ(ours.size(), theirs.size());
    double worst_static = 0;
    double worst_delta = 0;
    for (std::size_t row = 0; row < ours.size(); ++row) {
        for (std::size_t i = 0; i < ours[row].size(); ++i) {
            const double error = std::abs(static_cast<double>(ours[row][i] - theirs[row][i]));
            (i < kMfccStatic ? worst_static : worst_delta) =
                std::max(i < kMfccStatic ? worst_static : worst_delta, error);
        }
    }
    EXPECT_LE(worst_static, kStaticTolerance);
    EXPECT_LE(worst_delta, kDeltaTolerance);
}

TEST(Mfcc, equals_htk_without_pre_emphasis_with_c0) {
    expect_equal(whole(speech(), {.bands = 23, .pre_emphasis = 0.0}), htk_file("htk1.mfc"));
}

TEST(Mfcc, equals_htk_with_pre_emphasis_and_energy) {
    expect_equal(whole(speech(), {.bands = 23, .last = MfccConfig::Last::log_energy}),
                 htk_file("htk4.mfc"));
}

TEST(Mfcc, equals_the_papers_definition) {
    expect_equal(whole(speech(), {}), float_file("paper_speech.f32"));
}

TEST(Mfcc, digital_silence_is_exactly_zero) {
    for (const MfccVector& vector : whole(std::vector<float>(8000), {})) {
        for (const float value : vector) {
            ASSERT_EQ(value, 0.0F);
        }
    }
}

TEST(Mfcc, any_blocks_give_the_same_bits_without_allocating) {
    const std::vector<float> samples = speech();
    const std::vector<MfccVector> batch = whole(samples, {});
    const CounterRandom random(9);
    MfccStream stream;
    CollectVectors collect;
    test::RealtimeScope scope;
    std::uint64_t draw = 0;
    for (std::size_t at = 0; at < samples.size();) {
        const std::size_t count =
            std::min<std::size_t>(1 + random.below(draw++, 700), samples.size() - at);
        stream.process(std::span(samples).subspan(at, count), collect);
        at += count;
    }
    stream.finish(collect);
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_EQ(collect.vectors, batch);
}

}  // namespace
}  // namespace raks::audio

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
