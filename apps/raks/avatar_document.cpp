#include "apps/raks/avatar_document.hpp"

#include <array>
#include <cmath>
#include <string_view>

#include "base/json.hpp"
#include "base/printable.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/model/model_survey.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::apps {
namespace {
using render::Model;
using render::ModelSurvey;

/// A number, or null where there is none.
template <typename T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json();
}

Json or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

Json json_of(const glm::vec3& point) { return {point.x, point.y, point.z}; }

void add_survey(const ModelSurvey& survey, Json& json) {
    json["nodes"] = survey.nodes;
    json["joints_or_bones"] = survey.joints;
    json["skins"] = survey.skins;
    json["meshes"] = survey.meshes;
    json["primitives"] = survey.primitives;
    json["vertices"] = survey.vertices;
    json["triangles"] = survey.triangles;
    json["max_morphs"] = survey.max_morphs;
    json["images"] = survey.images;
    json["animations"] = survey.animations;
    json["humanoid_bones"] = survey.humanoid_bones;
    json["springs"] = survey.springs;
    json["spring_chains"] = survey.spring_chains;
    json["expressions"] = survey.expressions;
    json["unit"] = 1;
    json["rest_minus_bind_m"] = or_null(survey.rest_minus_bind);
    json["height_m"] = survey.box ? Json(survey.box->high.y - survey.box->low.y) : Json();
    json["facing"] = or_null(survey.facing);
    json["toe_dir"] = or_null(survey.toe_direction);
    json["bbox_min"] = survey.box ? json_of(survey.box->low) : Json();
    json["bbox_max"] = survey.box ? json_of(survey.box->high) : Json();
}

/// A bone of the figure that has a node.
struct MappedBone {
    std::string_view name;
    int node;
    std::string_view reason;
    float confidence;
};

std::vector<MappedBone> mapped_bones(const Model& model) {
    const render::HumanoidMap& humanoid = model.character.humanoid;
    const bool is_stated = humanoid.reasons[0] == render::BoneReason::stated;
    const std::string_view face =
        render::words_of(is_stated ? render::BoneReason::stated : render::BoneReason::name);
    std::vector<MappedBone> bones;
    const auto add =
        [&](std::string_view name, int node, std::string_view reason, float confidence) {
            if (node >= 0) {
                bones.push_back({name, node, reason, confidence});
            }
        };
    for (std::size_t i = 0; i < humanoid.nodes.size(); ++i) {
        add(motion::kBoneNames[i],
            humanoid.nodes[i],
            render::words_of(humanoid.reasons[i]),
            humanoid.confidence[i]);
    }
    const float of_face = is_stated ? 1.0F : 0.9F;
    add("leftEye", humanoid.left_eye, face, of_face);
    add("rightEye", humanoid.right_eye, face, of_face);
    add("jaw", humanoid.jaw, face, of_face);
    return bones;
}

const std::string& node_name(const Model& model, int node) {
    return model.nodes[static_cast<std::size_t>(node)].name;
}

std::string_view shading_of(const render::ModelMaterial& material) {
    return material.mtoon ? "mtoon" : material.is_unlit ? "unlit" : "lit";
}

std::string_view alpha_of(const render::ModelMaterial& material) {
    constexpr std::array<std::string_view, 3> kNames = {"opaque", "mask", "blend"};
    return kNames[static_cast<std::size_t>(material.alpha_mode)];
}

Json json_of(const render::ModelMaterial& material, const Model& model) {
    const int texture = material.base_texture.texture;
    const int image = texture < 0 ? -1 : model.textures[static_cast<std::size_t>(texture)].image;
    const glm::vec4& colour = material.base_colour;
    return {{"name", material.name},
            {"shading", shading_of(material)},
            {"alpha", alpha_of(material)},
            {"double_sided", material.is_double_sided},
            {"base_colour", {colour.r, colour.g, colour.b, colour.a}},
            {"base_image", image >= 0 ? Json(image) : Json()}};
}

Json json_of(const render::Licence& licence) {
    Json terms = Json::object();
    for (const auto& [key, value] : licence.terms) {
        terms[key] = value;
    }
    return {{"title", licence.title},
            {"version", licence.version},
            {"authors", licence.authors},
            {"contact", licence.contact},
            {"copyright", licence.copyright},
            {"licence", licence.name},
            {"credit_required", licence.is_credit_required},
            {"terms", terms}};
}

std::string licence_text(const render::Licence& licence) {
    std::string text;
    const auto add = [&text](std::string_view what, const std::string& value) {
        if (!value.empty()) {
            text += fmt::format("  {:<10}{}\n", what, printable(value, 200));
        }
    };
    add("title", licence.title);
    add("by", fmt::format("{}", fmt::join(licence.authors, ", ")));
    add("licence", licence.name);
    add("credit", licence.is_credit_required ? "must be given" : "");
    for (const auto& [key, value] : licence.terms) {
        text += fmt::format("  {}: {}\n", printable(key, 60), printable(value, 120));
    }
    return text;
}

std::string survey_text(const ModelSurvey& survey) {
    std::string text = fmt::format(
        "  {} vertices, {} triangles, {} meshes of {} parts, {} joints of {} nodes\n"
        "  {} images, {} animations, up to {} morph targets, {} expressions, {} springs\n",
        survey.vertices,
        survey.triangles,
        survey.meshes,
        survey.primitives,
        survey.joints,
        survey.nodes,
        survey.images,
        survey.animations,
        survey.max_morphs,
        survey.expressions,
        survey.springs);
    if (survey.box) {
        text += fmt::format("  {:.3g} m tall{}{}\n",
                            survey.box->high.y - survey.box->low.y,
                            survey.facing.empty() ? "" : ", faces ",
                            survey.facing);
    }
    return text;
}

}  // namespace

Json avatar_document(const Model& model, const std::string& file) {
    const ModelSurvey survey = render::survey(model);
    // `format` is the model's, as in tables of models.
    Json json = {{"document", "raks-avatar"},
                 {"version", 1},
                 {"file", file},
                 {"name", model.name},
                 {"format", survey.format}};
    add_survey(survey, json);
    Json& humanoid = json["humanoid"] = Json::object();
    for (const MappedBone& bone : mapped_bones(model)) {
        humanoid[std::string(bone.name)] = {
            {"node", bone.node},
            {"name", node_name(model, bone.node)},
            {"reason", bone.reason},
            {"confidence", std::round(static_cast<double>(bone.confidence) * 100.0) / 100.0}};
    }
    Json& materials = json["materials"] = Json::array();
    for (const render::ModelMaterial& material : model.materials) {
        materials.push_back(json_of(material, model));
    }
    json["meta"] = json_of(model.character.licence);
    json["warnings"] = model.warnings;
    return json;
}

std::string avatar_text(const Model& model, const std::string& file) {
    const ModelSurvey survey = render::survey(model);
    std::string text = fmt::format("{} ({})\n", printable(file), survey.format);
    text += survey_text(survey);
    text += licence_text(model.character.licence);
    const std::vector<MappedBone> bones = mapped_bones(model);
    text += bones.empty() ? "no bones of a body are found in it\n"
                          : fmt::format("{} bones of a body\n", bones.size());
    for (const MappedBone& bone : bones) {
        constexpr float kSure = 0.7F;
        text += fmt::format(
            "  {:<24} {} ({}{})\n",
            bone.name,
            printable(node_name(model, bone.node), 60),
            bone.reason,
            bone.confidence < kSure ? fmt::format(", doubtful: {:.2f}", bone.confidence) : "");
    }
    text += fmt::format("{} materials\n", model.materials.size());
    for (const render::ModelMaterial& material : model.materials) {
        text += fmt::format("  {} ({}, {}{})\n",
                            printable(material.name, 60),
                            shading_of(material),
                            alpha_of(material),
                            material.is_double_sided ? ", both sides" : "");
    }
    for (const std::string& warning : model.warnings) {
        text += "note: " + warning + "\n";
    }
    return text;
}

}  // namespace raks::apps
