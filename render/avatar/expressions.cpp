#include "render/avatar/expressions.hpp"

#include <algorithm>

namespace raks::render {
namespace {

std::array<glm::vec4, 6> colours_of(const ModelMaterial& material) {
    const MToon toon = material.mtoon.value_or(MToon{});
    const std::array<glm::vec3, 5> plain = {material.emissive,
                                            toon.shade_colour,
                                            toon.matcap_factor,
                                            toon.rim_colour,
                                            toon.outline_colour};
    std::array<glm::vec4, 6> colours{};
    colours[0] = material.base_colour;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        colours[i + 1] = glm::vec4(plain[i], 1.0F);
    }
    return colours;
}

constexpr float held_back(ExpressionOverride how, float weight) noexcept {
    switch (how) {
        case ExpressionOverride::block:
            return weight > 0.0F ? 1.0F : 0.0F;
        case ExpressionOverride::blend:
            return weight;
        case ExpressionOverride::none:
            break;
    }
    return 0.0F;
}

}  // namespace

TextureUse MaterialFace::moved(TextureUse use) const noexcept {
    use.scale = use.scale * (1.0F - texture_weight) + texture_scale;
    use.offset = use.offset * (1.0F - texture_weight) + texture_offset;
    return use;
}

ExpressionRig ExpressionRig::build(const Model& model) {
    ExpressionRig rig;
    rig.face_of_material_.assign(model.materials.size(), -1);
    for (const ModelNode& node : model.nodes) {
        rig.add_morphs(model, node);
    }
    for (const Expression& expression : model.character.expressions) {
        rig.add(model, expression);
    }
    rig.rest_.weights.assign(rig.size(), 0.0F);
    for (std::size_t i = 0; i < kFaceExpressionCount; ++i) {
        rig.presets_[i] = rig.find(kFaceExpressionNames[i]);
    }
    rig.find_stand_ins();
    // What an expression sets is 0 without it, also where the mesh says otherwise at rest.
    for (const std::size_t slot : rig.bound_) {
        rig.rest_.morphs[slot] = 0.0F;
    }
    return rig;
}

void ExpressionRig::add_morphs(const Model& model, const ModelNode& node) {
    MorphRange range{.first = rest_.morphs.size()};
    if (node.mesh >= 0) {
        const ModelMesh& mesh = model.meshes[static_cast<std::size_t>(node.mesh)];
        for (const ModelPrimitive& primitive : mesh.primitives) {
            range.count = std::max(range.count, primitive.morphs.size());
        }
        const std::vector<float>& rest =
            node.morph_weights.empty() ? mesh.morph_weights : node.morph_weights;
        rest_.morphs.resize(range.first + range.count, 0.0F);
        std::copy_n(rest.begin(),
                    std::min(range.count, rest.size()),
                    rest_.morphs.begin() + static_cast<std::ptrdiff_t>(range.first));
    }
    ranges_.push_back(range);
}

ExpressionRig::Group ExpressionRig::group_of(const Expression& expression) noexcept {
    if (!expression.is_preset) {
        return Group::none;
    }
    const auto* const found =
        std::find(kFaceExpressionNames.begin(), kFaceExpressionNames.end(), expression.name);
    if (found == kFaceExpressionNames.end()) {
        return Group::none;
    }
    const auto preset = static_cast<FaceExpression>(found - kFaceExpressionNames.begin());
    if (preset > FaceExpression::look_right) {
        return Group::none;
    }
    if (preset >= FaceExpression::look_up) {
        return Group::look_at;
    }
    if (preset >= FaceExpression::blink) {
        return Group::blink;
    }
    return preset >= FaceExpression::aa ? Group::mouth : Group::none;
}

std::size_t ExpressionRig::material_face(const Model& model, int material) {
    int& index = face_of_material_[static_cast<std::size_t>(material)];
    if (index < 0) {
        index = static_cast<int>(rest_.materials.size());
        MaterialFace face;
        face.material = material;
        face.colours = colours_of(model.materials[static_cast<std::size_t>(material)]);
        rest_.materials.push_back(face);
    }
    return static_cast<std::size_t>(index);
}

void ExpressionRig::add(const Model& model, const Expression& expression) {
    Built built;
    built.name = expression.name;
    built.group = group_of(expression);
    built.is_binary = expression.is_binary;
    built.overrides = {ExpressionOverride::none,
                       expression.override_blink,
                       expression.override_look_at,
                       expression.override_mouth};
    add_morph_binds(expression, built);
    for (const ColourBind& bind : expression.colours) {
        if (bind.material >= 0) {
            const std::size_t face = material_face(model, bind.material);
            const auto kind = static_cast<std::size_t>(bind.kind);
            const glm::vec4 change = bind.target - rest_.materials[face].colours[kind];
            built.colours.push_back({.material = face, .kind = bind.kind, .change = change});
        }
    }
    for (const TextureBind& bind : expression.textures) {
        if (bind.material >= 0) {
            built.textures.push_back({.material = material_face(model, bind.material),
                                      .scale = bind.scale,
                                      .offset = bind.offset});
        }
    }
    expressions_.push_back(std::move(built));
}

void ExpressionRig::add_morph_binds(const Expression& expression, Built& built) {
    for (const MorphBind& bind : expression.morphs) {
        const MorphRange range = bind.node < 0 ? MorphRange() : morphs_of(bind.node);
        const auto target = static_cast<std::size_t>(bind.target);
        if (target < range.count) {
            built.morphs.push_back({.index = range.first + target, .weight = bind.weight});
            bound_.push_back(range.first + target);
        }
    }
}

int ExpressionRig::find(std::string_view name) const noexcept {
    for (std::size_t i = 0; i < expressions_.size(); ++i) {
        if (expressions_[i].name == name) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

/// What a figure lacks another expression stands for, less of it.
void ExpressionRig::find_stand_ins() {
    using E = FaceExpression;
    struct Choice {
        E lacking;
        E shown;
        float share;
    };
    constexpr std::array<Choice, 4> kChoices = {{{E::surprised, E::oh, 0.5F},
                                                 {E::surprised, E::aa, 0.4F},
                                                 {E::relaxed, E::happy, 0.45F},
                                                 {E::happy, E::relaxed, 1.0F}}};
    std::array<bool, kFaceExpressionCount> has_one{};
    for (const Choice& one : kChoices) {
        const auto lacking = static_cast<std::size_t>(one.lacking);
        const int shown = presets_[static_cast<std::size_t>(one.shown)];
        if (presets_[lacking] < 0 && shown >= 0 && !has_one[lacking]) {
            has_one[lacking] = true;
            stand_ins_.push_back({lacking, static_cast<std::size_t>(shown), one.share});
        }
    }
}

void ExpressionRig::spread(const Face& face, std::span<float> weights) const noexcept {
    std::fill(weights.begin(), weights.end(), 0.0F);
    for (std::size_t i = 0; i < kFaceExpressionCount; ++i) {
        if (presets_[i] >= 0) {
            weights[static_cast<std::size_t>(presets_[i])] = face.weights[i];
        }
    }
    for (const StandIn& one : stand_ins_) {
        weights[one.shown] =
            std::min(1.0F, weights[one.shown] + one.share * face.weights[one.lacking]);
    }
}

void ExpressionRig::weigh(std::span<const float> weights, std::span<float> out) const noexcept {
    std::array<float, kGroupCount> left = {1.0F, 1.0F, 1.0F, 1.0F};
    for (std::size_t i = 0; i < expressions_.size(); ++i) {
        const float weight = std::clamp(weights[i], 0.0F, 1.0F);
        out[i] = weight;
        if (expressions_[i].is_binary) {
            out[i] = weight > 0.5F ? 1.0F : 0.0F;
        }
        for (std::size_t group = 1; group < kGroupCount; ++group) {
            left[group] -= held_back(expressions_[i].overrides[group], out[i]);
        }
    }
    for (std::size_t i = 0; i < expressions_.size(); ++i) {
        const float factor = std::max(0.0F, left[static_cast<std::size_t>(expressions_[i].group)]);
        out[i] *= expressions_[i].is_binary && factor < 1.0F ? 0.0F : factor;
    }
}

void ExpressionRig::add_binds(const Built& expression,
                              float weight,
                              FaceState& state) const noexcept {
    for (const Slot& slot : expression.morphs) {
        state.morphs[slot.index] += weight * slot.weight;
    }
    for (const Colour& colour : expression.colours) {
        state.materials[colour.material].colours[static_cast<std::size_t>(colour.kind)] +=
            weight * colour.change;
    }
    for (const Texture& texture : expression.textures) {
        MaterialFace& material = state.materials[texture.material];
        material.texture_weight += weight;
        material.texture_scale += weight * texture.scale;
        material.texture_offset += weight * texture.offset;
    }
}

void ExpressionRig::apply(std::span<const float> weights, FaceState& state) const noexcept {
    weigh(weights, state.weights);
    std::copy(rest_.morphs.begin(), rest_.morphs.end(), state.morphs.begin());
    std::copy(rest_.materials.begin(), rest_.materials.end(), state.materials.begin());
    for (std::size_t i = 0; i < expressions_.size(); ++i) {
        if (state.weights[i] > 0.0F) {
            add_binds(expressions_[i], state.weights[i], state);
        }
    }
}

}  // namespace raks::render
