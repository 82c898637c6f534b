// The mannequin as a model: it moves as the mannequin does, here and when it was written and read.
#include "render/mannequin/mannequin_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "render/avatar/avatar_rig.hpp"
#include "render/avatar/skin_vertices.hpp"
#include "render/export/glb_writer.hpp"
#include "render/export/vrm_writer.hpp"
#include "render/import/gltf_reader.hpp"
#include "render/mannequin/mannequin.hpp"
#include "render/mannequin/test_poses.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

const Model& model() {
    static const Model built = mannequin_model({});
    return built;
}

/// All vertices of the nodes that carry a mesh, in their order.
std::vector<glm::vec3> posed(const Model& shown, const motion::Pose& pose) {
    const AvatarRig rig = build_rig(shown);
    RigState state(rig);
    pose_joints(rig, pose, 1.0F, state);
    std::vector<glm::vec3> places;
    PosedVertices vertices;
    for (std::size_t i = 0; i < shown.nodes.size(); ++i) {
        const auto node = static_cast<int>(i);
        if (shown.nodes[i].mesh < 0) {
            continue;
        }
        std::vector<glm::mat4> matrices(matrix_count(shown, node));
        skinning_matrices(shown, rig.tree, state.joints, node, matrices);
        for (const auto& part :
             shown.meshes[static_cast<std::size_t>(shown.nodes[i].mesh)].primitives) {
            pose_vertices(part, {}, matrices, vertices);
            places.insert(places.end(), vertices.positions.begin(), vertices.positions.end());
        }
    }
    return places;
}

float farthest(const std::vector<glm::vec3>& found, const std::vector<glm::vec3>& wanted) {
    EXPECT_EQ(found.size(), wanted.size());
    float most = 0.0F;
    for (std::size_t v = 0; v < std::min(found.size(), wanted.size()); ++v) {
        most = std::max(most, glm::distance(found[v], wanted[v]));
    }
    return most;
}

TEST(MannequinModel, written_and_read_it_moves_as_before_within_a_tenth_of_a_millimetre) {
    for (const bool as_vrm : {false, true}) {
        const auto bytes = as_vrm ? vrm_bytes(model()) : glb_bytes(model());
        ASSERT_TRUE(bytes) << bytes.error().message;
        auto read = read_gltf(std::as_bytes(std::span(bytes->data(), bytes->size())), SideFiles());
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_TRUE(read->warnings.empty()) << read->warnings[0];
        if (!as_vrm) {
            // glTF itself tells neither bones nor constraints.
            read->character = model().character;
        }
        for (const auto& [name, posture] : mannequin_test_poses()) {
            motion::Pose pose = posture;
            pose.hips_position = {0.1F, 0.9F, -0.2F};
            EXPECT_LT(farthest(posed(*read, pose), posed(model(), pose)), 1e-4F) << name;
        }
    }
}

/// Places of the mannequin's own vertices, in the order of the avatar, by its own palette, and
/// whether a helper moves them that the model folds.
struct OwnSkin {
    std::vector<glm::vec3> bind;
    std::vector<glm::vec3> places;
    std::vector<bool> is_folded;
};

OwnSkin own_skin(const Avatar& avatar, const motion::Pose& pose) {
    std::array<glm::mat4, kPaletteSize> palette{};
    joint_matrices(avatar, pose, palette);
    OwnSkin own;
    for (const AvatarVertex& vertex : avatar.vertices) {
        const glm::vec4 bind(vertex.position[0], vertex.position[1], vertex.position[2], 1.0F);
        glm::vec4 place(0.0F);
        bool is_folded = false;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t joint = vertex.joints[k];
            const float weight = static_cast<float>(vertex.weights[k]) / 255.0F;
            place += weight * (palette[joint] * (avatar.inverse_bind[joint] * bind));
            if (weight > 0.0F && joint >= motion::kBoneCount) {
                const HelperKind kind = avatar.helpers[joint - motion::kBoneCount].kind;
                is_folded = is_folded || kind == HelperKind::half_swing ||
                            kind == HelperKind::swing_half_roll;
            }
        }
        own.bind.emplace_back(bind);
        own.places.emplace_back(place);
        own.is_folded.push_back(is_folded);
    }
    return own;
}

TEST(MannequinModel, where_no_helper_is_folded_its_skin_is_the_mannequins) {
    const Avatar avatar = build_mannequin();
    const ModelNode& body =
        *std::find_if(model().nodes.begin(), model().nodes.end(), [](const ModelNode& node) {
            return node.name == "body";
        });
    const ModelMesh& mesh = model().meshes[static_cast<std::size_t>(body.mesh)];
    const auto node = static_cast<int>(&body - model().nodes.data());
    const AvatarRig rig = build_rig(model());
    for (const auto& [name, posture] : mannequin_test_poses()) {
        motion::Pose pose = posture;
        pose.hips_position = {0.0F, 0.9F, 0.0F};
        const OwnSkin own = own_skin(avatar, pose);
        std::map<std::array<float, 3>, std::size_t> number;
        for (std::size_t i = 0; i < own.bind.size(); ++i) {
            number.emplace(avatar.vertices[i].position, i);
        }
        RigState state(rig);
        pose_joints(rig, pose, 1.0F, state);
        std::vector<glm::mat4> matrices(matrix_count(model(), node));
        skinning_matrices(model(), rig.tree, state.joints, node, matrices);
        std::size_t compared = 0;
        float most = 0.0F;
        for (const ModelPrimitive& part : mesh.primitives) {
            PosedVertices vertices;
            pose_vertices(part, {}, matrices, vertices);
            for (std::size_t v = 0; v < part.positions.size(); ++v) {
                const glm::vec3& p = part.positions[v];
                const auto found = number.find({p.x, p.y, p.z});
                if (found != number.end() && !own.is_folded[found->second]) {
                    ++compared;
                    most = std::max(
                        most, glm::distance(vertices.positions[v], own.places[found->second]));
                }
            }
        }
        EXPECT_GT(compared, avatar.vertices.size() / 2);
        EXPECT_LT(most, 1e-4F) << name;
    }
}

TEST(MannequinModel, elbows_knees_and_forearms_keep_their_helpers) {
    ASSERT_EQ(model().character.constraints.size(), 6U);
    EXPECT_TRUE(build_rig(model()).warnings.empty());
}

TEST(MannequinModel, each_material_has_one_colour_of_the_dress) {
    PaintColours colours{};
    for (std::size_t i = 0; i < colours.size(); ++i) {
        colours[i] = glm::vec3(0.1F * static_cast<float>(i));
    }
    const Model dressed = mannequin_model(colours, {MannequinBuild::lead});
    EXPECT_GE(dressed.materials.size(), colours.size());
    for (const ModelMaterial& material : dressed.materials) {
        EXPECT_FALSE(material.is_painted);
        EXPECT_NE(std::find(colours.begin(), colours.end(), glm::vec3(material.base_colour)),
                  colours.end());
    }
    for (const ModelMesh& mesh : dressed.meshes) {
        for (const ModelPrimitive& part : mesh.primitives) {
            EXPECT_EQ(part.morphs.size(), mesh.morph_names.size());
        }
    }
}

}  // namespace
}  // namespace raks::render
