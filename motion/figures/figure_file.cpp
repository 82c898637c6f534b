#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "models/json_fields.hpp"
#include "motion/figures/figure_hmm.hpp"
#include "motion/figures/figure_model.hpp"

namespace raks::motion {
namespace {

using Json = nlohmann::ordered_json;
using Field = models::JsonDocument::Field;
constexpr std::size_t kMaxModelBytes = std::size_t{64} << 20U;  // 64 MiB

// The field names are those of the structs, in their order.
Json json_of(const FigureState& state) {
    return {{"mean", state.mean},
            {"variance", state.variance},
            {"delta_mean", state.delta_mean},
            {"delta_variance", state.delta_variance},
            {"delta_delta_mean", state.delta_delta_mean},
            {"delta_delta_variance", state.delta_delta_variance}};
}

// Fields with their default value are left out of the file.
Json json_of(const PartModel& part) {
    Json json;
    json["part"] = kPartNames[static_cast<std::size_t>(part.part)];
    json["joints"] = Json::array();
    for (const JointFeature& joint : part.joints) {
        Json& one = json["joints"].emplace_back();
        one["bone"] = kBoneNames[index_of(joint.bone)];
        // Places have no mean rotation.
        if (part.features == FigureFeatures::angles) {
            const glm::dquat& q = joint.mean;
            one["mean"] = {q.w, q.x, q.y, q.z};
        }
    }
    json["states"] = Json::array();
    for (const FigureState& state : part.states) {
        json["states"].push_back(json_of(state));
    }
    json["initial"] = part.initial;
    json["transition"] = part.transition;
    json["exit"] = part.exit;
    json["covariance"] = part.covariance;
    if (part.covariance_kind != CovarianceKind::tied) {
        json["covariance_kind"] =
            kCovarianceKindNames[static_cast<std::size_t>(part.covariance_kind)];
        json["state_covariances"] = part.state_covariances;
    }
    json["occurrence"] = part.occurrence;
    // In beats, as everything that depends on time.
    json["stays"] = Json::array();
    for (const StateStay& stay : part.stays) {
        json["stays"].push_back(
            {{"mean", stay.mean.count()}, {"deviation", stay.deviation.count()}});
    }
    json["global_variance"] = part.global_variance;
    return json;
}

Json json_of(const LandingOffset& landing) {
    return {{"repeats", landing.repeats},
            {"median", landing.median.count()},
            {"deviation", landing.deviation.count()}};
}

// Rows of numbers; their lengths are validated later.
std::vector<std::vector<double>> table_of(const Field& field) {
    std::vector<std::vector<double>> rows(field.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i] = field[i].numbers();
    }
    return rows;
}

// Index of a name in a list of names; 0, with a complaint, for an unknown one.
template <typename Names>
std::size_t name_in(const Names& names, const Field& field) {
    const std::string text = field.text();
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) {
        // The text is cut: a damaged file may hold anything.
        field.complain(fmt::format("is \"{:.40}\", which is unknown", text));
        return 0;
    }
    return static_cast<std::size_t>(found - names.begin());
}

// Positions have no mean rotation.
JointFeature joint_of(const Field& field, FigureFeatures features) {
    JointFeature joint;
    joint.bone = static_cast<Bone>(name_in(kBoneNames, field["bone"]));
    if (features == FigureFeatures::positions) {
        return joint;
    }
    const std::vector<double> q = field["mean"].numbers();
    // In the order of the file, which is also that of glm's constructor.
    if (q.size() == 4) {
        joint.mean = {q[0], q[1], q[2], q[3]};
    } else {
        field["mean"].complain(fmt::format("has {} numbers, must have 4 (w, x, y, z)", q.size()));
    }
    return joint;
}

// Lengths are validated later.
FigureState state_of(const Field& field) {
    return {field["mean"].numbers(),
            field["variance"].numbers(),
            field["delta_mean"].numbers(),
            field["delta_variance"].numbers(),
            field["delta_delta_mean"].numbers(),
            field["delta_delta_variance"].numbers()};
}

// Files without a kind have a tied covariance.
void read_covariances(const Field& field, PartModel& part) {
    part.covariance = table_of(field["covariance"]);
    if (!field.has("covariance_kind")) {
        return;
    }
    part.covariance_kind =
        static_cast<CovarianceKind>(name_in(kCovarianceKindNames, field["covariance_kind"]));
    // By state; a diagonal is a matrix of one row.
    const Field matrices = field["state_covariances"];
    for (std::size_t k = 0; k < matrices.size(); ++k) {
        part.state_covariances.push_back(table_of(matrices[k]));
    }
}

// Files may lack the table of counts against states; then each state lies on its slice.
void read_timing(const Field& field, const FigureModel& model, PartModel& part) {
    if (!field.has("occurrence")) {  // an older file
        if (!part.states.empty()) {
            set_sliced_timing(model.beats, model.samples_per_beat, part);
        }
        return;
    }
    part.occurrence = table_of(field["occurrence"]);
    const Field stays = field["stays"];
    for (std::size_t k = 0; k < stays.size(); ++k) {
        part.stays.push_back(
            {Beats(stays[k]["mean"].number()), Beats(stays[k]["deviation"].number())});
    }
}

// One part; its number of states and features is validated later.
PartModel part_of(const Field& field, const FigureModel& model) {
    PartModel part;
    part.features = model.features;
    part.part = static_cast<Part>(name_in(kPartNames, field["part"]));
    const Field joints = field["joints"];
    for (std::size_t j = 0; j < joints.size(); ++j) {
        part.joints.push_back(joint_of(joints[j], model.features));
    }
    const Field states = field["states"];
    for (std::size_t k = 0; k < states.size(); ++k) {
        part.states.push_back(state_of(states[k]));
    }
    part.initial = field["initial"].numbers();
    part.transition = table_of(field["transition"]);
    part.exit = field["exit"].numbers();
    read_covariances(field, part);
    read_timing(field, model, part);
    part.global_variance = field["global_variance"].numbers();
    return part;
}

// Contact probabilities and landings, by side.
void read_feet(const Field& root, FigureModel& model) {
    for (std::size_t side = 0; side < kSideNames.size(); ++side) {
        const Field contact = root["contact"][kSideNames[side]];
        const std::vector<double> chances = contact.numbers();
        if (chances.size() == kContactBins) {
            model.contact[side] = chances;
        } else {
            contact.complain(
                fmt::format("has {} numbers, must have {}", chances.size(), kContactBins));
        }
        const Field landings = root["landings"][kSideNames[side]];
        for (std::size_t c = 0; c < landings.size(); ++c) {
            model.landings[side].push_back({landings[c]["repeats"].whole(0, 1'000'000),
                                            Beats(landings[c]["median"].number()),
                                            Beats(landings[c]["deviation"].number())});
        }
    }
}

// Captures know no fingers, so fists may be absent.
void read_hands(const Field& root, FigureModel& model) {
    if (!root.has("fist")) {
        return;
    }
    for (std::size_t side = 0; side < kSideNames.size(); ++side) {
        model.fist[side] = root["fist"][kSideNames[side]].numbers();
    }
}

// Captured figures have no law of size.
void read_size(const Field& root, FigureModel& model) {
    if (root.has("size_by_tempo")) {
        const Field size = root["size_by_tempo"];
        model.size_by_tempo = {size["body"].number(), size["arms"].number()};
    }
}

// Reads all fields. Complaints collect in the document, whose finish() reports the first.
FigureModel figure_of(const Field& root) {
    FigureModel model;
    model.name = root["name"].text();
    model.dance = root["dance"].text();
    model.role = static_cast<DanceRole>(name_in(kRoleNames, root["role"]));
    model.attribution = root["attribution"].text();
    model.beats = root["beats"].whole(1, 64);
    model.samples_per_beat = root["samples_per_beat"].whole(4, 200);
    model.learnt_tempo = Bpm(root["learnt_tempo"].number());
    model.repeats = root["repeats"].whole(0, 1'000'000);
    model.net_displacement = {root["net_displacement"][0].number(),
                              root["net_displacement"][1].number()};
    model.net_turn = root["net_turn"].number();
    model.source_hips_height = root["source_hips_height"].number();
    model.peak_toe_speed = root["peak_toe_speed"].number();
    // Version 1 has no such field and means angles; it must be known before the parts are read.
    if (root.has("features")) {
        model.features = static_cast<FigureFeatures>(name_in(kFeaturesNames, root["features"]));
    }
    const Field parts = root["parts"];
    const std::size_t count = parts_of(model.features).size();
    // Without the right parts nothing further can be read.
    if (parts.size() != count) {
        parts.complain(fmt::format("has {} entries, must have {}", parts.size(), count));
        return model;
    }
    for (std::size_t p = 0; p < count; ++p) {
        model.parts.push_back(part_of(parts[p], model));
    }
    read_feet(root, model);
    read_hands(root, model);
    read_size(root, model);
    return model;
}

// An unusable model file is best made again, so the error says so.
Error retrain(const std::string& name, const std::string& message) {
    return Error{fmt::format("{}: {}; train the figure again", name, message)};
}

}  // namespace

std::string figure_text(const FigureModel& model) {
    Json json;
    json["format"] = FigureModel::kFormat;
    const bool is_of_angles = model.features == FigureFeatures::angles;
    // Angles keep version 1, which older programs can read.
    json["version"] = is_of_angles ? 1 : FigureModel::kVersion;
    json["name"] = model.name;
    json["dance"] = model.dance;
    json["role"] = kRoleNames[static_cast<std::size_t>(model.role)];
    json["attribution"] = model.attribution;
    // Only version 2 has this field.
    if (!is_of_angles) {
        json["features"] = kFeaturesNames[static_cast<std::size_t>(model.features)];
    }
    json["beats"] = model.beats;
    json["samples_per_beat"] = model.samples_per_beat;
    json["learnt_tempo"] = model.learnt_tempo.bpm();
    json["repeats"] = model.repeats;
    json["net_displacement"] = {model.net_displacement.x, model.net_displacement.y};
    json["net_turn"] = model.net_turn;
    json["source_hips_height"] = model.source_hips_height;
    json["peak_toe_speed"] = model.peak_toe_speed;
    json["parts"] = Json::array();
    for (const PartModel& part : model.parts) {
        json["parts"].push_back(json_of(part));
    }
    for (std::size_t side = 0; side < kSideNames.size(); ++side) {
        const std::string name(kSideNames[side]);
        json["contact"][name] = model.contact[side];
        json["landings"][name] = Json::array();
        for (const LandingOffset& landing : model.landings[side]) {
            json["landings"][name].push_back(json_of(landing));
        }
        // Absent where the hands are not known.
        if (!model.fist[side].empty()) {
            json["fist"][name] = model.fist[side];
        }
    }
    if (model.size_by_tempo.body > 0.0 || model.size_by_tempo.arms > 0.0) {
        json["size_by_tempo"] = {{"body", model.size_by_tempo.body},
                                 {"arms", model.size_by_tempo.arms}};
    }
    return models::json_text(json);
}

Expected<FigureModel> parse_figure(std::string_view json, const std::string& name) {
    Expected<models::JsonDocument> document =
        models::JsonDocument::parse(json, FigureModel::kFormat, FigureModel::kVersion);
    if (!document) {
        return fail(std::move(document.error()).in(name));
    }
    // First the types of all fields, then their values.
    FigureModel model = figure_of(document->root());
    if (auto ok = document->finish(); !ok) {
        return fail(retrain(name, ok.error().message));
    }
    // Values that no program should dance.
    if (auto ok = validate(model); !ok) {
        return fail(retrain(name, ok.error().message));
    }
    return model;
}

Expected<FigureModel> load_figure(const std::filesystem::path& path) {
    const Expected<std::string> text = read_file(path, kMaxModelBytes);
    if (!text) {
        return fail(text.error());
    }
    return parse_figure(*text, path.filename().string());
}

Expected<void> save_figure(const FigureModel& model, const std::filesystem::path& path) {
    if (auto ok = validate(model); !ok) {
        return fail(std::move(ok.error()).in(path.filename().string()));
    }
    return write_file(path, figure_text(model));
}

}  // namespace raks::motion
