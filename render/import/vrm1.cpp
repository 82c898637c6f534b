// VRMC_vrm 1.0 and VRMC_vrm_animation 1.0.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/printable.hpp"
#include "render/import/lenient.hpp"
#include "render/import/vrm_parts.hpp"
#include "render/model/expression_names.hpp"

namespace raks::render {
namespace {

constexpr NumberLimits kBindColour{0.0F, 1000.0F, 1.0F};
constexpr NumberLimits kUv{-10'000.0F, 10'000.0F, 0.0F};

// ---- Expressions

MorphBind read_morph_bind(const JsonField& bind, Model& model) {
    MorphBind read;
    read.node = bind["node"].index(model.nodes.size());
    if (!model.nodes.empty()) {
        read.target = bind["index"].index(morphs_of_node(model, read.node));
    }
    read.weight = lenient_number(bind["weight"], {0.0F, 1.0F, 1.0F}, model);
    return read;
}

ColourBind read_colour_bind(const JsonField& bind, Model& model) {
    ColourBind read;
    read.material = bind["material"].index(model.materials.size());
    read.kind = static_cast<ColourBindKind>(bind["type"].choice_or(
        0, {"color", "emissionColor", "shadeColor", "matcapColor", "rimColor", "outlineColor"}));
    const auto target = bind["targetValue"].numbers_or(std::array<float, 4>{1, 1, 1, 1});
    for (int i = 0; i < 4; ++i) {
        read.target[i] = std::clamp(
            target[static_cast<std::size_t>(i)], kBindColour.lowest, kBindColour.highest);
    }
    return read;
}

TextureBind read_texture_bind(const JsonField& bind, Model& model) {
    TextureBind read;
    read.material = bind["material"].index(model.materials.size());
    const auto scale = bind["scale"].numbers_or(std::array<float, 2>{1.0F, 1.0F});
    const auto offset = bind["offset"].numbers_or(std::array<float, 2>{0.0F, 0.0F});
    for (int i = 0; i < 2; ++i) {
        const auto at = static_cast<std::size_t>(i);
        read.scale[i] = std::clamp(scale[at], kUv.lowest, kUv.highest);
        read.offset[i] = std::clamp(offset[at], kUv.lowest, kUv.highest);
    }
    return read;
}

/// Reads the binds of a kind; bad ones are left out, each with a warning.
template <typename Bind>
std::vector<Bind> read_binds(const JsonField& binds,
                             Model& model,
                             Bind (*read_one)(const JsonField&, Model&)) {
    std::vector<Bind> all;
    const bool is_list = read_part(binds, model, [&](const JsonField& list) {
        for (const JsonField& bind : list.items(kMostBinds)) {
            Bind one;
            if (read_part(bind, model, [&](const JsonField& own) { one = read_one(own, model); })) {
                all.push_back(one);
            }
        }
    });
    if (!is_list) {
        all.clear();
    }
    return all;
}

ExpressionOverride read_override(const JsonField& field, Model& model) {
    return static_cast<ExpressionOverride>(
        lenient_choice(field, {"none", "block", "blend"}, model));
}

Expression read_expression(std::string_view name, const JsonField& from, Model& model) {
    Expression expression;
    expression.name = printable(name, 100);
    expression.is_binary = lenient_truth(from["isBinary"], false, model);
    expression.override_blink = read_override(from["overrideBlink"], model);
    expression.override_look_at = read_override(from["overrideLookAt"], model);
    expression.override_mouth = read_override(from["overrideMouth"], model);
    expression.morphs = read_binds(from["morphTargetBinds"], model, read_morph_bind);
    expression.colours = read_binds(from["materialColorBinds"], model, read_colour_bind);
    expression.textures = read_binds(from["textureTransformBinds"], model, read_texture_bind);
    return expression;
}

void read_expressions(const JsonField& group, bool is_preset, Model& model) {
    std::vector<Expression>& all = model.character.expressions;
    const bool is_object = read_part(group, model, [&](const JsonField& own) {
        for (const auto& [name, from] : own.entries()) {
            if (all.size() == kMostExpressions) {
                warn(model, own.line("holds too many expressions; the rest is left out"));
                return;
            }
            if (is_preset && !is_preset_expression(name)) {
                warn(model,
                     from.line("is not an expression that VRM names; taken as one of its maker"));
            }
            all.push_back(read_expression(name, from, model));
            all.back().is_preset = is_preset && is_preset_expression(name);
        }
    });
    static_cast<void>(is_object);  // said in a warning; what was read until then stays
}

// ---- Gaze

LookAtRange read_range(const JsonField& range, float scale, Model& model) {
    return {lenient_number(range["inputMaxValue"], {0.01F, 180.0F, 90.0F}, model),
            lenient_number(range["outputScale"], {0.0F, 180.0F, scale}, model)};
}

void read_look_at1(const JsonField& from, Model& model) {
    LookAt& gaze = model.character.look_at;
    model.character.has_look_at = true;
    gaze.is_by_bones = lenient_choice(from["type"], {"bone", "expression"}, model) == 0;
    gaze.offset_from_head =
        lenient_vector(from["offsetFromHeadBone"], kHeadOffset, {0.0F, 0.06F, 0.0F}, model);
    const float scale = gaze.is_by_bones ? 10.0F : 1.0F;
    gaze.horizontal_inner = read_range(from["rangeMapHorizontalInner"], scale, model);
    gaze.horizontal_outer = read_range(from["rangeMapHorizontalOuter"], scale, model);
    gaze.vertical_down = read_range(from["rangeMapVerticalDown"], scale, model);
    gaze.vertical_up = read_range(from["rangeMapVerticalUp"], scale, model);
}

// ---- Whose work it is

void read_meta1(const JsonField& meta, Model& model) {
    Licence& licence = model.character.licence;
    if (!meta.is_object()) {
        warn(model, meta.line("is missing: whose work it is and its licence are not known"));
        return;
    }
    licence.title = lenient_text(meta["name"], model);
    licence.version = lenient_text(meta["version"], model);
    const bool has_authors = read_part(meta["authors"], model, [&](const JsonField& authors) {
        for (const JsonField& author : authors.items(100)) {
            if (std::string name = lenient_text(author, model); !name.empty()) {
                licence.authors.push_back(std::move(name));
            }
        }
    });
    static_cast<void>(has_authors);  // said in a warning
    licence.copyright = lenient_text(meta["copyrightInformation"], model);
    licence.contact = lenient_text(meta["contactInformation"], model);
    licence.name = lenient_text(meta["licenseUrl"], model);
    licence.is_credit_required =
        lenient_choice(meta["creditNotation"], {"required", "unnecessary"}, model) == 0;
    read_terms(meta,
               {"name",
                "version",
                "authors",
                "copyrightInformation",
                "contactInformation",
                "licenseUrl",
                "thumbnailImage"},
               model);
    const bool has_thumbnail = read_part(meta["thumbnailImage"], model, [&](JsonField image) {
        licence.thumbnail = image.index_or_none(model.images.size());
    });
    static_cast<void>(has_thumbnail);  // said in a warning
}

// ---- VRM animation

/// Nodes of expressions; those that are bad are left out.
void read_animated_expressions(const JsonField& group, Model& model) {
    const bool is_object = read_part(group, model, [&](const JsonField& own) {
        for (const auto& [name, from] : own.entries()) {
            int node = -1;
            if (read_part(from, model, [&](const JsonField& one) {
                    node = one["node"].index(model.nodes.size());
                })) {
                model.animated_face.expressions.emplace_back(printable(name, 100), node);
            }
        }
    });
    static_cast<void>(is_object);  // said in a warning
}

}  // namespace

Expected<void> read_vrm1(const JsonField& vrm, Model& model) {
    JsonFaults faults;
    const JsonField own = vrm.noting_to(faults, "VRMC_vrm");
    if (!own.is_object()) {
        return fail("VRMC_vrm is not an object");
    }
    if (!is_known_version(own, model)) {
        return fail("VRMC_vrm.specVersion is not 1.0; save the model as VRM 1.0");
    }
    model.character.vrm = VrmVersion::vrm1;
    read_human_bones1(own["humanoid"]["humanBones"], model);
    if (Expected<void> read = faults.finish(); !read) {
        return read;
    }
    if (Expected<void> has_all = check_required_bones(model.character.humanoid); !has_all) {
        return has_all;
    }
    read_meta1(own["meta"], model);
    read_expressions(own["expressions"]["preset"], true, model);
    read_expressions(own["expressions"]["custom"], false, model);
    if (const JsonField gaze = own["lookAt"]; gaze.exists()) {
        read_look_at1(gaze, model);
    }
    return {};
}

Expected<void> read_vrm_animation(const JsonField& animation, Model& model) {
    JsonFaults faults;
    const JsonField own = animation.noting_to(faults, "VRMC_vrm_animation");
    if (!own.is_object()) {
        return fail("VRMC_vrm_animation is not an object");
    }
    if (!is_known_version(own, model)) {
        return fail("VRMC_vrm_animation.specVersion is not 1.0; save the motion as VRMA 1.0");
    }
    read_human_bones1(own["humanoid"]["humanBones"], model);
    if (Expected<void> read = faults.finish(); !read) {
        return read;
    }
    if (model.character.humanoid.nodes[motion::index_of(motion::Bone::hips)] < 0) {
        return fail("VRMC_vrm_animation has no hips");
    }
    read_animated_expressions(own["expressions"]["preset"], model);
    read_animated_expressions(own["expressions"]["custom"], model);
    const bool has_gaze = read_part(own["lookAt"]["node"], model, [&](const JsonField& node) {
        model.animated_face.look_at = node.index_or_none(model.nodes.size());
    });
    if (!has_gaze) {
        model.animated_face.look_at = -1;
    }
    return {};
}

}  // namespace raks::render
