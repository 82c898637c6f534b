#include "training/genre/feature_shard.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "audio/evaluate/piece_features.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

// Without the version: tells an old shard from another file.
constexpr std::string_view kShardFormat = "raks-genre-shard-";
constexpr std::string_view kShardMagic = "raks-genre-shard-2\n";
constexpr std::size_t kMostShardBytes = std::size_t{4} << 30U;  // 4 GiB
constexpr std::uint32_t kMostShards = 1'000;     // named in an error of parse_shard_number, too
constexpr std::uint32_t kMostUnits = 1'000'000;  // bounds what a damaged header can allocate

// MusicFile field by field; unpack_file reads the same order.
void pack_file(const MusicFile& file, Packer& packer) {
    packer.put_list(file.name);
    packer.put_list(file.group);
    packer.put_list(file.label);
    packer.put_list(file.credit);
    packer.put_list(file.genre);
    packer.put(static_cast<std::uint8_t>(file.may_train ? 1 : 0));
}

MusicFile unpack_file(Unpacker& unpacker) {
    MusicFile file;
    file.name = unpacker.take_list<std::string>();
    file.group = unpacker.take_list<std::string>();
    file.label = unpacker.take_list<std::string>();
    file.credit = unpacker.take_list<std::string>();
    file.genre = unpacker.take_list<std::string>();
    file.may_train = unpacker.take<std::uint8_t>() != 0;
    // The path is not stored: it is only valid on the machine that read the file.
    file.path = file.name;
    return file;
}

// Counterpart of the loop in save_shard.
Expected<FeatureUnit> unpack_unit(Unpacker& unpacker) {
    FeatureUnit unit;
    unit.fault = unpacker.take_list<std::string>();
    const auto pieces = unpacker.take<std::uint32_t>();
    for (std::uint32_t i = 0; i < pieces; ++i) {
        auto piece = unpack_piece(unpacker);
        if (!piece) {
            return fail(piece.error());
        }
        unit.pieces.push_back(std::move(*piece));
    }
    return unit;
}

// Reads the header first and checks the counts before anything is allocated by them.
Expected<FeatureShard> unpack_shard(std::string_view bytes) {
    Unpacker unpacker(bytes);
    FeatureShard shard;
    shard.share.number = unpacker.take<std::uint32_t>();
    shard.share.count = unpacker.take<std::uint32_t>();
    shard.plan = unpacker.take_list<std::string>();
    shard.command = unpacker.take_list<std::string>();
    shard.material.written_with = unpacker.take_list<std::string>();
    const auto files = unpacker.take<std::uint32_t>();
    const auto units = unpacker.take<std::uint32_t>();
    const ShardNumber& share = shard.share;
    const bool is_sane = unpacker.is_good() && share.number >= 1 && share.number <= share.count &&
                         share.count <= kMostShards && files <= units && units <= kMostUnits;
    if (!is_sane) {
        return fail("is cut short or damaged");
    }
    for (std::uint32_t i = 0; i < files && unpacker.is_good(); ++i) {
        shard.material.files.push_back(unpack_file(unpacker));
    }
    for (std::uint32_t i = 0; i < units && unpacker.is_good(); ++i) {
        FeatureUnit& unit = shard.material.units.emplace_back();
        // Units of other shares are not stored; they stay empty at their index.
        if (share.has(i)) {
            auto unpacked = unpack_unit(unpacker);
            if (!unpacked) {
                return fail(unpacked.error());
            }
            unit = std::move(*unpacked);
        }
    }
    // Bytes left over are as suspicious as missing ones.
    if (!unpacker.is_good() || !unpacker.at_end()) {
        return fail("is cut short or damaged");
    }
    return shard;
}

}  // namespace

Expected<ShardNumber> parse_shard_number(const std::string& text) {
    ShardNumber share;
    const char* const end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, share.number);
    const bool has_slash = number.ptr != end && *number.ptr == '/';
    // Without a slash `count` repeats the first number, and `has_slash` rejects it.
    const auto count = has_slash ? std::from_chars(number.ptr + 1, end, share.count) : number;
    if (number.ec != std::errc() || count.ec != std::errc() || !has_slash || count.ptr != end ||
        share.number < 1 || share.number > share.count || share.count > kMostShards) {
        return fail(fmt::format("--shard is '{}', must be i/n: share 1 to n, n up to 1000", text));
    }
    return share;
}

Expected<void> save_shard(const FeatureShard& shard, const fs::path& path) {
    Packer packer(kShardMagic);
    packer.put(shard.share.number);
    packer.put(shard.share.count);
    packer.put_list(shard.plan);
    packer.put_list(shard.command);
    const FeatureMaterial& material = shard.material;
    packer.put_list(material.written_with);
    packer.put(static_cast<std::uint32_t>(material.files.size()));
    packer.put(static_cast<std::uint32_t>(material.units.size()));
    for (const MusicFile& file : material.files) {
        pack_file(file, packer);
    }
    for (std::size_t i = 0; i < material.units.size(); ++i) {
        if (shard.share.has(i)) {
            packer.put_list(material.units[i].fault);
            packer.put(static_cast<std::uint32_t>(material.units[i].pieces.size()));
            for (const PieceFeatures& piece : material.units[i].pieces) {
                pack_piece(piece, packer);
            }
        }
    }
    return write_file(path, packer.take());
}

Expected<FeatureShard> load_shard(const fs::path& path) {
    // Magic first: a large file of another kind is not read whole.
    const auto start = read_file_start(path, kShardMagic.size());
    if (!start) {
        return fail(start.error());
    }
    if (*start != kShardMagic) {
        return fail(path.string() + (start->starts_with(kShardFormat)
                                         ? ": is of another version of this program; make it again"
                                         : ": was not made by raks train genre --shard"));
    }
    const auto bytes = read_file(path, kMostShardBytes);
    if (!bytes) {
        return fail(bytes.error());
    }
    auto shard =
        unpack_shard(std::string_view(*bytes).substr(std::min(start->size(), bytes->size())));
    if (!shard) {
        return fail(fmt::format("{}: {}; make it again", path.string(), shard.error().message));
    }
    return shard;
}

Expected<FeatureMaterial> merge_shards(std::span<const fs::path> paths) {
    FeatureMaterial material;
    ShardNumber first;
    std::string plan;
    std::vector<std::uint32_t> missing;  // shares that no file has brought yet
    for (const fs::path& path : paths) {
        auto shard = load_shard(path);
        if (!shard) {
            return fail(shard.error());
        }
        // The first shard decides plan, count and files; the others must agree.
        if (missing.empty() && plan.empty()) {
            first = shard->share;
            plan = shard->plan;
            material.files = shard->material.files;
            material.written_with = shard->material.written_with;
            material.units.resize(shard->material.units.size());
            for (std::uint32_t number = 1; number <= first.count; ++number) {
                missing.push_back(number);
            }
        }
        if (shard->share.count != first.count || shard->plan != plan ||
            shard->material.units.size() != material.units.size()) {
            return fail(fmt::format(
                "{}: heard other music, or in another way, than {}; make both with the same "
                "options",
                path.string(),
                paths.front().string()));
        }
        // erase counts what it removed: 0 means that this share has come before.
        if (std::erase(missing, shard->share.number) == 0) {
            return fail(fmt::format("{}: share {}/{} is there already; name each once",
                                    path.string(),
                                    shard->share.number,
                                    first.count));
        }
        for (std::size_t i = 0; i < material.units.size(); ++i) {
            if (shard->share.has(i)) {
                material.units[i] = std::move(shard->material.units[i]);
            }
        }
    }
    if (!missing.empty()) {
        return fail(fmt::format("of {} shards these are missing: {}; name all of them",
                                first.count,
                                fmt::join(missing, ", ")));
    }
    return material;
}

}  // namespace raks::audio
