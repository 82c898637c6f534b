#include "audio/beat/network/network_file.hpp"

#include <cmath>

#include "base/file.hpp"
#include "models/json_fields.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace raks::audio {
namespace {

constexpr std::string_view kFormat = "raks-beat-network";
constexpr int kVersion = 1;
constexpr std::size_t kLargestFile = std::size_t{16} << 20U;
constexpr int kLongestLookahead = 10;

}  // namespace

Expected<std::shared_ptr<const BeatNetwork>> load_network(const std::filesystem::path& path) {
    const auto text = read_file(path, kLargestFile);
    if (!text) {
        return fail(text.error());
    }
    auto document = models::JsonDocument::parse(*text, kFormat, kVersion);
    if (!document) {
        return fail(path.string() + ": " + document.error().message);
    }
    const auto root = document->root();
    const int units = root["units"].whole(1, static_cast<int>(BeatNetwork::kMaxUnits));
    const int layers = root["layers"].whole(1, static_cast<int>(BeatNetwork::kMaxLayers));
    const int lookahead = root["lookahead"].whole(0, kLongestLookahead);
    const std::vector<double> parameters = root["parameters"].numbers();
    if (const auto finished = document->finish(); !finished) {
        return fail(path.string() + ": " + finished.error().message);
    }
    auto network = std::make_shared<BeatNetwork>(
        static_cast<std::size_t>(units), static_cast<std::size_t>(layers), lookahead);
    if (parameters.size() != network->parameters().size()) {
        return fail(fmt::format("{}: {} parameters, {} units in {} layers have {}",
                                path.string(),
                                parameters.size(),
                                units,
                                layers,
                                network->parameters().size()));
    }
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        // Weights this large would make infinities of sums.
        if (!(std::abs(parameters[i]) < 1e6)) {
            return fail(fmt::format("{}: parameters[{}] is not below 1e6", path.string(), i));
        }
        network->parameters()[i] = static_cast<float>(parameters[i]);
    }
    return std::shared_ptr<const BeatNetwork>(std::move(network));
}

Expected<void> save_network(const BeatNetwork& network,
                            const NetworkNotes& notes,
                            const std::filesystem::path& path) {
    const nlohmann::json made_with = notes.made_with;
    const nlohmann::json attribution = notes.attribution;
    std::string text = fmt::format(
        "{{\n\"format\": \"{}\",\n\"version\": {},\n\"made_with\": {},\n\"attribution\": {},\n"
        "\"units\": {},\n\"layers\": {},\n\"lookahead\": {},\n\"parameters\": [",
        kFormat,
        kVersion,
        made_with.dump(),
        attribution.dump(),
        network.units(),
        network.layers().size(),
        network.lookahead());
    constexpr std::size_t kRow = 16;
    for (std::size_t i = 0; i < network.parameters().size(); ++i) {
        text += i == 0 ? "\n" : i % kRow == 0 ? ",\n" : ",";
        text += fmt::format("{:.6g}", network.parameters()[i]);
    }
    return write_file(path, text + "\n]}\n");
}

}  // namespace raks::audio
