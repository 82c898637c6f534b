#include "audio/beat/network/network_file.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "audio/beat/network/bar_network.hpp"
#include "audio/beat/network/pulse_network.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "models/json_fields.hpp"
#include "models/network_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace raks::audio {
namespace {

constexpr std::string_view kFormat = "raks-beat-network";     // field `format`
constexpr int kVersion = 4;                                   // newest version; older ones are read
constexpr int kFirstWithThirds = 4;                           // version
constexpr std::size_t kLargestFile = std::size_t{16} << 20U;  // bytes
constexpr int kLongestLookahead = 10;                         // hops

using Field = models::JsonDocument::Field;

// The parameters of a network with the size that the object says. One without the output for thirds
// never hears any.
BeatNetwork read_beats(const Field& object, int version, int lookahead) {
    const models::NetworkSize size = models::read_network_size(object);
    BeatNetwork network(size.units, size.layers, lookahead);
    if (version >= kFirstWithThirds) {
        models::read_network_parameters(object, network);
        return network;
    }
    constexpr float kNever = -12.0F;  // the logistic function gives 6e-6
    constexpr std::size_t kBefore = BeatNetwork::kOutputs - 1;
    models::RecurrentNetwork narrow({NetworkInput::kSize, size.units, size.layers, kBefore});
    models::read_network_parameters(object, narrow);
    const std::span<const float> from = narrow.parameters();
    const std::span<float> to = network.parameters();
    std::copy_n(from.begin(), narrow.output_weights(), to.begin());
    // Rows of the output weights, one a unit, and the row of biases behind them.
    for (std::size_t row = 0; row <= size.units; ++row) {
        std::copy_n(&from[narrow.output_weights() + row * kBefore],
                    kBefore,
                    &to[network.output_weights() + row * BeatNetwork::kOutputs]);
    }
    to.back() = kNever;
    return network;
}

// The ensemble's further networks; all have the look-ahead of the first.
std::vector<std::shared_ptr<const BeatNetwork>> read_others(const Field& list,
                                                            int version,
                                                            int lookahead) {
    std::vector<std::shared_ptr<const BeatNetwork>> others;
    const std::size_t count = list.size();
    if (count >= kMostTogether) {
        list.complain(fmt::format("are {}, at most {} are heard", count, kMostTogether - 1));
        return others;
    }
    for (std::size_t i = 0; i < count; ++i) {
        others.push_back(
            std::make_shared<const BeatNetwork>(read_beats(list[i], version, lookahead)));
    }
    return others;
}

ConfidenceModel read_confidence(const Field& list) {
    ConfidenceModel model;
    const std::vector<double> weights = list.numbers();
    if (weights.size() != model.weights.size()) {
        list.complain(
            fmt::format("has {} numbers, must have {}", weights.size(), model.weights.size()));
        return model;
    }
    for (std::size_t i = 0; i < weights.size(); ++i) {
        constexpr double kMost = 1e3;
        if (std::abs(weights[i]) > kMost) {
            list[i].complain("is not between -1000 and 1000");
        }
        model.weights[i] = static_cast<float>(std::clamp(weights[i], -kMost, kMost));
    }
    return model;
}

// The fields of a network without the braces around them; `more`: further fields, before the
// parameters.
std::string network_text(const models::RecurrentNetwork& network, const std::string& more) {
    std::string text = fmt::format("\"units\": {},\n\"layers\": {},\n{}\"parameters\": [",
                                   network.units(),
                                   network.layers().size(),
                                   more);
    // Sixteen numbers a line: readable, and small in version control.
    constexpr std::size_t kRow = 16;
    for (std::size_t i = 0; i < network.parameters().size(); ++i) {
        text += i == 0 ? "\n" : i % kRow == 0 ? ",\n" : ",";
        text += fmt::format("{:.6g}", network.parameters()[i]);
    }
    return text + "\n]";
}

// A JSON string; bytes that are not UTF-8 become replacement characters.
std::string dumped(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

Expected<std::shared_ptr<const BeatNetwork>> load_network(const std::filesystem::path& path) {
    const auto text = read_file(path, kLargestFile);
    if (!text) {
        return fail(text.error());
    }
    return parse_network(*text, path.string());
}

Expected<std::shared_ptr<const BeatNetwork>> parse_network(std::string_view text,
                                                           const std::string& name) {
    auto document = models::JsonDocument::parse(text, kFormat, kVersion);
    if (!document) {
        return fail(name + ": " + document.error().message);
    }
    const Field root = document->root();
    const int version = root["version"].whole(1, kVersion);
    const int lookahead = root["lookahead"].whole(0, kLongestLookahead);
    auto network = std::make_shared<BeatNetwork>(read_beats(root, version, lookahead));
    if (root.has("others")) {
        network->set_others(read_others(root["others"], version, lookahead));
    }
    if (root.has("confidence")) {
        network->set_confidence(read_confidence(root["confidence"]));
    }
    if (root.has("pulses")) {
        const models::NetworkSize size = models::read_network_size(root["pulses"]);
        auto pulses = std::make_shared<PulseNetwork>(size.units, size.layers);
        models::read_network_parameters(root["pulses"], *pulses);
        network->set_pulses(std::move(pulses));
    }
    if (root.has("bars")) {
        const models::NetworkSize bars_size = models::read_network_size(root["bars"]);
        auto bars = std::make_shared<BarNetwork>(bars_size.units, bars_size.layers);
        models::read_network_parameters(root["bars"], *bars);
        network->set_bars(std::move(bars));
    }
    // The document keeps its first fault; reading went on with default values.
    if (const auto finished = document->finish(); !finished) {
        return fail(name + ": " + finished.error().message);
    }
    return std::shared_ptr<const BeatNetwork>(std::move(network));
}

Expected<void> save_network(const BeatNetwork& network,
                            const NetworkNotes& notes,
                            const std::filesystem::path& path) {
    // Training that diverged must not replace a good file.
    const auto& others = network.others();
    if (!models::is_sound(network) ||
        std::any_of(others.begin(),
                    others.end(),
                    [](const auto& other) { return !models::is_sound(*other); }) ||
        (network.pulses() && !models::is_sound(*network.pulses())) ||
        (network.bars() && !models::is_sound(*network.bars()))) {
        return fail(path.string() + ": not written: training went astray; learn with a lower rate");
    }
    const std::string lookahead = fmt::format("\"lookahead\": {},\n", network.lookahead());
    std::string text = fmt::format(
        "{{\n\"format\": \"{}\",\n\"version\": {},\n\"made_with\": {},\n\"attribution\": {},\n{}",
        kFormat,
        kVersion,
        dumped(notes.made_with),
        dumped(notes.attribution),
        network_text(network, lookahead));
    for (std::size_t i = 0; i < others.size(); ++i) {
        text += (i == 0 ? ",\n\"others\": [{\n" : "}, {\n") + network_text(*others[i], "");
    }
    text += others.empty() ? "" : "}]";
    text +=
        fmt::format(",\n\"confidence\": [{:.4g}]", fmt::join(network.confidence().weights, ","));
    if (network.pulses()) {
        text += ",\n\"pulses\": {\n" + network_text(*network.pulses(), "") + "}";
    }
    if (network.bars()) {
        text += ",\n\"bars\": {\n" + network_text(*network.bars(), "") + "}";
    }
    return write_file(path, text + "}\n");
}

}  // namespace raks::audio
