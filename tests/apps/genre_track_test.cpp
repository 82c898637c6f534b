#include "apps/reports/genre_track.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace raks::apps {
namespace {

constexpr std::size_t kSalsa = 0;
constexpr std::size_t kHouse = 1;
constexpr std::size_t kNone = 2;
constexpr auto kHeard = static_cast<std::size_t>(GenreVoice::heard);

TEST(ShownDanceTally, counts_wrong_dances_from_5_s_and_right_ones_from_10_s_on) {
    ShownDanceTally tally(0, kNone);
    for (int hop = 0; hop < 2'000; ++hop) {
        const double seconds = 0.01 * hop;
        tally.add(seconds, seconds < 2.0 ? kNone : seconds < 6.5 ? 1U : 0U);
    }
    const ShownDance shown = tally.result();
    EXPECT_EQ(shown.switches, 1) << "what follows none of them is no switch";
    EXPECT_NEAR(shown.wrong_share, 0.1, 0.001);
    EXPECT_DOUBLE_EQ(shown.right_share, 1.0);
    EXPECT_EQ(shown.at_end, 0U);
}

// A decision by what is heard: the dance that is shown, and its chance.
void decide(GenreTrack& track, double seconds, std::size_t shown, double chance) {
    GenreStep& step = track.steps.emplace_back();
    step.seconds = seconds;
    step.shown[kHeard] = shown;
    step.logs[kHeard].fill(-20.0F);
    step.logs[kHeard][shown] = static_cast<float>(std::log(chance));
}

TEST(ShownClaims, are_the_decisions_from_5_s_on_that_show_a_dance) {
    GenreTrack track;
    track.genres = {"salsa", "house"};
    decide(track, 4.9, kSalsa, 0.95);
    decide(track, 5.0, kHouse, 0.45);
    decide(track, 5.1, kNone, 0.90);
    decide(track, 5.2, kSalsa, 0.75);
    const std::vector<audio::Claim> claims = shown_claims(track, GenreVoice::heard, kSalsa);
    ASSERT_EQ(claims.size(), 2U);
    EXPECT_FALSE(claims[0].is_right);
    EXPECT_NEAR(claims[0].confidence, 0.45, 1e-5);
    EXPECT_TRUE(claims[1].is_right);
    EXPECT_NEAR(claims[1].confidence, 0.75, 1e-5);
}

TEST(ShownClaims, no_dance_is_right_for_music_that_is_for_none) {
    GenreTrack track;
    track.genres = {"salsa", "house"};
    decide(track, 8.0, kHouse, 0.6);
    decide(track, 8.1, kNone, 0.6);
    const std::vector<audio::Claim> claims = shown_claims(track, GenreVoice::heard, kNone);
    ASSERT_EQ(claims.size(), 1U);
    EXPECT_FALSE(claims[0].is_right);
}

}  // namespace
}  // namespace raks::apps
