#include "render/mannequin/worn_model.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "render/mannequin/cloth_mesh.hpp"
#include "render/mannequin/face_mesh.hpp"
#include "render/mannequin/face_shape.hpp"
#include "render/mannequin/hair_mesh.hpp"
#include "render/mannequin/painted_mesh.hpp"

#include <glm/ext/matrix_transform.hpp>

namespace raks::render {
namespace {

using motion::Bone;

enum PaintedMaterial : int { kOnSkin, kCloth };

class WornModel {
 public:
    WornModel(const motion::Skeleton& skeleton, const BodyField& field, MannequinStyle style)
        : field_(field), style_(style) {
        model_.name = "Raks mannequin";
        add_bones(skeleton);
        add_materials();
    }

    Model build() {
        const HairStyle style =
            style_.build == MannequinBuild::lead ? HairStyle::cropped : HairStyle::ponytail;
        PaintedMesh on_head;
        std::vector<MorphTarget> targets =
            add_face(field_, style_.build, joint_of(Bone::head), on_head);
        add_hair(field_, style, joint_of(Bone::head), add_tail(style), on_head);
        ModelMesh mesh{.name = "head", .primitives = {}, .morph_names = {}, .morph_weights = {}};
        mesh.primitives.push_back(on_head.take(kOnSkin));
        mesh.primitives.back().morphs = std::move(targets);
        for (const std::string_view name : kFaceExpressionNames) {
            mesh.morph_names.emplace_back(name);
        }
        mesh.morph_weights.assign(kFaceExpressionCount, 0.0F);
        const int face = add_mesh(std::move(mesh));
        add_expressions(face);
        for (const ClothCut& cut : cloth_of(style_)) {
            add_cloth_with_springs(cut);
        }
        add_skin();
        return std::move(model_);
    }

 private:
    static std::uint16_t joint_of(Bone bone) noexcept {
        return static_cast<std::uint16_t>(motion::index_of(bone));
    }

    /// A node at a place of the world; all stand upright, so that offsets are differences.
    int add_node(std::string name, int parent, glm::vec3 place) {
        const int number = static_cast<int>(model_.nodes.size());
        ModelNode node;
        node.name = std::move(name);
        node.parent = parent;
        node.translation = parent < 0 ? place : place - places_[static_cast<std::size_t>(parent)];
        model_.nodes.push_back(std::move(node));
        places_.push_back(place);
        if (parent < 0) {
            model_.roots.push_back(number);
        } else {
            model_.nodes[static_cast<std::size_t>(parent)].children.push_back(number);
        }
        return number;
    }

    void add_bones(const motion::Skeleton& skeleton) {
        motion::Pose upright;
        upright.hips_position = skeleton.offsets[0];
        const motion::WorldPose world = motion::world_pose(skeleton, upright);
        for (std::size_t b = 0; b < motion::kBoneCount; ++b) {
            const int parent = b == 0 ? -1 : static_cast<int>(motion::kBoneParents[b]);
            add_node(std::string(motion::kBoneNames[b]), parent, world.positions[b]);
            model_.character.humanoid.nodes[b] = static_cast<int>(b);
            model_.character.humanoid.reasons[b] = BoneReason::stated;
            model_.character.humanoid.confidence[b] = 1.0F;
        }
    }

    void add_materials() {
        for (const bool is_double_sided : {false, true}) {
            ModelMaterial material;
            material.name = is_double_sided ? "cloth" : "on skin";
            material.metallic = 0.0F;
            // Cloth is matte.
            material.roughness = is_double_sided ? 0.92F : 0.75F;
            material.is_painted = true;
            material.is_costume = is_double_sided;
            material.is_double_sided = is_double_sided;
            model_.materials.push_back(std::move(material));
        }
    }

    int add_mesh(ModelMesh mesh) {
        const int node = add_node(mesh.name, -1, glm::vec3(0.0F));
        model_.nodes[static_cast<std::size_t>(node)].mesh = static_cast<int>(model_.meshes.size());
        model_.nodes[static_cast<std::size_t>(node)].skin = 0;
        model_.meshes.push_back(std::move(mesh));
        return node;
    }

    /// One skin for all: every node that came before it.
    void add_skin() {
        ModelSkin skin;
        for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
            skin.joints.push_back(static_cast<int>(i));
            skin.inverse_bind.push_back(glm::translate(glm::mat4(1.0F), -places_[i]));
        }
        model_.skins.push_back(std::move(skin));
    }

    void add_expressions(int face) {
        for (std::size_t i = 0; i < kFaceExpressionCount; ++i) {
            Expression expression{.name = std::string(kFaceExpressionNames[i]),
                                  .is_preset = i < kPresetExpressionCount,
                                  .morphs = {},
                                  .colours = {},
                                  .textures = {}};
            expression.morphs.push_back({.node = face, .target = static_cast<int>(i)});
            // A lid that is half shut already must not go through the lower one.
            if (face_shape(static_cast<FaceExpression>(i)).lids[0] > 0.1F && i < 6) {
                expression.override_blink = ExpressionOverride::blend;
            }
            model_.character.expressions.push_back(std::move(expression));
        }
        LookAt& look = model_.character.look_at;
        look.is_by_bones = false;
        look.offset_from_head = face_eyes() - places_[motion::index_of(Bone::head)];
        look.horizontal_inner = look.horizontal_outer = {.input_max = 40.0F, .output_scale = 1.0F};
        look.vertical_down = look.vertical_up = {.input_max = 25.0F, .output_scale = 1.0F};
        model_.character.has_look_at = true;
    }

    int add_collider(SpringCollider collider) {
        model_.character.colliders.push_back(collider);
        return static_cast<int>(model_.character.colliders.size()) - 1;
    }

    /// Nodes and spring of the hair's tail; its joints in the skin.
    std::vector<std::uint16_t> add_tail(HairStyle style) {
        std::vector<std::uint16_t> joints;
        SpringChain chain{.name = "hair", .joints = {}, .colliders = {}};
        int parent = static_cast<int>(joint_of(Bone::head));
        for (const glm::vec3& place : hair_tail(style)) {
            parent = add_node("hair" + std::to_string(joints.size()), parent, place);
            // The root is held by its ribbon; the tip follows freely.
            const float loose = static_cast<float>(joints.size());
            chain.joints.push_back(
                {.node = parent,
                 .hit_radius = 0.022F,
                 .stiffness = joints.empty() ? 4.0F : 0.9F / (0.6F + 0.3F * loose),
                 .gravity_power = 0.40F,
                 .drag = 0.36F});
            joints.push_back(static_cast<std::uint16_t>(parent));
        }
        if (joints.empty()) {
            return joints;
        }
        const int head = static_cast<int>(joint_of(Bone::head));
        const int neck = static_cast<int>(joint_of(Bone::neck));
        const int chest = static_cast<int>(joint_of(Bone::upper_chest));
        const auto from = [&](int node, glm::vec3 place) {
            return place - places_[static_cast<std::size_t>(node)];
        };
        chain.colliders = {
            add_collider(
                {.node = head, .offset = from(head, {0.0F, 1.6150F, -0.0080F}), .radius = 0.098F}),
            add_collider({.node = neck,
                          .shape = ColliderShape::capsule,
                          .offset = from(neck, {0.0F, 1.520F, -0.020F}),
                          .tail = from(neck, {0.0F, 1.420F, -0.038F}),
                          .radius = 0.058F}),
            add_collider({.node = chest,
                          .shape = ColliderShape::capsule,
                          .offset = from(chest, {0.085F, 1.355F, -0.035F}),
                          .tail = from(chest, {-0.085F, 1.355F, -0.035F}),
                          .radius = 0.085F})};
        model_.character.springs.push_back(std::move(chain));
        return joints;
    }

    /// Capsules that stand for the legs, on both sides. Three side by side, so that chains beside
    /// the middle of a leg are pushed before it and do not slip off to its two sides, where the leg
    /// would come through between them.
    std::vector<int> add_leg_colliders(const ClothCut& cut) {
        constexpr std::array kAside = {-0.055F, 0.0F, 0.055F};
        constexpr float kThinner = 0.020F;  // those beside the middle
        std::vector<int> colliders;
        const auto add = [&](Bone bone, glm::vec3 offset, glm::vec3 tail, float radius) {
            for (const float aside : kAside) {
                const glm::vec3 shift{aside, 0.0F, 0.0F};
                colliders.push_back(
                    add_collider({.node = static_cast<int>(joint_of(bone)),
                                  .shape = ColliderShape::capsule,
                                  .offset = offset + shift,
                                  .tail = tail + shift,
                                  .radius = aside == 0.0F ? radius : radius - kThinner}));
            }
        };
        for (const Bone thigh : {Bone::left_upper_leg, Bone::right_upper_leg}) {
            add(thigh, {0.0F, -0.030F, 0.0F}, {0.0F, -0.390F, 0.004F}, cut.thigh_radius);
        }
        if (cut.shank_radius > 0.0F) {
            for (const Bone shank : {Bone::left_lower_leg, Bone::right_lower_leg}) {
                add(shank, {0.0F, 0.0F, 0.006F}, {0.0F, -0.380F, 0.0F}, cut.shank_radius);
            }
        }
        return colliders;
    }

    void add_cloth_with_springs(const ClothCut& cut) {
        const int hips = static_cast<int>(joint_of(Bone::hips));
        const std::vector<int> colliders = add_leg_colliders(cut);
        std::vector<std::uint16_t> joints;
        for (std::size_t c = 0; c < cut.chains; ++c) {
            SpringChain chain{.name = "cloth" + std::to_string(model_.character.springs.size()),
                              .joints = {},
                              .colliders = colliders};
            int parent = hips;
            for (const glm::vec3& place : cloth_chain(cut, c)) {
                parent =
                    add_node(chain.name + "_" + std::to_string(chain.joints.size()), parent, place);
                chain.joints.push_back({.node = parent,
                                        .hit_radius = 0.022F,
                                        .stiffness = cut.stiffness,
                                        .gravity_power = 0.30F,
                                        .drag = 0.38F});
                joints.push_back(static_cast<std::uint16_t>(parent));
            }
            model_.character.springs.push_back(std::move(chain));
        }
        PaintedMesh cloth;
        add_cloth(cut, field_, joint_of(Bone::hips), joints, cloth);
        ModelMesh mesh{.name = "cloth", .primitives = {}, .morph_names = {}, .morph_weights = {}};
        mesh.primitives.push_back(cloth.take(kCloth));
        add_mesh(std::move(mesh));
    }

    const BodyField& field_;
    MannequinStyle style_;
    Model model_;
    std::vector<glm::vec3> places_;  // of the nodes, in the T-pose
};

}  // namespace

Model worn_model(const motion::Skeleton& skeleton, const BodyField& field, MannequinStyle style) {
    return WornModel(skeleton, field, style).build();
}

}  // namespace raks::render
