#include <string>
#include <utility>

#include "audio/beat/network/beatnet.hpp"
#include "base/file.hpp"
#include "models/weight_file.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

constexpr std::string_view kBeatNetFormat = "raks-beatnet";
constexpr int kBeatNetVersion = 1;
constexpr std::size_t kMaxBeatNetBytes = std::size_t{4} << 20U;
constexpr std::size_t kBeatNetBins = BeatNetStream::kWindow / 2 + 1;
constexpr std::size_t kWidestFilter = 64;     // bins
constexpr std::size_t kFilterWeights = 1257;  // of all filters

// The filters' first bins, how many each has, and the weights of all, one after the other.
FilterBank take_bank(models::WeightReader& reader) {
    const auto first = reader.take_whole("bank.first", BeatNet::kBands, kBeatNetBins);
    const auto counts = reader.take_whole("bank.count", BeatNet::kBands, kWidestFilter);
    const auto weights = reader.take("bank.weights", {kFilterWeights});
    std::vector<FilterBank::Filter> filters;
    std::size_t at = 0;
    for (std::size_t band = 0; band < BeatNet::kBands; ++band) {
        const std::size_t count = counts[band];
        if (at + count > weights.size() || first[band] + count > kBeatNetBins) {
            reader.complain(fmt::format("bank.count[{}] is {}: too many", band, count));
            break;
        }
        const auto begin = weights.begin() + static_cast<std::ptrdiff_t>(at);
        filters.push_back(
            {static_cast<int>(first[band]), {begin, begin + static_cast<std::ptrdiff_t>(count)}});
        at += count;
    }
    return FilterBank(std::move(filters));
}

BeatNet::Memory take_memory(models::WeightReader& reader, const std::string& name) {
    constexpr std::size_t kUnits = BeatNet::kUnits;
    BeatNet::Memory memory;
    memory.input = reader.take(name + ".input", {kUnits, 4 * kUnits});
    memory.state = reader.take(name + ".state", {kUnits, 4 * kUnits});
    memory.bias = reader.take(name + ".bias", {4 * kUnits});
    return memory;
}

BeatNet take_beatnet(models::WeightReader& reader) {
    BeatNet network;
    network.bank = take_bank(reader);
    network.kernel = reader.take("conv.kernel", {BeatNet::kFilters, BeatNet::kTaps});
    network.kernel_bias = reader.take("conv.bias", {BeatNet::kFilters});
    network.dense =
        reader.take("dense.kernel", {BeatNet::kFilters * BeatNet::kPooled, BeatNet::kUnits});
    network.dense_bias = reader.take("dense.bias", {BeatNet::kUnits});
    network.memory[0] = take_memory(reader, "lstm1");
    network.memory[1] = take_memory(reader, "lstm2");
    network.outputs = reader.take("out.kernel", {BeatNet::kUnits, BeatNet::kOutputs});
    network.outputs_bias = reader.take("out.bias", {BeatNet::kOutputs});
    return network;
}

}  // namespace

Expected<BeatNet> parse_beatnet(std::string_view bytes) {
    auto reader =
        models::WeightReader::open(bytes, kBeatNetFormat, kBeatNetVersion, "BeatNet's weights");
    if (!reader) {
        return fail(reader.error());
    }
    BeatNet network = take_beatnet(*reader);
    if (const auto finished = reader->finish(); !finished) {
        return fail(finished.error());
    }
    return network;
}

Expected<std::shared_ptr<const BeatNet>> load_beatnet(const std::filesystem::path& path) {
    const auto bytes = read_file(path, kMaxBeatNetBytes);
    if (!bytes) {
        return fail(bytes.error());
    }
    auto network = parse_beatnet(*bytes);
    if (!network) {
        return fail(std::move(network.error()).in(path.string()));
    }
    return std::make_shared<const BeatNet>(std::move(*network));
}

}  // namespace raks::audio
