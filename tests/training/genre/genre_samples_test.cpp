#include "training/genre/genre_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/random.hpp"
#include "tests/support/damaged_file.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"
#include "training/genre/network_trainer.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMel = BarPatterns::kMelBands;

PieceFeatures made_piece(const std::string& genre,
                         int number,
                         PieceFeatures::Kind kind,
                         std::size_t hops = 1'500) {
    PieceFeatures piece;
    piece.name = genre + " " + std::to_string(number);
    piece.group = "artist " + std::to_string(number % 5);
    piece.genre = genre;
    piece.kind = kind;
    const CounterRandom random(static_cast<std::uint64_t>(number), 3);
    std::uint64_t draw = 0;
    piece.frames.resize(hops);
    for (MfccVector& frame : piece.frames) {
        for (float& value : frame) {
            value = static_cast<float>(8.0 * random.normal(draw++));
        }
    }
    piece.mel.resize(hops * kMel);
    for (float& value : piece.mel) {
        value = static_cast<float>(std::exp(3.0 * random.normal(draw++)));
    }
    for (int end = 100; end <= static_cast<int>(hops); end += 100) {
        for (const int segments : kGenreWindows) {
            if (segments * BarPatterns::kSegmentHops <= end) {
                WindowFeatures& window = piece.windows.emplace_back();
                window.segments = segments;
                window.end_frame = end;
                for (float& value : window.features) {
                    value = static_cast<float>(random.normal(draw++));
                }
            }
        }
    }
    return piece;
}

std::vector<const PieceFeatures*> pointers(const std::vector<PieceFeatures>& pieces) {
    std::vector<const PieceFeatures*> all;
    all.reserve(pieces.size());
    for (const PieceFeatures& piece : pieces) {
        all.push_back(&piece);
    }
    return all;
}

GenreSamples small_samples() {
    GenreSamples samples;
    samples.feature_key = "features";
    samples.genres = {"salsa", "rock"};
    models::RecurrentNetwork network({NetworkInput::kSize, 4, 1, 3});
    for (std::size_t i = 0; i < network.parameters().size(); ++i) {
        network.parameters()[i] = 0.01F * static_cast<float>(i % 97);
    }
    samples.written_networks = {std::make_shared<const models::RecurrentNetwork>(network)};
    network.parameters()[3] = -2.0F;
    samples.written_networks.push_back(std::make_shared<const models::RecurrentNetwork>(network));
    samples.pieces = {made_piece("salsa", 1, PieceFeatures::Kind::recorded, 200),
                      made_piece("", 2, PieceFeatures::Kind::written, 150)};
    return samples;
}

TEST(GenreSamples, stay_within_their_bytes_and_take_groups_in_turn) {
    std::vector<PieceFeatures> pieces;
    pieces.reserve(32);
    for (int i = 0; i < 30; ++i) {
        pieces.push_back(made_piece(
            "salsa", i, i < 20 ? PieceFeatures::Kind::recorded : PieceFeatures::Kind::written));
    }
    pieces.push_back(made_piece("rock", 1, PieceFeatures::Kind::recorded));
    pieces.push_back(PieceFeatures{});  // mel alone, as the beat tracker's corpus has: passed over
    constexpr std::size_t kBytes = 1'200'000;
    const auto sample =
        sample_pieces(pointers(pieces), std::vector<std::string>{"salsa", "rock"}, kBytes, 1);
    std::set<std::string> artists;
    int written = 0;
    int salsa = 0;
    for (const PieceFeatures& stretch : sample) {
        EXPECT_LE(stretch.frames.size(), 1'200U);
        EXPECT_EQ(stretch.mel.size(), stretch.frames.size() * kMel);
        for (const WindowFeatures& window : stretch.windows) {
            EXPECT_GE(window.end_frame, window.segments * BarPatterns::kSegmentHops);
            EXPECT_LE(window.end_frame, static_cast<int>(stretch.frames.size()));
        }
        if (stretch.genre == "salsa") {
            artists.insert(stretch.group);
            written += stretch.is_recorded() ? 0 : 1;
            ++salsa;
        }
    }
    EXPECT_EQ(artists.size(), 5U);
    EXPECT_GE(salsa, 8);
    EXPECT_NEAR(written, 0.5 * salsa, 1.0);
    EXPECT_EQ(static_cast<int>(sample.size()) - salsa, 1) << "rock has one piece";
    const raks::test::TemporaryFolder folder;
    const fs::path file = folder / "samples";
    GenreSamples samples = small_samples();
    samples.pieces = sample;
    ASSERT_TRUE(save_samples(samples, file));
    EXPECT_LT(fs::file_size(file), 2 * kBytes);
    EXPECT_GT(fs::file_size(file), kBytes);
}

TEST(GenreSamples, read_back_as_they_were_but_for_8_bits) {
    const raks::test::TemporaryFolder folder;
    const fs::path file = folder / "samples";
    const GenreSamples samples = small_samples();
    ASSERT_TRUE(save_samples(samples, file));
    const auto read = load_samples(file);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->feature_key, samples.feature_key);
    EXPECT_EQ(read->genres, samples.genres);
    ASSERT_EQ(read->written_networks.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        const auto was = samples.written_networks[i]->parameters();
        const auto is = read->written_networks[i]->parameters();
        EXPECT_TRUE(std::equal(is.begin(), is.end(), was.begin(), was.end()));
    }
    ASSERT_EQ(read->pieces.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        const PieceFeatures& was = samples.pieces[i];
        const PieceFeatures& is = read->pieces[i];
        EXPECT_EQ(is.name, was.name);
        EXPECT_EQ(is.kind, was.kind);
        ASSERT_EQ(is.frames.size(), was.frames.size());
        ASSERT_EQ(is.windows.size(), was.windows.size());
        for (std::size_t t = 0; t < was.frames.size(); ++t) {
            for (std::size_t c = 0; c < kMfccFeatures; ++c) {
                // Half a step of 8 bits between extremes of a normal of deviation 8.
                ASSERT_NEAR(is.frames[t][c], was.frames[t][c], 0.13F);
            }
        }
        for (std::size_t k = 0; k < was.mel.size(); ++k) {
            ASSERT_NEAR(std::log(is.mel[k]), std::log(was.mel[k]), 0.06F);
        }
        for (std::size_t w = 0; w < was.windows.size(); ++w) {
            EXPECT_EQ(is.windows[w].end_frame, was.windows[w].end_frame);
            ASSERT_NEAR(is.windows[w].features[7], was.windows[w].features[7], 0.02F);
        }
    }
}

TEST(GenreSamples, cut_and_mangled_files_are_refused_or_read_without_harm) {
    const raks::test::TemporaryFolder folder;
    const fs::path file = folder / "samples";
    GenreSamples samples = small_samples();
    samples.pieces.front().windows.resize(1);
    ASSERT_TRUE(save_samples(samples, file));
    const auto bytes = read_file(file);
    ASSERT_TRUE(bytes);
    const CounterRandom random(21);
    for (std::uint64_t i = 0; i < 200; ++i) {
        const std::size_t size =
            i < 100 ? static_cast<std::size_t>(i) : random.below(i, bytes->size());
        raks::test::write_damaged(file, std::string_view(*bytes).substr(0, size));
        const auto read = load_samples(file);
        ASSERT_FALSE(read) << size;
        EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
    }
    for (std::uint64_t i = 0; i < 300; ++i) {
        const std::size_t reach = i % 2 == 0 ? 120 : bytes->size();
        raks::test::write_damaged(
            file, raks::test::mangled(*bytes, {.seed = i, .bytes = 4, .reach = reach}));
        if (const auto read = load_samples(file)) {
            for (const PieceFeatures& piece : read->pieces) {
                for (const float value : piece.mel) {
                    ASSERT_TRUE(std::isfinite(value));
                }
            }
        }
    }
    ASSERT_TRUE(write_file(file, "raks-genre-samples-7\n..."));
    EXPECT_EQ(load_samples(file).error().message,
              file.string() + ": is of another version of this program; train the model again");
}

TEST(GenreSamples, a_new_output_begins_with_half_of_what_is_none_of_them) {
    const GenreSamples samples = small_samples();
    const std::vector<std::string> genres = {"salsa", "belly", "rock"};
    const auto widened = with_outputs(samples.written_networks, samples.genres, genres);
    ASSERT_EQ(widened.size(), 2U);
    const models::RecurrentNetwork& wide = *widened[0];
    ASSERT_EQ(wide.outputs(), 4U);
    std::vector<float> input(NetworkInput::kSize, 0.3F);
    models::RecurrentStream narrow_stream;
    models::RecurrentStream wide_stream;
    const auto chances = [](const models::RecurrentStream::Logits& logits, std::size_t count) {
        std::vector<float> result;
        float sum = 0.0F;
        for (std::size_t i = 0; i < count; ++i) {
            sum += result.emplace_back(std::exp(logits[i]));
        }
        for (float& chance : result) {
            chance /= sum;
        }
        return result;
    };
    for (int hop = 0; hop < 20; ++hop) {
        const auto before = chances(narrow_stream.next(*samples.written_networks[0], input), 3);
        const auto after = chances(wide_stream.next(wide, input), 4);
        EXPECT_NEAR(after[0], before[0], 1e-5F);
        EXPECT_NEAR(after[2], before[1], 1e-5F);
        EXPECT_NEAR(after[1], 0.5F * before[2], 1e-5F);
        EXPECT_NEAR(after[3], 0.5F * before[2], 1e-5F);
    }
}

}  // namespace
}  // namespace raks::audio
