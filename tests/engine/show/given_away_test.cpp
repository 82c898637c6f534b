// Models written as VRM 1.0: read back, they move as they did.
#include "engine/show/given_away.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "render/avatar/avatar_rig.hpp"
#include "render/avatar/skin_vertices.hpp"
#include "render/export/segmented_model.hpp"
#include "render/export/tds_writer.hpp"
#include "render/export/vrm_writer.hpp"
#include "render/import/gltf_reader.hpp"
#include "render/import/humanoid_labels.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/tds_reader.hpp"
#include "render/mannequin/test_poses.hpp"
#include "render/model/model_survey.hpp"
#include "tests/support/shared_data.hpp"

#include <glm/geometric.hpp>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;
using render::Model;

const fs::path kAvatars = fs::path(RAKS_SOURCE_DIR) / "tests" / "data" / "avatars";

/// All vertices of a model in a posture, without what swings.
std::vector<glm::vec3> posed(const Model& model,
                             const render::RigOptions& options,
                             const motion::Pose& pose) {
    const render::AvatarRig rig = render::build_rig(model, options);
    render::RigState state(rig);
    render::pose_joints(rig, pose, 1.0F, state);
    std::vector<glm::vec3> places;
    render::PosedVertices vertices;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        const auto node = static_cast<int>(i);
        if (model.nodes[i].mesh < 0) {
            continue;
        }
        std::vector<glm::mat4> matrices(render::matrix_count(model, node));
        render::skinning_matrices(model, rig.tree, state.joints, node, matrices);
        for (const auto& part :
             model.meshes[static_cast<std::size_t>(model.nodes[i].mesh)].primitives) {
            render::pose_vertices(part, {}, matrices, vertices);
            places.insert(places.end(), vertices.positions.begin(), vertices.positions.end());
        }
    }
    return places;
}

/// A model that was written and read again.
Expected<Model> written(Model model) {
    render::Licence& licence = model.character.licence;
    licence.title = licence.title.empty() ? "x" : licence.title;
    licence.authors.resize(std::max<std::size_t>(licence.authors.size(), 1), "somebody");
    const auto bytes = render::vrm_bytes(model);
    if (!bytes) {
        return fail(bytes.error());
    }
    return render::read_gltf(std::as_bytes(std::span(bytes->data(), bytes->size())),
                             render::SideFiles());
}

void expect_moves_as_before(const fs::path& file) {
    SCOPED_TRACE(file.string());
    const auto before = load_avatar_model(file);
    ASSERT_TRUE(before) << before.error().message;
    auto given = load_to_give_away(file, {});
    ASSERT_TRUE(given) << given.error().message;
    const auto read = written(std::move(*given));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->character.vrm, render::VrmVersion::vrm1);
    for (const auto& [name, posture] : render::mannequin_test_poses()) {
        motion::Pose pose = posture;
        pose.hips_position = {0.1F, 0.9F, -0.2F};
        const auto wanted = posed(before->model, before->options, pose);
        const auto found = posed(*read, {}, pose);
        ASSERT_EQ(found.size(), wanted.size());
        float most = 0.0F;
        for (std::size_t v = 0; v < found.size(); ++v) {
            most = std::max(most, glm::distance(found[v], wanted[v]));
        }
        EXPECT_LT(most, 1e-4F) << name;
    }
}

TEST(GivenAway, figures_move_as_before_within_a_tenth_of_a_millimetre) {
    for (const char* name : {"Godette_vrm_v4.vrm", "RiggedFigure.glb"}) {
        expect_moves_as_before(kAvatars / name);
    }
}

TEST(GivenAway, shared_figures_of_all_formats_move_as_before) {
    const fs::path models = test::shared_data() / "avatars" / "models";
    if (!fs::exists(models)) {
        GTEST_SKIP() << "no shared data";
    }
    for (const char* name : {"vrm1/seed_san_rebuilt.vrm",
                             "vrm0/cool_loops.vrm",
                             "gltf/mannequiny-0.3.0.glb",
                             "gltf/robot.glb"}) {
        expect_moves_as_before(models / name);
    }
}

/// The corners of all triangles of rigid parts in a posture.
std::vector<glm::vec3> corners(const Model& model, const motion::Pose& pose) {
    const render::AvatarRig rig = render::build_rig(model, {});
    render::RigState state(rig);
    render::pose_joints(rig, pose, 1.0F, state);
    std::vector<glm::vec3> places;
    render::PosedVertices vertices;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (model.nodes[i].mesh < 0) {
            continue;
        }
        glm::mat4 matrix(1.0F);
        render::skinning_matrices(
            model, rig.tree, state.joints, static_cast<int>(i), std::span(&matrix, 1));
        for (const auto& part :
             model.meshes[static_cast<std::size_t>(model.nodes[i].mesh)].primitives) {
            render::pose_vertices(part, {}, std::span(&matrix, 1), vertices);
            for (const std::uint32_t corner : part.indices) {
                places.push_back(vertices.positions[corner]);
            }
        }
    }
    return places;
}

float farthest(const std::vector<glm::vec3>& found, const std::vector<glm::vec3>& wanted) {
    EXPECT_EQ(found.size(), wanted.size());
    float most = found.size() == wanted.size() ? 0.0F : 1e9F;
    for (std::size_t v = 0; v < found.size() && v < wanted.size(); ++v) {
        most = std::max(most, glm::distance(found[v], wanted[v]));
    }
    return most;
}

/// Written as 3DS and read again, its bones known by the names that they were given.
Expected<Model> written_as_tds(const Model& parts) {
    const auto made = render::tds_export(parts, "figure");
    if (!made) {
        return fail(made.error());
    }
    auto read = render::read_tds(std::as_bytes(std::span(made->bytes.data(), made->bytes.size())),
                                 render::SideFiles());
    if (!read) {
        return read;
    }
    render::BoneLabels labels{.file = "x", .bones = {}};
    for (std::size_t i = 0; i < motion::kBoneCount; ++i) {
        const int node = parts.character.humanoid.nodes[i];
        if (node >= 0) {
            labels.bones.push_back({.bone = static_cast<motion::Bone>(i),
                                    .node = made->node_names[static_cast<std::size_t>(node)]});
        }
    }
    const auto mapped = render::map_humanoid(*read, &labels);
    return mapped ? std::move(read) : fail(mapped.error());
}

void expect_parts_move_as_before(const Model& figure) {
    const Model parts = render::segmented_model(figure);
    const auto whole_box = render::rest_box(figure);
    const auto parts_box = render::rest_box(parts);
    ASSERT_TRUE(whole_box && parts_box);
    EXPECT_LT(glm::distance(whole_box->low, parts_box->low), 1e-4F);
    EXPECT_LT(glm::distance(whole_box->high, parts_box->high), 1e-4F);
    EXPECT_EQ(render::survey(figure).triangles, render::survey(parts).triangles);
    const auto read = written_as_tds(parts);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->nodes.size(), parts.nodes.size());
    for (std::size_t i = 0; i < parts.nodes.size(); ++i) {
        EXPECT_EQ(read->nodes[i].parent, parts.nodes[i].parent);
    }
    EXPECT_EQ(read->character.humanoid.nodes, parts.character.humanoid.nodes);
    EXPECT_EQ(read->materials.size(), parts.materials.size());
    for (const auto& [name, posture] : render::mannequin_test_poses()) {
        motion::Pose pose = posture;
        pose.hips_position = {0.1F, 0.9F, -0.2F};
        EXPECT_LT(farthest(corners(*read, pose), corners(parts, pose)), 1e-4F) << name;
    }
}

TEST(GivenAway, figures_become_parts_of_3ds_that_move_as_before) {
    for (const char* name : {"Godette_vrm_v4.vrm", "RiggedFigure.glb", "kenney_character.glb"}) {
        SCOPED_TRACE(name);
        const auto figure = load_to_give_away(kAvatars / name, {});
        ASSERT_TRUE(figure) << figure.error().message;
        expect_parts_move_as_before(*figure);
    }
}

TEST(GivenAway, the_mannequin_becomes_parts_of_3ds_that_move_as_before) {
    expect_parts_move_as_before(mannequin_to_give_away());
}

TEST(GivenAway, what_a_figure_has_besides_is_kept) {
    auto model = load_to_give_away(kAvatars / "Godette_vrm_v4.vrm", {});
    ASSERT_TRUE(model) << model.error().message;
    const Model before = *model;
    const auto read = written(std::move(*model));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->character.licence.title, before.character.licence.title);
    EXPECT_EQ(read->character.licence.authors, before.character.licence.authors);
    EXPECT_EQ(read->character.expressions.size(), before.character.expressions.size());
    EXPECT_EQ(read->character.springs.size(), before.character.springs.size());
    EXPECT_EQ(read->character.colliders.size(), before.character.colliders.size());
    EXPECT_EQ(read->character.has_look_at, before.character.has_look_at);
    ASSERT_EQ(read->materials.size(), before.materials.size());
    for (std::size_t i = 0; i < read->materials.size(); ++i) {
        EXPECT_EQ(read->materials[i].mtoon.has_value(), before.materials[i].mtoon.has_value());
    }
}

}  // namespace
}  // namespace raks::engine
