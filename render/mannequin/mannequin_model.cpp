#include "render/mannequin/mannequin_model.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/mannequin/bind_pose.hpp"
#include "render/mannequin/body_field.hpp"
#include "render/mannequin/cut_skin.hpp"
#include "render/mannequin/paint_parts.hpp"
#include "render/mannequin/worn_model.hpp"

#include <glm/common.hpp>

namespace raks::render {
namespace {

constexpr std::array<std::string_view, 10> kPaintNames = {
    "skin", "suit", "stripe", "hair", "shoes", "trim", "sole", "white of the eye", "iris", "lips"};

/// Nothing is reserved, in VRM's own words.
Licence cc0() {
    Licence licence;
    licence.title = "Raks mannequin";
    licence.authors = {"Raks"};
    licence.name = "https://creativecommons.org/publicdomain/zero/1.0/";
    licence.terms = {{"avatarPermission", "everyone"},
                     {"allowExcessivelyViolentUsage", "true"},
                     {"allowExcessivelySexualUsage", "true"},
                     {"commercialUsage", "corporation"},
                     {"allowPoliticalOrReligiousUsage", "true"},
                     {"allowAntisocialOrHateUsage", "true"},
                     {"allowRedistribution", "true"},
                     {"modification", "allowModificationRedistribution"}};
    return licence;
}

bool is_exact(const HelperJoint& helper) noexcept {
    return helper.kind == HelperKind::half_rotation || helper.kind == HelperKind::half_roll;
}

/// Each joint once, weights that sum to 1, and joint 0 where none weighs: as glTF has them.
void settle_weights(ModelPrimitive& primitive) {
    for (std::size_t v = 0; v < primitive.weights.size(); ++v) {
        auto& joints = primitive.joints[v];
        auto& weights = primitive.weights[v];
        float sum = 0.0F;
        for (std::size_t k = 0; k < weights.size(); ++k) {
            for (std::size_t before = 0; before < k; ++before) {
                if (joints[before] == joints[k]) {
                    weights[before] += std::exchange(weights[k], 0.0F);
                }
            }
        }
        for (const float weight : weights) {
            sum += weight;
        }
        for (std::size_t k = 0; k < weights.size(); ++k) {
            weights[k] /= sum;
            joints[k] = weights[k] > 0.0F ? joints[k] : std::uint16_t{0};
        }
    }
}

/// Takes the nodes of meshes out of a skin, which move nothing: its joints have a common root then.
void keep_joints_alone(Model& model) {
    ModelSkin& skin = model.skins[0];
    const ModelSkin all = std::exchange(skin, ModelSkin());
    std::vector<std::uint16_t> number(all.joints.size());
    for (std::size_t i = 0; i < all.joints.size(); ++i) {
        number[i] = static_cast<std::uint16_t>(skin.joints.size());
        if (model.nodes[static_cast<std::size_t>(all.joints[i])].mesh < 0) {
            skin.joints.push_back(all.joints[i]);
            skin.inverse_bind.push_back(all.inverse_bind[i]);
        }
    }
    for (ModelMesh& mesh : model.meshes) {
        for (ModelPrimitive& primitive : mesh.primitives) {
            for (auto& joints : primitive.joints) {
                for (std::uint16_t& joint : joints) {
                    joint = number[joint];
                }
            }
        }
    }
}

/// Makes the mannequin's worn model, which is there already, whole.
class MannequinModel {
 public:
    MannequinModel(const Avatar& avatar, Model worn, const PaintColours& colours)
        : avatar_(avatar), colours_(colours), model_(std::move(worn)) {
        worn_materials_.swap(model_.materials);
        keep_joints_alone(model_);
        for (ModelNode& node : model_.nodes) {
            node.name += node.mesh >= 0 ? " mesh" : "";  // "head" is a bone, too
        }
    }

    Model build() {
        for (ModelMesh& mesh : model_.meshes) {
            part(mesh);
        }
        add_body();
        model_.character.vrm = VrmVersion::vrm1;
        model_.character.licence = cc0();
        return std::move(model_);
    }

 private:
    /// A material for each colour, seen from one side or from both.
    int material_of(Paint paint, bool is_double_sided) {
        const auto [place, is_new] = materials_.try_emplace(
            std::pair(paint, is_double_sided), static_cast<int>(model_.materials.size()));
        if (is_new) {
            const auto number = static_cast<std::size_t>(paint);
            ModelMaterial material;
            material.name = std::string(kPaintNames[number]);
            material.name += is_double_sided ? ", both sides" : "";
            material.base_colour = glm::vec4(colours_[number], 1.0F);
            material.metallic = 0.0F;
            material.roughness = 0.75F;
            material.is_double_sided = is_double_sided;
            model_.materials.push_back(std::move(material));
        }
        return place->second;
    }

    /// Splits what is worn by its colours.
    void part(ModelMesh& mesh) {
        std::vector<ModelPrimitive> whole;
        whole.swap(mesh.primitives);
        for (const ModelPrimitive& primitive : whole) {
            std::vector<Paint> paints;
            for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
                paints.push_back(static_cast<Paint>(primitive.uv[1][primitive.indices[i]].x));
            }
            const bool is_double_sided =
                worn_materials_[static_cast<std::size_t>(primitive.material)].is_double_sided;
            add_parts(primitive, paints, is_double_sided, mesh);
        }
    }

    void add_parts(const ModelPrimitive& primitive,
                   std::span<const Paint> paints,
                   bool is_double_sided,
                   ModelMesh& mesh) {
        for (auto& [paint, part] : paint_parts(primitive, paints)) {
            part.material = material_of(paint, is_double_sided);
            settle_weights(part);
            for (glm::vec4& tint : part.colours) {
                tint = glm::min(tint, glm::vec4(1.0F));  // glTF has none above
            }
            mesh.primitives.push_back(std::move(part));
        }
    }

    int add_node(ModelNode node) {
        const int number = static_cast<int>(model_.nodes.size());
        if (node.parent < 0) {
            model_.roots.push_back(number);
        } else {
            model_.nodes[static_cast<std::size_t>(node.parent)].children.push_back(number);
        }
        model_.nodes.push_back(std::move(node));
        return number;
    }

    /// The joint of a helper that a constraint turns as the mannequin does.
    int add_helper(const HelperJoint& helper) {
        ModelNode node;
        node.name = std::string(helper.name);
        node.parent = static_cast<int>(motion::index_of(helper.parent));
        node.translation = helper.offset;
        const int number = add_node(std::move(node));
        NodeConstraint constraint;
        constraint.node = number;
        constraint.source = static_cast<int>(motion::index_of(helper.source));
        constraint.weight = 0.5F;
        if (helper.kind == HelperKind::half_roll) {
            constraint.kind = ConstraintKind::roll;
            constraint.axis = NodeAxis::x;  // along the arm
        }
        model_.character.constraints.push_back(constraint);
        return number;
    }

    ModelSkin make_skin() {
        ModelSkin skin;
        for (std::size_t joint = 0; joint < avatar_.inverse_bind.size(); ++joint) {
            if (joint >= motion::kBoneCount) {
                const HelperJoint& helper = avatar_.helpers[joint - motion::kBoneCount];
                if (!is_exact(helper)) {
                    continue;
                }
                joint_in_skin_[joint] = skin.joints.size();
                skin.joints.push_back(add_helper(helper));
            } else {
                joint_in_skin_[joint] = joint;
                skin.joints.push_back(static_cast<int>(joint));
            }
            skin.inverse_bind.push_back(avatar_.inverse_bind[joint]);
        }
        return skin;
    }

    /// Shares by joint of the skin, the other helpers folded into their neighbours.
    [[nodiscard]] std::array<float, kPaletteSize> folded(const SkinPoint& point) const {
        std::array<float, kPaletteSize> shares{};
        for (std::size_t joint = 0; joint < shares.size(); ++joint) {
            const float share = point.shares[joint];
            const std::size_t number = joint - motion::kBoneCount;
            if (joint < motion::kBoneCount || is_exact(avatar_.helpers[number])) {
                shares[joint_in_skin_[joint]] += share;
                continue;
            }
            const HelperJoint& helper = avatar_.helpers[number];
            const float above = helper.kind == HelperKind::half_swing ? 0.5F : 0.0F;
            shares[motion::index_of(helper.parent)] += above * share;
            shares[motion::index_of(helper.source)] += (1.0F - above) * share;
        }
        return shares;
    }

    /// The four joints that hold a point most.
    void add_weights(const SkinPoint& point, ModelPrimitive& skin) const {
        const std::array<float, kPaletteSize> shares = folded(point);
        std::array<std::uint16_t, kPaletteSize> order{};
        std::iota(order.begin(), order.end(), std::uint16_t{0});
        std::partial_sort(order.begin(), order.begin() + 4, order.end(), [&](auto a, auto b) {
            return shares[a] != shares[b] ? shares[a] > shares[b] : a < b;
        });
        auto& joints = skin.joints.emplace_back();
        auto& weights = skin.weights.emplace_back();
        for (std::size_t k = 0; k < 4; ++k) {
            weights[k] = shares[order[k]];
            joints[k] = order[k];
        }
    }

    void add_body() {
        ModelSkin model_skin = make_skin();
        const CutSkin cut = cut_skin(avatar_);
        ModelPrimitive skin;
        skin.indices = cut.indices;
        for (const SkinPoint& point : cut.points) {
            skin.positions.push_back(point.position);
            skin.normals.push_back(point.normal);
            add_weights(point, skin);
        }
        ModelMesh mesh;
        mesh.name = "body";
        add_parts(skin, cut.paints, false, mesh);
        ModelNode node;
        node.name = mesh.name;
        node.mesh = static_cast<int>(model_.meshes.size());
        node.skin = static_cast<int>(model_.skins.size());
        add_node(std::move(node));
        model_.meshes.push_back(std::move(mesh));
        model_.skins.push_back(std::move(model_skin));
    }

    const Avatar& avatar_;
    const PaintColours& colours_;
    Model model_;
    std::vector<ModelMaterial> worn_materials_;
    std::map<std::pair<Paint, bool>, int> materials_;
    std::array<std::size_t, kPaletteSize> joint_in_skin_{};
};

}  // namespace

Model mannequin_model(const PaintColours& colours, MannequinStyle style) {
    const Avatar avatar = build_mannequin(style);
    const BindFrames frames(avatar.skeleton, avatar.bind_pose);
    const BodyField field(frames, style);
    return MannequinModel(avatar, worn_model(avatar.skeleton, field, style), colours).build();
}

}  // namespace raks::render
