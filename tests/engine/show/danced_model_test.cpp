// A dance in a model: read back, it moves as the rig did.
#include "engine/show/danced_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <vector>

#include "engine/show/given_away.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/avatar/avatar.hpp"
#include "render/avatar/avatar_rig.hpp"
#include "render/avatar/model_avatar.hpp"
#include "render/export/glb_writer.hpp"
#include "render/import/gltf_reader.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;
using render::Model;

const fs::path kFigureFiles = fs::path(RAKS_SOURCE_DIR) / "tests" / "data" / "avatars";
constexpr double kRate = 30.0;

/// Steps to and fro with arms that swing.
std::vector<motion::Pose> dance() {
    std::vector<motion::Pose> poses;
    for (int i = 0; i < 60; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(kRate);
        motion::Pose& pose = poses.emplace_back();
        pose.hips_position = motion::mannequin_skeleton().offsets[0] +
                             glm::vec3(0.3F * std::sin(3.0F * t), 0.0F, 0.2F * std::cos(2.0F * t));
        for (std::size_t bone = 0; bone < pose.local_rotations.size(); ++bone) {
            pose.local_rotations[bone] = glm::angleAxis(
                0.4F * std::sin(5.0F * t + static_cast<float>(bone)), glm::vec3(0.0F, 0.6F, 0.8F));
        }
    }
    return poses;
}

Expected<Model> written_glb(const Model& model) {
    const auto bytes = render::glb_bytes(model);
    if (!bytes) {
        return fail(bytes.error());
    }
    return render::read_gltf(std::as_bytes(std::span(bytes->data(), bytes->size())),
                             render::SideFiles());
}

/// Where each node is, of a model whose clip was read, at a time of it.
std::vector<glm::mat4> played(const Model& model, float time) {
    const render::JointTree tree = render::build_joint_tree(model);
    render::JointState state = render::rest_state(tree.joints);
    for (const render::AnimationChannel& channel : model.animations.front().channels) {
        const auto joint = static_cast<std::size_t>(tree.joint_of(channel.node));
        const std::size_t width = channel.path == render::ChannelPath::rotation ? 4 : 3;
        const auto key = static_cast<std::size_t>(std::min_element(channel.times.begin(),
                                                                   channel.times.end(),
                                                                   [&](float a, float b) {
                                                                       return std::abs(a - time) <
                                                                              std::abs(b - time);
                                                                   }) -
                                                  channel.times.begin());
        const float* const value = channel.values.data() + width * key;
        if (channel.path == render::ChannelPath::rotation) {
            state.rotations[joint] = glm::quat(value[3], value[0], value[1], value[2]);
        } else {
            state.translations[joint] = {value[0], value[1], value[2]};
        }
    }
    render::update_world(tree.joints, state);
    std::vector<glm::mat4> places(model.nodes.size());
    for (std::size_t joint = 0; joint < tree.joints.size(); ++joint) {
        places[static_cast<std::size_t>(tree.nodes[joint])] = state.world[joint];
    }
    return places;
}

/// Nodes of a figure in the poses of `dance()`, against the clip that is read back: the largest
/// distance, in metres, of all nodes at all times.
float farthest_off(Model model) {
    const std::vector<motion::Pose> poses = dance();
    put_dance(model, poses, {}, kRate, "dance", "song.wav");
    const auto read = written_glb(model);
    EXPECT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->animations.size(), 1U);
    EXPECT_EQ(read->animations.front().name, "dance");
    EXPECT_EQ(read->meshes.size(), model.meshes.size());
    EXPECT_EQ(read->skins.size(), model.skins.size());
    EXPECT_EQ(read->materials.size(), model.materials.size());
    const render::Avatar avatar =
        render::build_avatar(model, std::vector<render::Image>(model.images.size()));
    render::RigState state(*avatar.rig);
    float farthest = 0.0F;
    const auto pose_at = [&](StreamTime time) {
        return render::retargeted(motion::pose_between(poses, to_seconds(time) * kRate),
                                  motion::mannequin_skeleton(),
                                  avatar);
    };
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const double seconds = static_cast<double>(i) / kRate;
        render::advance(*avatar.rig, stream_time_from_seconds(seconds), 1.0F, pose_at, state);
        render::pose_avatar(
            *avatar.rig, pose_at(stream_time_from_seconds(seconds)), {}, 1.0F, state);
        const std::vector<glm::mat4> found = played(*read, static_cast<float>(seconds));
        for (std::size_t joint = 0; joint < state.joints.world.size(); ++joint) {
            const auto node = static_cast<std::size_t>(avatar.rig->tree.nodes[joint]);
            farthest = std::max(
                farthest,
                glm::distance(glm::vec3(state.joints.world[joint][3]), glm::vec3(found[node][3])));
        }
    }
    return farthest;
}

TEST(DancedModel, read_back_moves_as_its_rig_within_a_tenth_of_a_millimetre) {
    for (const char* name : {"Godette_vrm_v4.vrm", "RiggedFigure.glb", "smoke_spring.vrm"}) {
        auto model = load_to_give_away(kFigureFiles / name, {});
        ASSERT_TRUE(model) << model.error().message;
        EXPECT_LT(farthest_off(std::move(*model)), 1e-4F) << name;
    }
    EXPECT_LT(farthest_off(mannequin_to_give_away()), 1e-4F);
}

TEST(DancedModel, has_its_face_as_weights_of_morph_targets) {
    render::Model model = mannequin_to_give_away();
    std::vector<render::Face> faces(5);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        faces[i].weight(render::FaceExpression::happy) = 0.25F * static_cast<float>(i);
    }
    put_dance(model, std::vector<motion::Pose>(5), faces, kRate, "smile");
    const auto read = written_glb(model);
    ASSERT_TRUE(read) << read.error().message;
    const auto& channels = read->animations.front().channels;
    const auto face = std::find_if(channels.begin(), channels.end(), [](const auto& channel) {
        return channel.path == render::ChannelPath::weights;
    });
    ASSERT_NE(face, channels.end());
    ASSERT_EQ(face->times.size(), 5U);
    const std::size_t targets = face->values.size() / 5;
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(face->values[targets * i], 0.25F * static_cast<float>(i), 1e-6F) << "happy";
    }
}

TEST(DancedModel, has_its_dance_for_its_only_clip_and_still_nodes_have_no_channel) {
    auto model = load_to_give_away(kFigureFiles / "RiggedFigure.glb", {});
    ASSERT_TRUE(model) << model.error().message;
    model->animations.resize(3);
    put_dance(*model, std::vector<motion::Pose>(5), {}, kRate, "still");
    ASSERT_EQ(model->animations.size(), 1U);
    EXPECT_LT(model->animations.front().channels.size(), model->nodes.size());
    for (const render::AnimationChannel& channel : model->animations.front().channels) {
        EXPECT_EQ(channel.times.size(), 1U) << "nothing moves";
    }
}

}  // namespace
}  // namespace raks::engine
