#include "audio/genre/music_tagger.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "audio/genre/tagger_file.hpp"
#include "audio/music_analyzer.hpp"
#include "base/decibels.hpp"
#include "base/hash.hpp"
#include "tests/audio/listen.hpp"
#include "tests/support/instruction_count.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kSecond = MusicTagger::kSampleRate;
constexpr std::size_t kPatchSamples = kTagFrames * 256;

std::shared_ptr<const TaggerNetwork> shipped_tagger() {
    static const auto network =
        load_tagger(RAKS_SOURCE_DIR "/models/pretrained/msd_musicnn.tagger");
    EXPECT_TRUE(network) << network.error().message;
    return *network;
}

/// As tests/data/tagger/expected.py makes it: whole numbers, so that both have the same.
std::vector<float> buzzing(std::size_t count) {
    std::vector<float> samples(count);
    std::uint32_t state = 1;
    for (std::size_t i = 0; i < count; ++i) {
        state = state * 1664525U + 1013904223U;
        const int beat = static_cast<int>(i % 8000);
        const int tone = static_cast<int>(i * (1 + i / 8000 % 5) % 219) * 128 - 13952;
        const int product = tone * std::max(1000, 6000 - beat);
        int value = static_cast<int>(std::floor(product / 6000.0));
        if (beat >= 4000 && beat < 5000) {
            value += static_cast<int>(std::floor((static_cast<int>(state >> 16U) - 32768) / 4.0));
        }
        samples[i] = static_cast<float>(value * (i >= 3 * kSecond ? 2 : 1)) / 65536.0F;
    }
    return samples;
}

/// All words that are said, in order.
std::vector<TaggerWord> words_of(std::span<const float> samples, std::size_t block = 160) {
    MusicTagger tagger(shipped_tagger());
    std::vector<TaggerWord> words;
    while (!samples.empty()) {
        const std::size_t count = std::min(block, samples.size());
        if (tagger.process(samples.first(count)) && tagger.word().patches > 0) {
            words.push_back(tagger.word());
        }
        samples = samples.subspan(count);
    }
    return words;
}

float farthest(std::span<const float> a, std::span<const float> b) {
    float most = 0.0F;
    for (std::size_t i = 0; i < a.size(); ++i) {
        most = std::max(most, std::abs(a[i] - b[i]));
    }
    return most;
}

// Absolute: the numbers are about 1, and what is decided with them does not change with .01.
TEST(MusicTagger, says_what_the_reference_says) {
    const auto words = words_of(buzzing(7 * kSecond));
    std::ifstream file(RAKS_SOURCE_DIR "/tests/data/tagger/expected.tsv");
    ASSERT_EQ(words.size(), 2U);
    for (const TaggerWord& word : words) {
        std::string line;
        ASSERT_TRUE(std::getline(file, line));
        std::istringstream numbers(line);
        std::vector<float> expected(kTagFeatures + kTags);
        for (float& number : expected) {
            ASSERT_TRUE(numbers >> number);
        }
        const std::span<const float> all(expected);
        EXPECT_LT(farthest(word.embedding, all.first(kTagFeatures)), 0.01F);
        EXPECT_LT(farthest(word.logits, all.last(kTags)), 0.01F);
    }
}

TEST(MusicTagger, any_partition_gives_the_same_bits) {
    const std::vector<float> samples = buzzing(7 * kSecond);
    const auto words = words_of(samples);
    for (const std::size_t block : {1U, 77U, 256U, 4096U}) {
        const auto again = words_of(samples, block);
        ASSERT_EQ(again.size(), words.size()) << block;
        for (std::size_t i = 0; i < words.size(); ++i) {
            EXPECT_EQ(again[i].embedding, words[i].embedding) << block;
            EXPECT_EQ(again[i].logits, words[i].logits) << block;
        }
    }
}

TEST(MusicTagger, twelve_decibels_less_say_the_same) {
    std::vector<float> samples = buzzing(7 * kSecond);
    const auto words = words_of(samples);
    std::transform(samples.begin(), samples.end(), samples.begin(), [](float sample) {
        return sample / 4.0F;
    });
    const auto quiet = words_of(samples);
    ASSERT_EQ(quiet.size(), words.size());
    for (std::size_t i = 0; i < words.size(); ++i) {
        EXPECT_LT(farthest(quiet[i].logits, words[i].logits), 1e-4F);  // a single's rounding
    }
}

TEST(MusicTagger, the_mean_is_of_all_patches_so_far) {
    const auto words = words_of(buzzing(10 * kSecond));
    ASSERT_EQ(words.size(), 3U);
    for (std::size_t i = 0; i < kTags; ++i) {
        const float mean = (words[0].logits[i] + words[1].logits[i] + words[2].logits[i]) / 3.0F;
        EXPECT_NEAR(words[2].mean_logits[i], mean, 1e-5F);
    }
    EXPECT_EQ(words[2].patches, 3U);
}

TEST(MusicTagger, nothing_is_allocated) {
    MusicTagger tagger(shipped_tagger());
    const std::vector<float> samples = buzzing(4 * kSecond);
    raks::test::RealtimeScope scope;
    tagger.process(samples);
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_EQ(tagger.word().patches, 1U);
}

TEST(MusicTagger, silence_says_nothing_and_ends_the_music) {
    MusicTagger tagger(shipped_tagger());
    const std::vector<float> music = buzzing(kPatchSamples);
    const std::vector<float> silence(4 * kSecond);
    EXPECT_FALSE(tagger.process(silence));
    EXPECT_TRUE(tagger.process(music));
    const TaggerWord first = tagger.word();
    EXPECT_EQ(first.patches, 1U);
    EXPECT_TRUE(tagger.process(silence)) << "the word is taken back";
    EXPECT_EQ(tagger.word().patches, 0U);
    // What follows is heard as if nothing had been before it.
    EXPECT_TRUE(tagger.process(music));
    EXPECT_EQ(tagger.word().patches, 1U);
    EXPECT_EQ(tagger.word().logits, first.logits);
}

TEST(MusicTagger, reset_forgets_what_was_heard) {
    MusicTagger tagger(shipped_tagger());
    std::vector<float> samples = buzzing(4 * kSecond);
    tagger.process(samples);
    tagger.reset();
    tagger.process(samples);
    EXPECT_EQ(tagger.word().patches, 1U);
    EXPECT_EQ(tagger.word().logits, words_of(samples).front().logits);
}

// The bits of a machine with AVX-512 and of one without: each lane is added up by itself.
TEST(MusicTagger, the_bits_are_those_of_every_machine) {
    const auto words = words_of(buzzing(4 * kSecond));
    ASSERT_EQ(words.size(), 1U);
    const auto* const bytes = reinterpret_cast<const char*>(words[0].logits.data());
    EXPECT_EQ(hash_of({bytes, sizeof words[0].logits}), 6567010850473204176U);
}

TaggerHop hop_of(std::span<const float> samples, HopIndex hop) {
    TaggerHop made;
    made.hop = hop;
    const auto from = samples.subspan(static_cast<std::size_t>(hop) * TaggerHop::kSamples);
    std::copy_n(from.begin(), TaggerHop::kSamples, made.samples.begin());
    return made;
}

TEST(HopTagger, a_gap_drops_the_patch_and_a_jump_the_music) {
    const std::vector<float> samples = buzzing(20 * kSecond);
    HopTagger tagger(shipped_tagger());
    HopIndex hop = 0;
    const auto hear_until = [&](HopIndex end) {
        for (; hop < end; ++hop) {
            tagger.hear(hop_of(samples, hop));
        }
    };
    hear_until(300);
    EXPECT_EQ(tagger.word().patches, 1U);
    EXPECT_EQ(tagger.word().until, time_of_hop(300));  // 187 x 256 samples are 299.2 hops
    hear_until(500);
    hop = 510;
    hear_until(809);
    EXPECT_EQ(tagger.word().patches, 1U) << "the patch began anew at 510";
    hear_until(810);
    EXPECT_EQ(tagger.word().patches, 2U);
    TaggerHop jump = hop_of(samples, hop++);
    jump.is_other_music = true;
    tagger.hear(jump);
    EXPECT_EQ(tagger.word().patches, 0U);
}

/// Keeps what it is given, and when it said something.
class KeepHops final : public TagSource {
 public:
    void hear(const TaggerHop& hop) noexcept RAKS_NONBLOCKING override {
        RAKS_TRUSTED(hops.push_back(hop));  // a test's
    }
    [[nodiscard]] const TaggerWord& word() noexcept RAKS_NONBLOCKING override { return word_; }
    std::vector<TaggerHop> hops;

 private:
    TaggerWord word_;
};

TEST(TagSource, an_analyzer_lets_it_hear_every_hop_at_16_kilohertz) {
    AnalyzerConfig config{.sample_rate = SampleRate(48'000)};
    const auto source = std::make_shared<KeepHops>();
    config.tags = source;
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(config));
    // 1 kHz at half of full scale, then a gap, then a jump.
    std::vector<float> tone(48'000);
    for (std::size_t i = 0; i < tone.size(); ++i) {
        tone[i] = 0.5F * std::sin(static_cast<float>(i % 48) * 2.0F * 3.14159265F / 48.0F);
    }
    test::Collect collect;
    analyzer.process(tone, collect);
    ASSERT_GT(source->hops.size(), 90U);
    for (std::size_t i = 0; i < source->hops.size(); ++i) {
        EXPECT_EQ(source->hops[i].hop, static_cast<HopIndex>(i));
        EXPECT_EQ(source->hops[i].is_other_music, i == 0);
        if (i > 2) {
            EXPECT_NEAR(mean_square(source->hops[i].samples), 0.125, 1e-3) << i;
        }
    }
    analyzer.skip(std::chrono::milliseconds(500));
    analyzer.process(tone, collect);
    EXPECT_GT(source->hops.back().hop, static_cast<HopIndex>(source->hops.size()) + 40);
    EXPECT_FALSE(source->hops.back().is_other_music);
    const std::size_t before = source->hops.size();
    analyzer.skip(Nanos(0));
    analyzer.process(tone, collect);
    ASSERT_GT(source->hops.size(), before);
    EXPECT_TRUE(source->hops[before].is_other_music);
}

// What the next test runs under callgrind.
TEST(TaggerCost, DISABLED_twenty_seconds) {
    MusicTagger tagger(shipped_tagger());
    tagger.process(buzzing(20 * kSecond));
    EXPECT_EQ(tagger.word().patches, 6U);
}

TEST(TaggerCost, twenty_seconds_take_few_instructions) {
    if (const std::string reason = raks::test::no_instruction_count(); !reason.empty()) {
        GTEST_SKIP() << reason;
    }
    const long long instructions = raks::test::instructions_in(
        "raks::audio::MusicTagger::process*", "TaggerCost.DISABLED_twenty_seconds");
    EXPECT_LT(instructions, 400'000'000) << instructions;
    EXPECT_GT(instructions, 100'000'000) << "was it counted?";
}

}  // namespace
}  // namespace raks::audio
