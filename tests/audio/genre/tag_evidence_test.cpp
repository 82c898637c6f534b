#include "audio/genre/tag_evidence.hpp"

#include <gtest/gtest.h>

#include "tests/audio/genre/small_genre_model.hpp"
#include "tests/base/source_tree.hpp"
#include "tests/support/dances.hpp"

namespace raks::audio {
namespace {

const GenreWords& table() {
    static const GenreWords shipped =
        load_genre_words(raks::test::kSourceTree / "config" / "genres.toml",
                         raks::test::shipped_dances()->names())
            .value();
    return shipped;
}

using Dances = std::vector<std::pair<std::string, float>>;

TEST(TagEvidence, is_shared_out_among_the_genres_of_a_tag) {
    const struct {
        std::string_view genre;
        Dances dances;
    } cases[] = {
        {"Salsa", {{"salsa", 1.5F}}},
        {"Salsa/Latin", {{"salsa", 1.5F}}},
        {"Electronic; House", {{"house", 1.5F}}},
        {std::string_view("Electronic\0House", 16), {{"house", 1.5F}}},
        {"House, Rock", {{"house", 0.75F}, {"rock", 0.75F}}},
        {"(17)", {{"rock", 1.5F}}},
        {"17", {{"rock", 1.5F}}},
        {"(17)(7)", {{"rock", 0.75F}, {"hiphop", 0.75F}}},
        {"(17)Rock", {{"rock", 1.5F}}},
        {"[143]", {{"salsa", 1.5F}}},
        {"Disco", {{"fallback", 1.5F}}},
        {"(255)", {}},
        {"99999999999999999999", {}},
        {"-1", {}},
        {"", {}},
        {"Other", {}},
        {"Rock Opera", {}},
        {"\xFF\xFE\x01 \x1B[31m", {}},
    };
    for (const auto& c : cases) {
        EXPECT_EQ(evidence_of({.genre = c.genre}, table()).dances, c.dances) << c.genre;
    }
}

TEST(TagEvidence, titles_count_less_and_only_by_words_that_tell) {
    EXPECT_EQ(evidence_of({.album = "Salsa Hits"}, table()).dances, (Dances{{"salsa", 0.6F}}));
    EXPECT_EQ(evidence_of({.title = "House of the Rising Son", .artist = "Rap"}, table()).dances,
              Dances());
    EXPECT_EQ(evidence_of({.genre = "Latin", .album = "Salsa Hits"}, table()).dances,
              (Dances{{"salsa", kGenreTagStrength}}))
        << "bounded";
    const TagEvidence both =
        evidence_of({.genre = "Classical", .title = "Valse no. 2 (17)"}, table());
    EXPECT_EQ(both.dances, (Dances{{"fallback", 1.5F}, {"waltz", 0.6F}}));
    EXPECT_EQ(both.words, (std::vector<std::string>{"classical", "valse"}));
    EXPECT_EQ(both.dance(), "fallback");
    EXPECT_EQ(TagEvidence().dance(), "");
}

TEST(TagEvidence, says_the_words_of_the_table_and_never_the_files) {
    const TagEvidence evidence = evidence_of({.genre = "SALSA\x1B[31m;\nhip_hop\x07"}, table());
    EXPECT_EQ(evidence.words, (std::vector<std::string>{"salsa", "hip hop"}));
}

TEST(TagEvidence, of_a_huge_tag_is_of_its_beginning) {
    std::string many;
    for (int i = 0; i < 10'000; ++i) {
        many += "Salsa; ";
    }
    EXPECT_EQ(evidence_of({.genre = many}, table()).dances.size(), 1U);
    EXPECT_NEAR(evidence_of({.genre = many}, table()).dances[0].second, 1.5F, 1e-3);
    const std::string big(std::size_t{1} << 20U, 'x');
    EXPECT_EQ(evidence_of({big, big, big, big}, table()).dances, Dances());
}

TEST(TagEvidence, is_a_prior_by_the_models_classes) {
    const GenreModel model = test::small_genre_model();  // salsa, house, none of them
    const auto prior = [&](std::string_view genre) {
        const GenreLogProbabilities all = prior_of(evidence_of({.genre = genre}, table()), model);
        for (std::size_t i = 3; i < all.size(); ++i) {
            EXPECT_EQ(all[i], 0.0F);
        }
        return std::array{all[0], all[1], all[2]};
    };
    EXPECT_EQ(prior("Techno"), (std::array{0.0F, 1.5F, 0.0F}));
    EXPECT_EQ(prior("Pop"), (std::array{0.0F, 0.0F, 1.5F}));
    EXPECT_EQ(prior("Rock"), (std::array{0.0F, 0.0F, 1.5F})) << "the model does not know it";
    EXPECT_EQ(prior("Rock; Pop; Waltz"), (std::array{0.0F, 0.0F, 1.5F}));
    EXPECT_EQ(prior("nothing"), (std::array{0.0F, 0.0F, 0.0F}));
}

}  // namespace
}  // namespace raks::audio
