// Learning what the tagger's numbers say of dances, of numbers whose meaning is known.
#include "training/genre/tagger_trainer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/random.hpp"

namespace raks::audio {
namespace {

const std::vector<std::string> kGenres = {"house", "hiphop"};

// Pieces of both dances and of none; the number of a class is drawn about 1, all others about 0.
std::vector<TaggedPiece> made_pieces() {
    std::vector<TaggedPiece> pieces;
    const CounterRandom random(1, 1);
    std::uint64_t draw = 0;
    for (int i = 0; i < 60; ++i) {
        const std::size_t own = static_cast<std::size_t>(i) % 3;
        TaggedPiece& piece = pieces.emplace_back();
        piece.genre = own < kGenres.size() ? kGenres[own] : "";
        piece.group = std::to_string(i / 2);
        piece.patches.resize(4);
        for (auto& patch : piece.patches) {
            for (std::size_t f = 0; f < kTagFeatures; ++f) {
                patch[f] = static_cast<float>(0.3 * random.normal(draw++));
            }
            patch[own] += 1.0F;
        }
    }
    return pieces;
}

std::vector<const TaggedPiece*> pointers_to(const std::vector<TaggedPiece>& pieces) {
    std::vector<const TaggedPiece*> pointers(pieces.size());
    std::transform(pieces.begin(), pieces.end(), pointers.begin(), [](const TaggedPiece& piece) {
        return &piece;
    });
    return pointers;
}

TEST(TaggerTrainer, tells_what_its_numbers_tell_of_groups_it_has_not_heard) {
    const std::vector<TaggedPiece> pieces = made_pieces();
    const auto held_out = held_out_tagger(pieces, kGenres);
    ASSERT_TRUE(held_out) << held_out.error().message;
    std::size_t right = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const auto& logs = (*held_out)[i];
        const auto best = std::max_element(logs.begin(), logs.end()) - logs.begin();
        right += static_cast<std::size_t>(best) == i % 3 ? 1 : 0;
    }
    EXPECT_GE(right, 57U);
}

// Pieces of one dance that the classes took for the other: a few move them a little, many more.
TEST(TaggerTrainer, classes_are_moved_towards_further_pieces_as_far_as_those_say) {
    const std::vector<TaggedPiece> pieces = made_pieces();
    const std::vector<const TaggedPiece*> all = pointers_to(pieces);
    const auto base = fit_tagger(all, kGenres);
    ASSERT_TRUE(base);
    TaggedPiece odd = pieces[0];
    odd.genre = kGenres[1];
    const auto chance_of_truth = [&](const TaggerClasses& tagger, const TaggedPiece& piece) {
        std::vector<float> logs(kGenres.size() + 1);
        tagger.log_chances(piece.patches.front(), logs);
        return logs[piece.genre == kGenres[1] ? 1 : 0];
    };
    float last = chance_of_truth(*base, odd);
    for (const std::size_t count : {std::size_t{1}, std::size_t{20}, std::size_t{400}}) {
        const std::vector<const TaggedPiece*> further(count, &odd);
        const auto moved = adapt_tagger(*base, further, kGenres);
        ASSERT_TRUE(moved) << moved.error().message;
        EXPECT_TRUE(validate(*moved, kGenres.size() + 1));
        EXPECT_EQ(moved->mean, base->mean);
        EXPECT_EQ(moved->knows, base->knows);
        EXPECT_GT(chance_of_truth(*moved, odd), last) << count;
        last = chance_of_truth(*moved, odd);
        if (count == 1) {
            EXPECT_NEAR(chance_of_truth(*moved, pieces[3]), chance_of_truth(*base, pieces[3]), 0.1);
        }
    }
    EXPECT_FALSE(adapt_tagger(*base, {}, kGenres));
    const std::vector<std::string> more = {"house", "hiphop", "rock"};
    EXPECT_FALSE(adapt_tagger(*base, all, more)) << "of other genres";
}

TEST(TaggerTrainer, the_same_pieces_give_the_same_numbers) {
    const std::vector<TaggedPiece> pieces = made_pieces();
    const std::vector<const TaggedPiece*> all = pointers_to(pieces);
    const auto one = fit_tagger(all, kGenres);
    const auto other = fit_tagger(all, kGenres);
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->weights, other->weights);
    EXPECT_TRUE(validate(*one, kGenres.size() + 1));
}

TEST(TaggerTrainer, refuses_music_without_a_patch) {
    const TaggedPiece empty{"house", "a", {}};
    const std::vector<const TaggedPiece*> pieces = {&empty};
    EXPECT_FALSE(fit_tagger(pieces, kGenres));
}

TEST(TaggerTrainer, knows_dances_by_the_words_of_its_tags) {
    EXPECT_TRUE(tagger_knows("house"));
    EXPECT_TRUE(tagger_knows("hiphop"));
    EXPECT_TRUE(tagger_knows("rock"));
    EXPECT_FALSE(tagger_knows("salsa"));
    EXPECT_FALSE(tagger_knows("waltz"));
}

}  // namespace
}  // namespace raks::audio
