#include "training/genre/fusion_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kClasses = 3;  // two dances, then none

/// Sound tells the two dances apart and hears none of them as the first; rhythm tells what is none
/// and knows nothing of the dances.
std::vector<WindowScore> two_experts() {
    const CounterRandom random(3);
    std::vector<WindowScore> scores;
    std::uint64_t draw = 0;
    for (std::size_t i = 0; i < 240; ++i) {
        WindowScore& score = scores.emplace_back();
        score.piece = i;
        score.truth = i % kClasses;
        score.window = 3;
        const std::size_t sounds_like = score.truth == 2 ? 0 : score.truth;
        for (std::size_t c = 0; c < kClasses; ++c) {
            const bool is_none = score.truth == 2;
            score.sound[c] =
                static_cast<float>((c == sounds_like ? 1.5 : 0.0) + 0.5 * random.normal(draw++));
            score.rhythm[c] =
                static_cast<float>(((c == 2) == is_none ? 1.5 : 0.0) + 0.5 * random.normal(draw++));
        }
        normalize_logs(std::span(score.sound).first(kClasses));
        normalize_logs(std::span(score.rhythm).first(kClasses));
    }
    return scores;
}

double share_right(const std::vector<WindowScore>& scores,
                   const GenreFusion& fusion,
                   GenreEvidence evidence) {
    const auto right = std::count_if(scores.begin(), scores.end(), [&](const auto& score) {
        const auto logs = fuse(score, fusion, evidence, kClasses);
        return static_cast<std::size_t>(std::max_element(logs.begin(), logs.begin() + kClasses) -
                                        logs.begin()) == score.truth;
    });
    return static_cast<double>(right) / static_cast<double>(scores.size());
}

TEST(GenreFusion, listens_to_each_expert_for_what_it_knows) {
    const auto scores = two_experts();
    const GenreFusion fusion = fit_fusion(scores, 3, kClasses, GenreEvidence::fused);
    EXPECT_GT(fusion.dances.sound, 2.0F * fusion.none.sound);
    EXPECT_GT(share_right(scores, fusion, GenreEvidence::fused), 0.95);
    for (const auto evidence : {GenreEvidence::sound, GenreEvidence::rhythm}) {
        const GenreFusion alone = fit_fusion(scores, 3, kClasses, evidence);
        EXPECT_LT(share_right(scores, alone, evidence), 0.8);
    }
}

TEST(GenreFusion, chances_add_up_to_one_and_offsets_raise_their_class) {
    const auto scores = two_experts();
    GenreFusion fusion{{.mfcc = 0.5F}, {.mfcc = 0.5F}, {}};
    const auto before = fuse(scores[0], fusion, GenreEvidence::fused, kClasses);
    double sum = 0.0;
    for (std::size_t c = 0; c < kClasses; ++c) {
        sum += std::exp(static_cast<double>(before[c]));
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
    fusion.offsets[1] = 1.0F;
    EXPECT_GT(fuse(scores[0], fusion, GenreEvidence::fused, kClasses)[1], before[1]);
}

TEST(GenreFusion, without_windows_of_this_length_the_default_weights_stay) {
    const GenreFusion fusion = fit_fusion({}, 3, kClasses, GenreEvidence::sound);
    EXPECT_EQ(fusion.dances.sound, 1.0F);
    EXPECT_EQ(fusion.dances.rhythm, 0.0F);
    EXPECT_EQ(fusion.offsets, GenreScores::Values{});
}

}  // namespace
}  // namespace raks::audio
