#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "audio/evaluate/genre_folder.hpp"
#include "audio/evaluate/piece_features.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// What is heard in one go: a recording with its altered copies, or written pieces made together.
struct FeatureUnit {
    std::string fault;  ///< why a recording is left out; empty: it is not
    std::vector<PieceFeatures> pieces;
};

/// Material to learn from: files, and all units, recordings first.
struct FeatureMaterial {
    std::vector<MusicFile> files;
    std::string written_with;  ///< credit of the written music, or empty
    std::vector<FeatureUnit> units;
};

/// Which units one machine hears: number, number + count, ... of all, counted from 1.
struct ShardNumber {
    std::uint32_t number = 1;
    std::uint32_t count = 1;  ///< 1 to 1,000
    [[nodiscard]] bool has(std::size_t unit) const noexcept { return unit % count == number - 1; }
};

/// "2/4". Errors: anything else, a number above the count or a count above 1,000.
[[nodiscard]] Expected<ShardNumber> parse_shard_number(const std::string& text);

/// One machine's share: units that are not its own are empty.
struct FeatureShard {
    ShardNumber share;
    std::string plan;     ///< all that shapes what is heard: shards of different plans do not fit
    std::string command;  ///< that made it
    FeatureMaterial material;
};

/// Numbers as the machine stores them. Errors of reading, one line with the file: no shard, one of
/// another version, cut short or damaged; at most 4 GiB.
[[nodiscard]] Expected<void> save_shard(const FeatureShard& shard,
                                        const std::filesystem::path& path);
[[nodiscard]] Expected<FeatureShard> load_shard(const std::filesystem::path& path);

/// All shards as if one machine had heard all, in the same order.
/// Errors, with the file: of another plan or another count than the first, a share twice; and the
/// shares that are missing.
[[nodiscard]] Expected<FeatureMaterial> merge_shards(std::span<const std::filesystem::path> paths);

}  // namespace raks::audio
