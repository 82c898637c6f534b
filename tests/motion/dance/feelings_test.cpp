#include "motion/dance/dynamics/feelings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "motion/dance/dynamics/breath.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::motion::feelings_test {
namespace {

constexpr float kSeen = 0.3F;         // of an emotion
constexpr std::size_t kSeenFor = 40;  // hops
constexpr Bpm kTempo{120.0};

MusicState music_at(HopIndex hop, float energy) {
    MusicState music;
    music.hop = hop;
    music.time = time_of_hop(hop);
    music.is_silent = false;
    music.part = MusicPart::playing;
    music.energy = {energy, energy, energy};
    music.grid.tempo = kTempo;
    music.grid.beats_per_bar = 4;
    return music;
}

/// The feelings of a dancer, hop by hop.
struct Felt {
    std::uint64_t seed = 1;
    DanceMood mood{};
    float energy = 0.6F;
    std::vector<std::pair<HopIndex, MusicEvent::Kind>> events{};
    float height = 1.0F;

    [[nodiscard]] std::vector<Feeling> over(double seconds) const {
        Feelings feelings;
        std::vector<Feeling> felt;
        for (HopIndex hop = 0; hop < static_cast<HopIndex>(100.0 * seconds); ++hop) {
            MusicState music = music_at(hop, energy);
            for (const auto& [at, kind] : events) {
                if (at == hop) {
                    music.event = {kind, music.time};
                }
            }
            feelings.advance({.music = music,
                              .mood = mood,
                              .seed = seed,
                              .is_dancing = true,
                              .bar = std::fmod(0.005 * static_cast<double>(hop), 8.0),
                              .energy = energy,
                              .height = hop > 500 ? height : 1.0F});
            felt.push_back(feelings.now());
        }
        return felt;
    }
};

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

/// How many emotions are seen, and for how many hops at most none but the base.
struct Moods {
    int seen = 0;
    std::size_t longest_base = 0;
};

Moods moods_in(const std::vector<Feeling>& felt, Emotion base) {
    Moods moods;
    std::vector<bool> is_other(felt.size(), false);
    for (std::size_t e = 0; e < kEmotionCount; ++e) {
        const std::vector<bool> own = seen(felt, static_cast<Emotion>(e));
        moods.seen += std::find(own.begin(), own.end(), true) != own.end() ? 1 : 0;
        for (std::size_t i = 0; i < own.size(); ++i) {
            is_other[i] = is_other[i] || (own[i] && static_cast<Emotion>(e) != base);
        }
    }
    std::size_t alone = 0;
    for (const bool other : is_other) {
        alone = other ? 0 : alone + 1;
        moods.longest_base = std::max(moods.longest_base, alone);
    }
    return moods;
}

TEST(Feelings, four_moods_a_minute_and_never_the_base_alone_for_six_seconds) {
    for (const Emotion base : {Emotion::relaxed, Emotion::happy, Emotion::angry}) {
        for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
            for (const float energy : {0.2F, 0.6F, 1.0F}) {
                const auto felt =
                    Felt{.seed = seed, .mood = {.base = base}, .energy = energy}.over(60.0);
                const Moods moods = moods_in(felt, base);
                EXPECT_GE(moods.seen, 4) << "seed " << seed << ", energy " << energy;
                EXPECT_LE(moods.longest_base, 600U) << "seed " << seed << ", energy " << energy;
            }
        }
    }
}

TEST(Feelings, are_eased_and_are_together_at_most_one) {
    const auto felt = Felt{.energy = 1.0F,
                           .events = {{1000, MusicEvent::Kind::stop},
                                      {1200, MusicEvent::Kind::entry},
                                      {2000, MusicEvent::Kind::drop}}}
                          .over(40.0);
    for (std::size_t i = 1; i < felt.size(); ++i) {
        float sum = 0.0F;
        for (std::size_t e = 0; e < kEmotionCount; ++e) {
            // A whole emotion takes a fifth of a second at the least.
            EXPECT_LT(std::abs(felt[i].emotions[e] - felt[i - 1].emotions[e]), 0.05F) << i;
            sum += felt[i].emotions[e];
        }
        EXPECT_LE(sum, 1.001F) << i;
        EXPECT_LT(std::abs(felt[i].brows - felt[i - 1].brows), 0.08F) << i;
    }
}

TEST(Feelings, answer_what_the_music_does) {
    const auto felt = Felt{.events = {{1000, MusicEvent::Kind::stop},
                                      {1200, MusicEvent::Kind::entry},
                                      {2000, MusicEvent::Kind::drop}}}
                          .over(30.0);
    EXPECT_GT(felt[1070].of(Emotion::surprised), 0.6F) << "it stops";
    EXPECT_GT(felt[1270].of(Emotion::happy), 0.4F) << "it goes on";
    EXPECT_GT(felt[2100].of(Emotion::happy), 0.5F) << "everything comes in";
}

TEST(Feelings, brighten_with_the_music) {
    const auto happy = [](float energy) {
        double sum = 0.0;
        for (const Feeling& feeling : Felt{.energy = energy}.over(60.0)) {
            sum += static_cast<double>(feeling.of(Emotion::happy));
        }
        return sum;
    };
    EXPECT_GT(happy(1.0F), 1.3 * happy(0.3F));
}

TEST(Feelings, a_deep_body_strains_and_does_not_strain_on_and_on) {
    const auto deep = Felt{.height = 0.75F}.over(40.0);
    const auto upright = Felt{}.over(40.0);
    EXPECT_GT(deep[560].of(Emotion::angry), upright[560].of(Emotion::angry) + 0.3F);
    EXPECT_GT(deep[560].teeth, 0.3F);
    EXPECT_LT(deep[3900].teeth, 0.2F);
}

TEST(Feelings, look_at_the_audience_on_the_first_count_of_a_phrase) {
    const auto felt = Felt{.mood = {.away = 1.0F}}.over(60.0);
    for (const std::size_t phrase : {1U, 2U, 3U}) {
        EXPECT_GT(felt[1600 * phrase + 25].audience, 0.8F);
        EXPECT_LT(felt[1600 * phrase + 800].audience, 0.1F);
    }
}

TEST(Feelings, are_the_same_for_the_same_music_and_others_for_another_seed) {
    const auto one = Felt{.seed = 1}.over(20.0);
    EXPECT_EQ(one, (Felt{.seed = 1}.over(20.0)));
    EXPECT_NE(one, (Felt{.seed = 2}.over(20.0)));
}

TEST(Feelings, of_a_mood_without_any_passing_emotion_stay_what_they_are) {
    const auto felt = Felt{.mood = {.passing = {}}}.over(20.0);
    EXPECT_GT(felt.back().of(Emotion::relaxed), 0.3F);
    EXPECT_TRUE(std::all_of(felt.begin(), felt.end(), [](const Feeling& feeling) {
        return std::isfinite(feeling.of(Emotion::relaxed));
    }));
}

TEST(Feelings, are_real_time_safe) {
    Feelings feelings;
    const DanceMood mood;
    const MusicState music = music_at(5, 0.5F);
    raks::test::RealtimeScope scope;
    for (int i = 0; i < 100; ++i) {
        feelings.advance({.music = music, .mood = mood, .is_dancing = true});
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

/// How far the chest opens within some seconds, radians.
float breath_of(float energy, bool is_still) {
    Breath breath;
    for (int hop = 0; hop < 500; ++hop) {
        breath.advance(energy, is_still);
    }
    float least = 1.0F;
    float most = -1.0F;
    for (HopIndex hop = 0; hop < 700; ++hop) {
        Pose pose;
        breath.apply(time_of_hop(hop), pose);
        const float open = 2.0F * pose.rotation(Bone::chest).x;
        least = std::min(least, open);
        most = std::max(most, open);
    }
    return most - least;
}

TEST(Breath, is_seen_in_calm_dances_and_of_who_stands_and_hidden_by_full_dances) {
    EXPECT_GT(breath_of(0.8F, true), 0.02F);
    EXPECT_GT(breath_of(0.2F, false), 0.015F);
    EXPECT_LT(breath_of(0.9F, false), 0.001F);
}

TEST(Breath, raises_both_shoulders_alike_and_little) {
    Breath breath;
    for (int hop = 0; hop < 500; ++hop) {
        breath.advance(0.0F, true);
    }
    for (HopIndex hop = 0; hop < 700; ++hop) {
        Pose pose;
        breath.apply(time_of_hop(hop), pose);
        EXPECT_FLOAT_EQ(pose.rotation(Bone::left_shoulder).z,
                        -pose.rotation(Bone::right_shoulder).z);
        EXPECT_LT(std::abs(2.0F * pose.rotation(Bone::left_shoulder).z), 0.035F) << "2 degrees";
    }
}

}  // namespace
}  // namespace raks::motion::feelings_test
