#include "audio/genre/genre_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "audio/genre/genre_recognizer.hpp"
#include "tests/audio/genre/small_genre_model.hpp"
#include "tests/support/mangled.hpp"

namespace raks::audio {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string error_of(const std::string& text) {
    const auto model = parse_genre(text);
    EXPECT_FALSE(model);
    return model ? "" : model.error().message;
}

TEST(GenreFile, what_is_written_reads_back) {
    GenreModel model = test::small_genre_model();
    model.similarity = model.background;
    model.features.energy = GenreFeatures::Energy::used;
    model.features.cepstral_mean.start[3] = 1.25F;
    model.attribution = "nobody";
    const std::string text = genre_text(model);
    const auto read = parse_genre(text);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(genre_text(*read), text);
    EXPECT_EQ(read->genres, model.genres);
    EXPECT_EQ(read->features.cepstral_mean.start[3], 1.25F);
    EXPECT_TRUE(read->similarity);
}

TEST(GenreFile, faults_are_said_with_their_field) {
    const std::string good = genre_text(test::small_genre_model());
    EXPECT_EQ(error_of(replaced(good, "raks-genre", "raks-hmm")),
              "not a raks-genre file (no \"format\": \"raks-genre\")");
    EXPECT_EQ(error_of(replaced(good, "htk-39", "kaldi-13")),
              "features.mfcc is 'kaldi-13', this program hears 'htk-39': train the model again");
    EXPECT_EQ(
        error_of(replaced(good, "bar-patterns-2", "bar-patterns-3")),
        "features.patterns is 'bar-patterns-3', this program hears 'bar-patterns-2': train the "
        "model again");
    EXPECT_EQ(
        error_of(replaced(good, "\"salsa\"", "\"pol ka\"")),
        "genres[0]: \"pol ka\" cannot name a dance: letters a-z, digits, '-' and '_', 1 to 40 "
        "of them");
    EXPECT_EQ(error_of(replaced(good, "\"salsa\"", "\"house\"")),
              "genres[1] is house, which is there before");
    EXPECT_EQ(error_of(replaced(good, "\"units\": 4", "\"units\": 5")),
              "rhythm.hidden_weights has 964 numbers, must have 1205");
    EXPECT_EQ(error_of(replaced(good, "\"seconds\": 0.5", "\"seconds\": 0.6")),
              "fusion[0].seconds must be 0.5");
}

/// A file of version 3, with one recurrent network.
std::string text_of_version_3() {
    std::string text =
        replaced(genre_text(test::small_genre_model()), "\"version\": 4", "\"version\": 3");
    const std::size_t begin = text.find("\"networks\"");
    text.replace(begin, text.find('{', begin) - begin, "\"network\": ");
    return text.erase(text.find(']', text.find('}', begin)), 1);
}

/// A file of version 1 or 2: without weights of its own for none of the genres; the first also
/// without a recurrent network.
std::string old_text(int version) {
    std::string text =
        replaced(text_of_version_3(), "\"version\": 3", "\"version\": " + std::to_string(version));
    text.erase(text.find(version == 1 ? "\"network\": {" : "\"fusion\""));
    text += "\"fusion\": [";
    for (const char* const seconds : {"0.5", "1", "3", "5", "10"}) {
        text += std::string(text.back() == '[' ? "" : ",") + "{\"seconds\": " + seconds +
                ", \"mfcc\": 1, \"rhythm\": 0.5, \"sound\": 0.25, \"unknown\": -2" +
                (version == 1 ? "}" : ", \"network\": 0.75}");
    }
    return text + "]}";
}

TEST(GenreFile, version_1_reads_with_a_network_that_has_no_say) {
    const auto read = parse_genre(old_text(1));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->fusion[0].dances.network, 0.0F);
    ASSERT_EQ(read->networks.size(), 1U);
    EXPECT_EQ(read->networks[0].outputs(), 3U);
}

TEST(GenreFile, version_3_reads_with_its_one_network) {
    const auto read = parse_genre(text_of_version_3());
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(genre_text(*read), genre_text(test::small_genre_model()));
}

TEST(GenreFile, networks_are_one_to_four) {
    GenreModel model = test::small_genre_model();
    model.networks.resize(4, model.networks[0]);
    const auto read = parse_genre(genre_text(model));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->networks.size(), 4U);
    model.networks.resize(5, model.networks[0]);
    EXPECT_EQ(error_of(genre_text(model)), "networks has 5 entries, must have 1 to 4");
    model.networks.clear();
    EXPECT_EQ(error_of(genre_text(model)), "networks has 0 entries, must have 1 to 4");
}

TEST(GenreFile, version_2_reads_with_the_same_weights_for_all_classes) {
    const auto read = parse_genre(old_text(2));
    ASSERT_TRUE(read) << read.error().message;
    const GenreFusion& fusion = read->fusion[4];
    EXPECT_EQ(fusion.dances.network, 0.75F);
    EXPECT_EQ(fusion.none.network, 0.75F);
    EXPECT_EQ(fusion.none.rhythm, 0.5F);
    EXPECT_EQ(fusion.offsets, (GenreScores::Values{0.0F, 0.0F, -2.0F}));
}

TEST(GenreFile, a_network_of_another_size_is_refused) {
    const std::string good = genre_text(test::small_genre_model());
    EXPECT_EQ(error_of(replaced(good, "\"layers\": 1", "\"layers\": 2")),
              "networks[0].parameters has 727 numbers, 4 units in 2 layers need 839");
}

TEST(GenreFile, another_feature_size_is_refused) {
    GenreModel model = test::small_genre_model();
    model.features.energy = GenreFeatures::Energy::left_out;
    const auto valid = validate(model);
    ASSERT_FALSE(valid);
    EXPECT_EQ(valid.error().message, "mfcc[0] is of 39 features, the definition has 36");
}

TEST(GenreFile, cut_and_mangled_files_are_refused_or_valid) {
    const std::string good = genre_text(test::small_genre_model());
    // Every 7th offset of 30,000: each field is cut somewhere.
    for (std::size_t size = 0; size < good.size() - 3; size += 7) {
        ASSERT_FALSE(parse_genre(std::string_view(good).substr(0, size))) << size;
    }
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        const auto model = parse_genre(raks::test::mangled(good, {.seed = seed}));
        if (model) {
            EXPECT_TRUE(validate(*model));
        } else {
            EXPECT_FALSE(model.error().message.empty());
            EXPECT_EQ(model.error().message.find('\n'), std::string::npos);
        }
    }
}

}  // namespace
}  // namespace raks::audio
