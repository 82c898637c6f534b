#include "audio/genre/genre_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "audio/genre/genre_scorer.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "models/hmm_json.hpp"
#include "models/json_fields.hpp"
#include "models/network_json.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace raks::audio {
namespace {

using Json = nlohmann::ordered_json;
using Field = models::JsonDocument::Field;

constexpr std::size_t kMaxBytes = std::size_t{32} << 20U;  // of a file
// Names of the features' definitions. Another definition gets another name, so that models of it
// are refused.
constexpr std::string_view kMfccKind = "htk-39";
constexpr std::string_view kPatternsKind = "bar-patterns-2";
constexpr std::string_view kMelKind = "mel-36-rises";

// Six significant digits: as exact as the models need, in a file that people can read.
double shortened(double value) {
    return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

// A list of numbers as JSON, shortened.
Json list_of(std::span<const float> numbers) {
    Json list = Json::array();
    for (const float number : numbers) {
        list.push_back(shortened(static_cast<double>(number)));
    }
    return list;
}

// The numbers of a JSON list.
std::vector<float> floats_of(const Field& field) {
    const std::vector<double> numbers = field.numbers();
    std::vector<float> floats(numbers.size());
    std::transform(numbers.begin(), numbers.end(), floats.begin(), [](double number) {
        return static_cast<float>(number);
    });
    return floats;
}

// The feature definition, as it is compared and stored.
Json features_json(const GenreFeatures& features) {
    const MfccConfig& mfcc = features.mfcc;
    const CepstralMeanConfig& mean = features.cepstral_mean;
    return {{"mfcc", kMfccKind},
            {"bands", mfcc.bands},
            {"low_hz", mfcc.low_hz},
            {"high_hz", mfcc.high_hz},
            {"pre_emphasis", mfcc.pre_emphasis},
            {"last", mfcc.last == MfccConfig::Last::c0 ? "c0" : "log_energy"},
            {"energy", features.energy == GenreFeatures::Energy::used ? "used" : "left_out"},
            {"mean_seconds", mean.seconds},
            {"mean_start_weight", mean.start_weight},
            {"mean_start", list_of(mean.start)},
            {"patterns", kPatternsKind},
            {"mel", kMelKind}};
}

// A number that must lie in [lowest, highest]; otherwise the field is reported and `lowest`
// returned.
double bounded(const Field& field, double lowest, double highest) {
    const double number = field.number();
    if (!(number >= lowest && number <= highest)) {
        field.complain(fmt::format("is {}, must be {} to {}", number, lowest, highest));
        return lowest;
    }
    return number;
}

// True for the first word, false for the second; any other word is reported.
bool is_first_of(const Field& field, std::string_view first, std::string_view second) {
    const std::string word = field.text();
    if (word != first && word != second) {
        field.complain(fmt::format("is '{}', must be {} or {}", word, first, second));
    }
    return word == first;
}

// Features of another kind cannot be converted: the model must be trained again.
void expect_kind(const Field& field, std::string_view kind) {
    if (const std::string found = field.text(); found != kind) {
        field.complain(
            fmt::format("is '{}', this program hears '{}': train the model again", found, kind));
    }
}

// Reads the feature definition. The document keeps the first fault, and reading goes on with
// default values.
GenreFeatures read_features(const Field& field) {
    expect_kind(field["mfcc"], kMfccKind);
    expect_kind(field["patterns"], kPatternsKind);
    if (field.has("mel")) {  // since version 2
        expect_kind(field["mel"], kMelKind);
    }
    GenreFeatures features;
    features.mfcc.bands = field["bands"].whole(13, 80);
    features.mfcc.low_hz = bounded(field["low_hz"], 0.0, 4'000.0);
    features.mfcc.high_hz = bounded(field["high_hz"], 4'001.0, 8'000.0);
    features.mfcc.pre_emphasis = bounded(field["pre_emphasis"], 0.0, 1.0);
    features.mfcc.last = is_first_of(field["last"], "c0", "log_energy")
                             ? MfccConfig::Last::c0
                             : MfccConfig::Last::log_energy;
    features.energy = is_first_of(field["energy"], "used", "left_out")
                          ? GenreFeatures::Energy::used
                          : GenreFeatures::Energy::left_out;
    features.cepstral_mean.seconds = bounded(field["mean_seconds"], 0.1, 60.0);
    features.cepstral_mean.start_weight = bounded(field["mean_start_weight"], 0.01, 60.0);
    const std::vector<float> start = floats_of(field["mean_start"]);
    if (start.size() != kMfccStatic) {
        field["mean_start"].complain(
            fmt::format("has {} numbers, must have {}", start.size(), kMfccStatic));
        return features;
    }
    std::copy(start.begin(), start.end(), features.cepstral_mean.start.begin());
    return features;
}

// A pattern network; its number of classes is the model's.
Json network_json(const PatternNetwork& network) {
    return {{"units", network.units},
            {"mean", list_of(network.mean)},
            {"deviation", list_of(network.deviation)},
            {"hidden_weights", list_of(network.hidden_weights)},
            {"hidden_bias", list_of(network.hidden_bias)},
            {"output_weights", list_of(network.output_weights)},
            {"output_bias", list_of(network.output_bias)}};
}

// Sizes are checked by validate(), which knows what belongs together.
PatternNetwork read_network(const Field& field, std::size_t classes) {
    PatternNetwork network;
    network.units = static_cast<std::size_t>(
        field["units"].whole(0, static_cast<int>(PatternNetwork::kMaxUnits)));
    network.classes = classes;
    network.mean = floats_of(field["mean"]);
    network.deviation = floats_of(field["deviation"]);
    network.hidden_weights = floats_of(field["hidden_weights"]);
    network.hidden_bias = floats_of(field["hidden_bias"]);
    network.output_weights = floats_of(field["output_weights"]);
    network.output_bias = floats_of(field["output_bias"]);
    return network;
}

// A recurrent network: its shape and the parameters in one list.
Json network_json(const models::RecurrentNetwork& network) {
    return {{"units", network.units()},
            {"layers", network.layers().size()},
            {"parameters", list_of(network.parameters())}};
}

// Inputs and outputs follow from the model; units and layers are in the file.
models::RecurrentNetwork read_recurrent(const Field& field, std::size_t outputs) {
    const models::NetworkSize size = models::read_network_size(field);
    models::RecurrentNetwork network({.inputs = NetworkInput::kSize,
                                      .units = size.units,
                                      .layers = size.layers,
                                      .outputs = outputs});
    models::read_network_parameters(field, network);
    return network;
}

// The recurrent networks. Version 1 has none, so an untrained one takes the place; versions 2 and 3
// have exactly one, in the field `network`.
std::vector<models::RecurrentNetwork> read_networks(const Field& root,
                                                    int version,
                                                    std::size_t outputs) {
    if (version == 1) {
        return {models::RecurrentNetwork({.inputs = NetworkInput::kSize, .outputs = outputs})};
    }
    if (version < 4) {
        return {read_recurrent(root["network"], outputs)};
    }
    const Field networks = root["networks"];
    std::vector<models::RecurrentNetwork> read;
    // One more than allowed is read, so that validate() can report it.
    for (std::size_t i = 0; i < networks.size() && i <= GenreScorer::kMostNetworks; ++i) {
        read.push_back(read_recurrent(networks[i], outputs));
    }
    return read;
}

// Fields that files of earlier versions lack.
struct FusionParts {
    bool has_network = true;      ///< since version 2
    bool has_own_of_none = true;  ///< weights of none and offsets; since version 3
};

// Weights of one kind of class; a network that the file lacks gets the weight 0.
EvidenceWeights read_weights(const Field& field, const FusionParts& parts) {
    return {static_cast<float>(field["mfcc"].number()),
            static_cast<float>(field["rhythm"].number()),
            static_cast<float>(field["sound"].number()),
            parts.has_network ? static_cast<float>(field["network"].number()) : 0.0F};
}

// The fusion of one window length. Version 2 and earlier have one set of weights for all classes
// and a single offset, that of "none of them".
GenreFusion read_window_fusion(const Field& entry, const FusionParts& parts, std::size_t classes) {
    if (!parts.has_own_of_none) {
        const EvidenceWeights weights = read_weights(entry, parts);
        GenreFusion fusion{weights, weights, {}};
        fusion.offsets[std::min(classes, fusion.offsets.size()) - 1] =
            static_cast<float>(entry["unknown"].number());
        return fusion;
    }
    GenreFusion fusion{
        read_weights(entry["dances"], parts), read_weights(entry["none"], parts), {}};
    const Field offsets = entry["offsets"];
    // A model with too many genres is reported by validate() as well.
    if (offsets.size() != classes || classes > fusion.offsets.size()) {
        offsets.complain(fmt::format("has {} numbers, must have {}", offsets.size(), classes));
        return fusion;
    }
    for (std::size_t c = 0; c < classes; ++c) {
        fusion.offsets[c] = static_cast<float>(offsets[c].number());
    }
    return fusion;
}

// One entry a window length, in the order of kGenreWindows.
void read_fusion(const Field& field, const FusionParts& parts, GenreModel& model) {
    if (field.size() != model.fusion.size()) {
        field.complain(
            fmt::format("has {} windows, must have {}", field.size(), model.fusion.size()));
        return;
    }
    for (std::size_t i = 0; i < model.fusion.size(); ++i) {
        const Field entry = field[i];
        const double seconds = kGenreWindows[i] * kSegmentSeconds;
        if (std::abs(entry["seconds"].number() - seconds) > 1e-6) {
            entry["seconds"].complain(fmt::format("must be {}", seconds));
        }
        model.fusion[i] = read_window_fusion(entry, parts, model.classes());
    }
}

// The classes that the tagger tells apart are written by name.
Json tagger_json(const GenreModel& model) {
    const TaggerClasses& tagger = *model.tagger;
    Json knows = Json::array();
    for (std::size_t c = 0; c < model.classes(); ++c) {
        if (tagger.knows[c]) {
            knows.push_back(c < model.genres.size() ? model.genres[c] : "");
        }
    }
    return {{"knows", std::move(knows)},
            {"mean", list_of(tagger.mean)},
            {"deviation", list_of(tagger.deviation)},
            {"weights", list_of(tagger.weights)},
            {"bias", list_of(tagger.bias)}};
}

// Sizes are checked by validate().
TaggerClasses read_tagger(const Field& field, const std::vector<std::string>& genres) {
    TaggerClasses tagger;
    tagger.mean = floats_of(field["mean"]);
    tagger.deviation = floats_of(field["deviation"]);
    tagger.weights = floats_of(field["weights"]);
    tagger.bias = floats_of(field["bias"]);
    tagger.knows.assign(genres.size() + 1, false);
    const Field knows = field["knows"];
    for (std::size_t i = 0; i < knows.size() && i <= kMostGenres; ++i) {
        const std::string name = knows[i].text();
        const auto known = std::find(genres.begin(), genres.end(), name);
        if (known == genres.end() && !name.empty()) {
            knows[i].complain(fmt::format("is '{}', which is none of the genres", name));
            continue;
        }
        tagger.knows[static_cast<std::size_t>(known - genres.begin())] = true;
    }
    return tagger;
}

// One set of weights as JSON.
Json weights_json(const EvidenceWeights& weights) {
    return {{"mfcc", shortened(static_cast<double>(weights.mfcc))},
            {"rhythm", shortened(static_cast<double>(weights.rhythm))},
            {"sound", shortened(static_cast<double>(weights.sound))},
            {"network", shortened(static_cast<double>(weights.network))}};
}

// All window lengths, only the offsets of classes that exist.
Json fusion_json(const GenreModel& model) {
    Json list = Json::array();
    for (std::size_t i = 0; i < model.fusion.size(); ++i) {
        const GenreFusion& fusion = model.fusion[i];
        Json offsets = Json::array();
        for (std::size_t c = 0; c < model.classes(); ++c) {
            offsets.push_back(shortened(static_cast<double>(fusion.offsets[c])));
        }
        list.push_back({{"seconds", kGenreWindows[i] * kSegmentSeconds},
                        {"dances", weights_json(fusion.dances)},
                        {"none", weights_json(fusion.none)},
                        {"offsets", std::move(offsets)}});
    }
    return list;
}

}  // namespace

std::string features_text(const GenreFeatures& features) { return features_json(features).dump(); }

std::string genre_text(const GenreModel& model) {
    Json json = {{"format", kGenreFormat},
                 {"version", kGenreVersion},
                 {"made_with", model.made_with},
                 {"attribution", model.attribution},
                 {"features", features_json(model.features)}};
    json["genres"] = Json::array();
    json["mfcc"] = Json::array();
    for (std::size_t i = 0; i < model.genres.size(); ++i) {
        json["genres"].push_back(model.genres[i]);
        json["mfcc"].push_back(models::hmm_json(model.mfcc[i]));
    }
    json["background"] = models::hmm_json(model.background);
    if (model.similarity) {
        json["similarity"] = models::hmm_json(*model.similarity);
    }
    json["rhythm"] = network_json(model.rhythm);
    json["sound"] = network_json(model.sound);
    json["networks"] = Json::array();
    for (const models::RecurrentNetwork& network : model.networks) {
        json["networks"].push_back(network_json(network));
    }
    if (model.tagger) {
        json["tagger"] = tagger_json(model);
    }
    json["fusion"] = fusion_json(model);
    return models::json_text(json);
}

Expected<GenreModel> parse_genre(std::string_view text) {
    auto document = models::JsonDocument::parse(text, kGenreFormat, kGenreVersion);
    if (!document) {
        return fail(std::move(document.error()));
    }
    const Field root = document->root();
    const int version = root["version"].whole(1, kGenreVersion);
    const FusionParts parts{version >= 2, version >= 3};
    GenreModel model;
    model.made_with = root["made_with"].text();
    model.attribution = root["attribution"].text();
    model.features = read_features(root["features"]);
    const Field genres = root["genres"];
    const Field mfcc = root["mfcc"];
    // One more than allowed is read, so that validate() can report it.
    for (std::size_t i = 0; i < genres.size() && i <= kMostGenres; ++i) {
        model.genres.push_back(genres[i].text());
    }
    for (std::size_t i = 0; i < mfcc.size() && i <= kMostGenres; ++i) {
        model.mfcc.push_back(models::read_hmm(mfcc[i]));
    }
    model.background = models::read_hmm(root["background"]);
    if (root.has("similarity")) {
        model.similarity = models::read_hmm(root["similarity"]);
    }
    model.rhythm = read_network(root["rhythm"], model.classes());
    model.sound = read_network(root["sound"], model.classes());
    model.networks = read_networks(root, version, model.classes());
    if (root.has("tagger")) {
        model.tagger = read_tagger(root["tagger"], model.genres);
    }
    read_fusion(root["fusion"], parts, model);
    // Faults of the fields first: they name the place in the file; validate() checks what fits
    // together.
    if (auto ok = document->finish(); !ok) {
        return fail(std::move(ok.error()));
    }
    if (auto ok = validate(model); !ok) {
        return fail(std::move(ok.error()));
    }
    return model;
}

Expected<std::shared_ptr<const GenreModel>> load_genre(const std::filesystem::path& path) {
    const Expected<std::string> text = read_file(path, kMaxBytes);
    if (!text) {
        return fail(text.error());
    }
    Expected<GenreModel> model = parse_genre(*text);
    if (!model) {
        return fail(path.string() + ": " + model.error().message);
    }
    return std::make_shared<const GenreModel>(std::move(*model));
}

// An invalid model is not written: no program could read it.
Expected<void> save_genre(const GenreModel& model, const std::filesystem::path& path) {
    if (auto ok = validate(model); !ok) {
        return fail(path.filename().string() + ": " + ok.error().message);
    }
    return write_file(path, genre_text(model));
}

}  // namespace raks::audio
