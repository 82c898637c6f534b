#include "audio/genre/tagger_file.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/packer.hpp"
#include "base/printable.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::audio {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is little-endian");

constexpr std::size_t kMaxTaggerBytes = std::size_t{1} << 20U;
constexpr std::uint16_t kTaggerArrays = 49;
constexpr float kLargestWeight = 1e6F;  // the shipped ones stay below 100
constexpr std::size_t kTaggerMiddleTaps = 7;

using Sizes = std::vector<std::size_t>;
constexpr auto kLive = TaggerNetwork::kFirstLive;

float float_of_half(std::uint16_t half) {
    const int exponent = (half >> 10) & 31;
    const auto fraction = static_cast<float>(half & 1023U);
    const float magnitude = exponent == 0    ? std::ldexp(fraction, -24)
                            : exponent == 31 ? INFINITY
                                             : std::ldexp(1024.0F + fraction, exponent - 25);
    return (half & 0x8000U) != 0U ? -magnitude : magnitude;
}

std::string words_of(const Sizes& sizes) { return fmt::format("{}", fmt::join(sizes, " x ")); }

// Takes the arrays one after the other; keeps the first fault, after which all are zeros.
class ArrayReader {
 public:
    explicit ArrayReader(std::string_view bytes) : bytes_(bytes) {}

    // The next array, which must have this name and these sizes.
    std::vector<float> take(const std::string& name, const Sizes& sizes) {
        std::size_t count = 1;
        for (const std::size_t size : sizes) {
            count *= size;
        }
        std::vector<float> values(count);
        if (!fault_.empty()) {
            return values;
        }
        std::string found_name(bytes_.take<std::uint8_t>(), ' ');
        for (char& letter : found_name) {
            letter = bytes_.take<char>();
        }
        const char kind = bytes_.take<char>();
        Sizes found(bytes_.take<std::uint8_t>());
        for (std::size_t& size : found) {
            size = bytes_.take<std::uint32_t>();
        }
        if (!bytes_.is_good()) {
            fault_ = "is cut short at " + name;
        } else if (found_name != name) {
            fault_ = fmt::format("has an array '{}' where {} must be", printable(found_name), name);
        } else if (found != sizes) {
            fault_ = fmt::format("{} is {}, must be {}", name, words_of(found), words_of(sizes));
        } else if (kind != 'h' && kind != 'f') {
            fault_ = name + " is neither of halves nor of floats";
        } else {
            fill(name, kind, values);
        }
        return values;
    }

    // Places among the filters of the middle: whole numbers, ascending.
    TaggerNetwork::Places take_places(const std::string& name, std::size_t count) {
        const std::vector<float> numbers = take(name, {count});
        TaggerNetwork::Places places(count);
        for (std::size_t i = 0; i < count; ++i) {
            const float number = numbers[i];
            const bool is_good =
                number >= 0.0F && number < static_cast<float>(TaggerNetwork::kMiddle) &&
                number == std::floor(number) && (i == 0 || number > numbers[i - 1]);
            if (!is_good && fault_.empty()) {
                fault_ = fmt::format("{}[{}] is {}, must be a place among {} after the one before",
                                     name,
                                     i,
                                     number,
                                     TaggerNetwork::kMiddle);
            }
            places[i] = is_good ? static_cast<std::size_t>(number) : 0;
        }
        return places;
    }

    // Nothing may be left in the end.
    [[nodiscard]] std::string fault() const {
        return fault_.empty() && !bytes_.at_end() ? "goes on after its last array" : fault_;
    }

 private:
    void fill(const std::string& name, char kind, std::vector<float>& values) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] =
                kind == 'h' ? float_of_half(bytes_.take<std::uint16_t>()) : bytes_.take<float>();
            if (!(std::abs(values[i]) <= kLargestWeight)) {
                fault_ =
                    fmt::format("{}[{}] is {}, must be a number up to 1e6", name, i, values[i]);
                return;
            }
        }
        if (!bytes_.is_good()) {
            fault_ = "is cut short in " + name;
        }
    }

    Unpacker bytes_;
    std::string fault_;
};

// The file has [time][row][filter], the loops want [filter][row][time].
TaggerNetwork::Convolution take_convolution(ArrayReader& reader,
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

TaggerNetwork take_network(ArrayReader& reader) {
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
        network.places[i] = reader.take_places(names[i] + ".index", filters[i]);
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
    if (!bytes.starts_with(kTaggerFormat)) {
        return fail("is not the music tagger's weights; install Raks again");
    }
    Unpacker head(bytes.substr(kTaggerFormat.size()));
    const int version = head.take<std::uint16_t>();
    const int arrays = head.take<std::uint16_t>();
    if (!head.is_good()) {
        return fail("is cut short at its head; install Raks again");
    }
    if (version != kTaggerVersion) {
        return fail(fmt::format(
            "is of version {}, this program reads version {}", version, kTaggerVersion));
    }
    // The hash stands behind all that it is of.
    constexpr std::size_t kHead = kTaggerFormat.size() + 2 * sizeof(std::uint16_t);
    if (bytes.size() < kHead + sizeof(std::uint64_t)) {
        return fail("is cut short at its head; install Raks again");
    }
    const std::string_view hashed = bytes.substr(0, bytes.size() - sizeof(std::uint64_t));
    ArrayReader reader(hashed.substr(kHead));
    TaggerNetwork network = take_network(reader);
    if (const std::string fault = reader.fault(); !fault.empty()) {
        return fail(fault + "; install Raks again");
    }
    if (arrays != kTaggerArrays) {
        return fail(fmt::format("says that it has {} arrays, must be {}", arrays, kTaggerArrays));
    }
    if (Unpacker(bytes.substr(hashed.size())).take<std::uint64_t>() != hash_of(hashed)) {
        return fail("is damaged: the hash at its end is of other bytes; install Raks again");
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
