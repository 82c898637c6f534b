#include "training/genre/feature_shard.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/random.hpp"
#include "tests/support/damaged_file.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

PieceFeatures small_piece(const std::string& name) {
    PieceFeatures piece;
    piece.name = name;
    piece.group = "artist of " + name;
    piece.genre = "salsa";
    piece.frames.resize(60);
    piece.mel.resize(60 * BarPatterns::kMelBands, 2.0F);
    piece.windows.push_back({.segments = 1, .end_frame = 50});
    return piece;
}

/// Three recordings, the second cannot be read, and a chunk of written pieces.
FeatureShard shard_of(ShardNumber share) {
    FeatureShard shard{share, "plan", "raks train genre music", {}};
    shard.material.written_with = "written. ";
    for (const char* const name : {"a", "b", "c"}) {
        shard.material.files.push_back(
            {name, name, "salsa", "artist", "A", true, "credit of " + std::string(name)});
    }
    shard.material.units.resize(4);
    for (std::size_t i = 0; i < shard.material.units.size(); ++i) {
        if (share.has(i) && i != 1) {
            shard.material.units[i].pieces = {small_piece("piece " + std::to_string(i))};
        } else if (share.has(i)) {
            shard.material.units[i].fault = "b: is no music";
        }
    }
    return shard;
}

class GenreShard : public ::testing::Test {
 protected:
    [[nodiscard]] fs::path save(const FeatureShard& shard, const std::string& name) const {
        EXPECT_TRUE(save_shard(shard, folder_ / name));
        return folder_ / name;
    }
    raks::test::TemporaryFolder folder_;
};

TEST_F(GenreShard, shares_come_together_in_the_order_of_the_whole) {
    const std::vector<fs::path> paths = {save(shard_of({2, 3}), "second"),
                                         save(shard_of({1, 3}), "first"),
                                         save(shard_of({3, 3}), "third")};
    const auto merged = merge_shards(paths);
    ASSERT_TRUE(merged) << merged.error().message;
    const FeatureShard whole = shard_of({1, 1});
    EXPECT_EQ(merged->written_with, "written. ");
    ASSERT_EQ(merged->files.size(), 3U);
    EXPECT_EQ(merged->files[2].credit, "credit of c");
    ASSERT_EQ(merged->units.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        const FeatureUnit& unit = merged->units[i];
        EXPECT_EQ(unit.fault, whole.material.units[i].fault) << i;
        ASSERT_EQ(unit.pieces.size(), whole.material.units[i].pieces.size()) << i;
        for (const PieceFeatures& piece : unit.pieces) {
            EXPECT_EQ(piece.name, "piece " + std::to_string(i));
            EXPECT_EQ(piece.mel.size(), 60U * BarPatterns::kMelBands);
        }
    }
}

TEST_F(GenreShard, shards_that_do_not_fit_are_named) {
    const fs::path first = save(shard_of({1, 2}), "first");
    const auto message = [&](const fs::path& second) {
        const std::vector<fs::path> paths = {first, second};
        const auto merged = merge_shards(paths);
        return merged ? "merged" : merged.error().message;
    };
    FeatureShard other = shard_of({2, 2});
    other.plan = "another plan";
    const fs::path second = save(other, "second");
    EXPECT_EQ(message(second),
              second.string() + ": heard other music, or in another way, than " + first.string() +
                  "; make both with the same options");
    EXPECT_EQ(message(save(shard_of({2, 3}), "second")),
              second.string() + ": heard other music, or in another way, than " + first.string() +
                  "; make both with the same options");
    EXPECT_EQ(message(first), first.string() + ": share 1/2 is there already; name each once");
    const std::vector<fs::path> alone = {first};
    EXPECT_EQ(merge_shards(alone).error().message,
              "of 2 shards these are missing: 2; name all of them");
    ASSERT_TRUE(write_file(second, "raks-genre-shard-9\nfrom tomorrow"));
    EXPECT_EQ(message(second),
              second.string() + ": is of another version of this program; make it again");
    ASSERT_TRUE(write_file(second, "something else"));
    EXPECT_EQ(message(second), second.string() + ": was not made by raks train genre --shard");
}

TEST_F(GenreShard, cut_and_mangled_shards_are_refused_or_read_without_harm) {
    const fs::path file = save(shard_of({1, 2}), "whole");
    const auto bytes = read_file(file);
    ASSERT_TRUE(bytes);
    const CounterRandom random(11);
    for (std::uint64_t i = 0; i < 160; ++i) {
        const std::size_t size =
            i < 100 ? static_cast<std::size_t>(i) * 3 : random.below(i, bytes->size());
        raks::test::write_damaged(file, std::string_view(*bytes).substr(0, size));
        EXPECT_FALSE(load_shard(file)) << size;
    }
    for (std::uint64_t i = 0; i < 200; ++i) {
        // The head, where the sizes are, more often than the numbers behind it.
        const std::size_t reach = i % 2 == 0 ? 300 : bytes->size();
        raks::test::write_damaged(file, raks::test::mangled(*bytes, {.seed = i, .reach = reach}));
        const auto read = load_shard(file);
        EXPECT_TRUE(read || read.error().message.find('\n') == std::string::npos);
    }
}

TEST(GenreShardNumber, is_read_strictly) {
    const auto share = parse_shard_number("3/4");
    ASSERT_TRUE(share);
    EXPECT_FALSE(share->has(0));
    EXPECT_TRUE(share->has(2));
    EXPECT_TRUE(share->has(6));
    for (const char* const text : {"",
                                   "1",
                                   "/",
                                   "1/",
                                   "/2",
                                   "0/2",
                                   "3/2",
                                   "1/2x",
                                   "-1/2",
                                   "1/1001",
                                   "1 /2",
                                   "1/99999999999"}) {
        EXPECT_FALSE(parse_shard_number(text)) << text;
    }
}

}  // namespace
}  // namespace raks::audio
