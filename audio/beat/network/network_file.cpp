#include "audio/beat/network/network_file.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "audio/beat/network/bar_network.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "models/json_fields.hpp"
#include "models/network_json.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace raks::audio {
namespace {

constexpr std::string_view kFormat = "raks-beat-network";     // field `format`
constexpr int kVersion = 3;                                   // newest version; older ones are read
constexpr std::size_t kLargestFile = std::size_t{16} << 20U;  // bytes
constexpr int kLongestLookahead = 10;                         // hops

using Field = models::JsonDocument::Field;

// The ensemble's further networks; all have the look-ahead of the first.
std::vector<std::shared_ptr<const BeatNetwork>> read_others(const Field& list, int lookahead) {
    std::vector<std::shared_ptr<const BeatNetwork>> others;
    const std::size_t count = list.size();
    if (count >= kMostTogether) {
        list.complain(fmt::format("are {}, at most {} are heard", count, kMostTogether - 1));
        return others;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const models::NetworkSize size = models::read_network_size(list[i]);
        auto other = std::make_shared<BeatNetwork>(size.units, size.layers, lookahead);
        models::read_network_parameters(list[i], *other);
        others.push_back(std::move(other));
    }
    return others;
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
    const models::NetworkSize size = models::read_network_size(root);
    auto network = std::make_shared<BeatNetwork>(
        size.units, size.layers, root["lookahead"].whole(0, kLongestLookahead));
    models::read_network_parameters(root, *network);
    if (root.has("others")) {
        network->set_others(read_others(root["others"], network->lookahead()));
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
    if (network.bars()) {
        text += ",\n\"bars\": {\n" + network_text(*network.bars(), "") + "}";
    }
    return write_file(path, text + "}\n");
}

}  // namespace raks::audio
