#include "audio/genre/tagger_file.hpp"

#include <string>
#include <utility>

#include "base/file.hpp"
#include "models/weight_file.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

constexpr std::size_t kMaxTaggerBytes = std::size_t{1} << 20U;
constexpr std::size_t kTaggerMiddleTaps = 7;

constexpr auto kLive = TaggerNetwork::kFirstLive;

// Places among the filters of the middle: ascending.
TaggerNetwork::Places take_places(models::WeightReader& reader,
                                  const std::string& name,
                                  std::size_t count) {
    TaggerNetwork::Places places = reader.take_whole(name, count, TaggerNetwork::kMiddle);
    for (std::size_t i = 1; i < count; ++i) {
        if (places[i] <= places[i - 1]) {
            reader.complain(fmt::format(
                "{}[{}] is {}, must be a place after the one before", name, i, places[i]));
        }
    }
    return places;
}

// The file has [time][row][filter], the loops want [filter][row][time].
TaggerNetwork::Convolution take_convolution(models::WeightReader& reader,
                                            const std::string& name,
                                            std::size_t taps,
                                            std::size_t rows,
                                            std::size_t filters) {
    TaggerNetwork::Convolution layer{.filters = filters, .rows = rows, .taps = taps};
    const std::vector<float> kernel = reader.take(name + ".kernel", {taps, rows, filters});
    layer.weights.resize(kernel.size());
    for (std::size_t tap = 0; tap < taps; ++tap) {
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t filter = 0; filter < filters; ++filter) {
                layer.weights[(filter * rows + row) * taps + tap] =
                    kernel[(tap * rows + row) * filters + filter];
            }
        }
    }
    layer.bias = reader.take(name + ".bias", {filters});
    layer.scale = reader.take(name + ".scale", {filters});
    layer.shift = reader.take(name + ".shift", {filters});
    return layer;
}

TaggerNetwork take_network(models::WeightReader& reader) {
    TaggerNetwork network;
    network.input_scale = reader.take("input.scale", {1}).front();
    network.input_shift = reader.take("input.shift", {1}).front();
    network.timbre[0] = take_convolution(reader, "timbre38", kTaggerMiddleTaps, 38, 23);
    network.timbre[1] = take_convolution(reader, "timbre67", kTaggerMiddleTaps, 67, 14);
    network.times[0] = take_convolution(reader, "time128", 128, 1, 3);
    network.times[1] = take_convolution(reader, "time64", 64, 1, 7);
    network.times[2] = take_convolution(reader, "time32", 32, 1, 17);
    const std::array<std::size_t, 3> inputs = {
        TaggerNetwork::kFront, kLive, TaggerNetwork::kMiddle};
    const std::array<std::size_t, 3> filters = {kLive, 61, 63};
    for (std::size_t i = 0; i < 3; ++i) {
        network.middle[i] = take_convolution(
            reader, fmt::format("middle{}", i + 1), kTaggerMiddleTaps, inputs[i], filters[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        network.middle[i].dead =
            reader.take(fmt::format("middle{}.taps", i + 1), {kTaggerMiddleTaps, filters[i]});
    }
    const std::array<std::string, 3> names = {"a", "b2", "c3"};
    for (std::size_t i = 0; i < 3; ++i) {
        network.constants[i] = reader.take(names[i] + ".constant", {TaggerNetwork::kMiddle});
        network.places[i] = take_places(reader, names[i] + ".index", filters[i]);
    }
    network.dense = reader.take("dense.kernel", {TaggerNetwork::kPooled, kTagFeatures});
    network.dense_bias = reader.take("dense.bias", {kTagFeatures});
    network.embedding_scale = reader.take("embedding.scale", {kTagFeatures});
    network.embedding_shift = reader.take("embedding.shift", {kTagFeatures});
    network.tags = reader.take("tags.kernel", {kTagFeatures, kTags});
    network.tags_bias = reader.take("tags.bias", {kTags});
    return network;
}

}  // namespace

Expected<TaggerNetwork> parse_tagger(std::string_view bytes) {
    auto reader = models::WeightReader::open(
        bytes, kTaggerFormat, kTaggerVersion, "the music tagger's weights");
    if (!reader) {
        return fail(reader.error());
    }
    TaggerNetwork network = take_network(*reader);
    if (const auto finished = reader->finish(); !finished) {
        return fail(finished.error());
    }
    return network;
}

Expected<std::shared_ptr<const TaggerNetwork>> load_tagger(const std::filesystem::path& path) {
    const auto bytes = read_file(path, kMaxTaggerBytes);
    if (!bytes) {
        return fail(bytes.error());
    }
    auto network = parse_tagger(*bytes);
    if (!network) {
        return fail(std::move(network.error()).in(path.string()));
    }
    return std::make_shared<const TaggerNetwork>(std::move(*network));
}

}  // namespace raks::audio
