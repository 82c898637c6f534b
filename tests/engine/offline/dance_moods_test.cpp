// Faces of whole dances, from sound to feelings.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "engine/offline/offline_driver.hpp"
#include "engine/setup/dancers.hpp"
#include "engine/setup/settings.hpp"
#include "motion/skeleton/feeling.hpp"
#include "tests/engine/installed.hpp"
#include "tests/support/sanitized.hpp"

namespace raks::engine::dance_moods_test {
namespace {

using motion::Emotion;
using motion::Feeling;

constexpr double kDanced = 60.0;      // seconds that are judged
constexpr double kHeardBefore = 4.0;  // seconds until the beat is surely known
constexpr float kSeen = 0.3F;         // of an emotion
constexpr std::size_t kSeenFor = 40;  // hops

struct DanceAndMusic {
    const char* dance;
    audio::Style style;
    double bpm;
};

class Felt final : public OfflineDriver::Sink {
 public:
    void on_hop(const PerformedHop& hop) override {
        if (to_seconds(hop.music.time.time_since_epoch()) >= kHeardBefore) {
            feelings.push_back(hop.track.feeling_at(hop.music.time));
        }
    }
    std::vector<Feeling> feelings;
};

std::vector<Feeling> danced(const DanceAndMusic& one, std::int64_t seed) {
    constexpr SampleRate kRate(48'000);
    audio::MusicPlan plan;
    plan.style = one.style;
    plan.tempo = {{0.0, one.bpm}};
    plan.seconds = kHeardBefore + kDanced;
    plan.rate = kRate;
    plan.channels = 1;
    const auto made = audio::generate(plan);
    EXPECT_TRUE(made);
    Settings settings;
    settings.dance = one.dance;
    settings.seed = seed;
    auto dancers = Dancers::load(settings, installed::dances(), {motion::mannequin_skeleton()});
    EXPECT_TRUE(dancers) << dancers.error().message;
    auto driver = OfflineDriver::create(kRate, installed::models(), dancers->cast());
    EXPECT_TRUE(driver) << driver.error().message;
    Felt felt;
    driver->feed(made->mono(), felt);
    return felt.feelings;
}

/// For each hop whether an emotion is seen there, for long enough.
std::vector<bool> seen(const std::vector<Feeling>& felt, Emotion emotion) {
    std::vector<bool> is_seen(felt.size(), false);
    std::size_t since = 0;
    for (std::size_t i = 0; i < felt.size(); ++i) {
        since = felt[i].of(emotion) >= kSeen ? since + 1 : 0;
        if (since >= kSeenFor) {
            std::fill_n(is_seen.begin() + static_cast<std::ptrdiff_t>(i + 1 - since), since, true);
        }
    }
    return is_seen;
}

class DanceMoods : public ::testing::TestWithParam<DanceAndMusic> {};

TEST_P(DanceMoods, four_are_seen_within_a_minute_and_the_base_alone_for_less_than_six_seconds) {
    if (raks::test::kIsSanitized && GetParam().style != audio::Style::montuno) {
        GTEST_SKIP() << "salsa does it under a sanitizer";
    }
    const Emotion base = installed::dances().find(GetParam().dance)->mood.base;
    const std::vector<Feeling> felt = danced(GetParam(), 1);
    int moods = 0;
    std::vector<bool> is_other(felt.size(), false);
    for (std::size_t e = 0; e < motion::kEmotionCount; ++e) {
        const std::vector<bool> own = seen(felt, static_cast<Emotion>(e));
        moods += std::find(own.begin(), own.end(), true) != own.end() ? 1 : 0;
        for (std::size_t i = 0; i < own.size(); ++i) {
            is_other[i] = is_other[i] || (own[i] && static_cast<Emotion>(e) != base);
        }
    }
    std::size_t alone = 0;
    std::size_t longest = 0;
    for (const bool other : is_other) {
        alone = other ? 0 : alone + 1;
        longest = std::max(longest, alone);
    }
    EXPECT_GE(moods, 4);
    EXPECT_LT(longest, 600U);
    for (std::size_t i = 1; i < felt.size(); ++i) {
        for (std::size_t e = 0; e < motion::kEmotionCount; ++e) {
            ASSERT_LT(std::abs(felt[i].emotions[e] - felt[i - 1].emotions[e]), 0.05F) << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All,
                         DanceMoods,
                         ::testing::Values(DanceAndMusic{"salsa", audio::Style::montuno, 180.0},
                                           DanceAndMusic{"belly", audio::Style::maqsum, 110.0},
                                           DanceAndMusic{
                                               "house", audio::Style::four_on_the_floor, 124.0},
                                           DanceAndMusic{"rock", audio::Style::backbeat, 124.0},
                                           DanceAndMusic{"hiphop", audio::Style::boom_bap, 94.0},
                                           DanceAndMusic{"waltz", audio::Style::oom_pah_pah, 90.0}),
                         [](const auto& one) { return std::string(one.param.dance); });

}  // namespace
}  // namespace raks::engine::dance_moods_test
