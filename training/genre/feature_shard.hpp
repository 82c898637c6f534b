#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "audio/evaluate/genre_folder.hpp"
#include "audio/evaluate/piece_features.hpp"
#include "base/expected.hpp"

/// Splits feature extraction between machines: each extracts a share of the units and saves it as a
/// shard; merge_shards joins them.
namespace raks::audio {

/// Result of one job of feature extraction: a recording with its altered copies, or written pieces
/// made together.
struct FeatureUnit {
    std::string fault;                  ///< why a recording is left out; empty: it is not
    std::vector<PieceFeatures> pieces;  ///< their features; empty where `fault` says why
};

/// Everything that a model is trained on: the files, and all units, recordings first.
struct FeatureMaterial {
    std::vector<MusicFile> files;    ///< the recordings
    std::string written_with;        ///< credit of the written music, or empty
    std::vector<FeatureUnit> units;  ///< one a file, then those of written music
};

/// Which units one machine extracts: number, number + count, ... of all, counted from 1.
struct ShardNumber {
    std::uint32_t number = 1;  ///< 1 to count
    std::uint32_t count = 1;   ///< 1 to 1,000
    /// Is the unit of this index (from 0) in the share?
    [[nodiscard]] bool has(std::size_t unit) const noexcept { return unit % count == number - 1; }
};

/// Parses "2/4". Errors: anything else, a number above the count or a count above 1,000.
[[nodiscard]] Expected<ShardNumber> parse_shard_number(const std::string& text);

/// What one machine has extracted. Units of other shares are empty.
struct FeatureShard {
    ShardNumber share;  ///< which units it has
    /// Every option that shapes the features; shards of different plans do not merge.
    std::string plan;
    std::string command;       ///< command line that made it
    FeatureMaterial material;  ///< files of all, units of this share
};

/// Numbers are stored in this machine's byte order. Errors: the file cannot be written.
[[nodiscard]] Expected<void> save_shard(const FeatureShard& shard,
                                        const std::filesystem::path& path);
/// Errors, one line with the file: no shard, one of another version, cut short or damaged, over 4
/// GiB.
[[nodiscard]] Expected<FeatureShard> load_shard(const std::filesystem::path& path);

/// Joins shards to what one machine would have extracted, in the same order. Errors, with the file:
/// another plan or count than the first, a share given twice; and the shares that are missing.
[[nodiscard]] Expected<FeatureMaterial> merge_shards(std::span<const std::filesystem::path> paths);

}  // namespace raks::audio
