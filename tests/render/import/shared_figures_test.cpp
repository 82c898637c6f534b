// The figures of the shared data: what VRM says of their bones, and which nodes are found in those
// that say nothing. Skipped where the data are not there.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "render/import/bind_places.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/humanoid_names.hpp"
#include "render/import/humanoid_shape.hpp"
#include "render/import/model_reader.hpp"
#include "render/import/standing_body.hpp"
#include "render/model/model_survey.hpp"
#include "tests/render/import/table.hpp"
#include "tests/support/shared_data.hpp"

namespace {

namespace fs = std::filesystem;
using namespace raks;
using namespace raks::render;
using motion::Bone;

fs::path figures() { return raks::test::shared_data() / "avatars"; }

class SharedFigures : public testing::Test {
 protected:
    void SetUp() override {
        if (!fs::exists(figures() / "humanoid.tsv")) {
            GTEST_SKIP() << "no shared data";
        }
    }
};

std::string found_name(const Model& model, const HumanoidMap& map, Bone bone) {
    const int node = map.nodes[motion::index_of(bone)];
    return node < 0 ? "-" : model.nodes[static_cast<std::size_t>(node)].name;
}

/// VRM 1.0's name of what humanoid.tsv lists: 0.x thumbs are named one joint on.
std::string name_in_vrm1(std::string bone, bool is_vrm0) {
    for (const std::string side : {"left", "right"}) {
        if (is_vrm0 && bone == side + "ThumbProximal") {
            return side + "ThumbMetacarpal";
        }
        if (is_vrm0 && bone == side + "ThumbIntermediate") {
            return side + "ThumbProximal";
        }
    }
    return bone;
}

std::map<std::string, std::map<std::string, int>> stated_maps() {
    std::map<std::string, std::map<std::string, int>> maps;
    for (const raks::test::TableRow& row : raks::test::read_table(figures() / "humanoid.tsv")) {
        const std::string file = row.at("file");
        maps[file][name_in_vrm1(row.at("vrm_bone"), file.rfind("vrm0/", 0) == 0)] =
            std::stoi(row.at("node_index"));
    }
    return maps;
}

std::map<std::string, int> as_map(const HumanoidMap& humanoid) {
    std::map<std::string, int> map;
    for (std::size_t bone = 0; bone < humanoid.nodes.size(); ++bone) {
        if (humanoid.nodes[bone] >= 0) {
            map[std::string(motion::kBoneNames[bone])] = humanoid.nodes[bone];
        }
    }
    const std::pair<const char*, int> face[] = {
        {"leftEye", humanoid.left_eye}, {"rightEye", humanoid.right_eye}, {"jaw", humanoid.jaw}};
    for (const auto& [name, node] : face) {
        if (node >= 0) {
            map[name] = node;
        }
    }
    return map;
}

TEST_F(SharedFigures, of_vrm_have_the_bones_that_the_files_state) {
    const auto maps = stated_maps();
    EXPECT_GE(maps.size(), 17U);
    for (const auto& [file, stated] : maps) {
        SCOPED_TRACE(file);
        const auto model = load_model(figures() / "models" / file);
        ASSERT_TRUE(model) << model.error().message;
        EXPECT_EQ(as_map(model->character.humanoid), stated);
    }
}

TEST_F(SharedFigures, of_vrm_are_found_by_their_names_too) {
    for (const auto& [file, stated] : stated_maps()) {
        SCOPED_TRACE(file);
        const auto model = load_model(figures() / "models" / file);
        ASSERT_TRUE(model);
        const HumanoidMap named = map_by_names(*model);
        for (const auto& [bone, node] : as_map(named)) {
            const auto found = stated.find(bone);
            if (found != stated.end()) {
                EXPECT_EQ(found->second, node) << bone;
            }
        }
        EXPECT_EQ(missing_bones(named), "");
    }
}

TEST_F(SharedFigures, of_vrm_are_found_by_their_shape_too) {
    for (const auto& [file, stated] : stated_maps()) {
        if (file.rfind("vrma/", 0) == 0) {
            continue;
        }
        const auto model = load_model(figures() / "models" / file);
        ASSERT_TRUE(model);
        std::vector<glm::vec3> places = places_of(rest_world(*model));
        if (model->character.faces_minus_z) {
            for (glm::vec3& place : places) {
                place = {-place.x, place.y, -place.z};
            }
        }
        const HumanoidMap shaped = map_by_shape(*model, places);
        std::string wrong;
        for (const Bone bone : kRequiredBones) {
            const std::string name(motion::kBoneNames[motion::index_of(bone)]);
            if (shaped.nodes[motion::index_of(bone)] != stated.at(name)) {
                wrong += name + "=" + found_name(*model, shaped, bone) + " ";
            }
        }
        EXPECT_EQ(wrong, "") << file;
    }
}

/// Some bones that must be found in a file, by the names of their nodes.
struct KnownFigure {
    const char* file;
    std::vector<std::pair<Bone, const char*>> bones;
};

TEST_F(SharedFigures, of_gltf_are_found) {
    const std::vector<KnownFigure> known = {
        {"robot.glb",
         {{Bone::hips, "Body"},
          {Bone::spine, "Abdomen"},
          {Bone::chest, "Torso"},
          {Bone::head, "Head"},
          {Bone::left_foot, "Foot.L"},
          {Bone::right_hand, "Palm2.R"},
          {Bone::left_index_proximal, "Index.L"}}},
        {"mannequiny-0.3.0.glb",
         {{Bone::hips, "pelvis"},
          {Bone::spine, "spine_01"},
          {Bone::chest, "spine_02"},
          {Bone::neck, "neck_01"},
          {Bone::left_shoulder, "clavicle.l"},
          {Bone::right_toes, "ball.r"},
          {Bone::left_ring_distal, "ring_03.l"}}},
        {"CesiumMan.glb",
         {{Bone::hips, "Skeleton_torso_joint_1"},
          {Bone::chest, "torso_joint_3"},
          {Bone::neck, "Skeleton_neck_joint_1"},
          {Bone::head, "Skeleton_neck_joint_2"},
          {Bone::left_upper_arm, "Skeleton_arm_joint_L__4_"},
          {Bone::right_hand, "Skeleton_arm_joint_R__3_"},
          {Bone::left_toes, "leg_joint_L_5"}}},
        {"RiggedFigure.glb",
         {{Bone::hips, "torso_joint_1"},
          {Bone::head, "neck_joint_2"},
          {Bone::left_hand, "arm_joint_L_3"}}},
        {"kaykit_manny/manny_med_mod.gltf",
         {{Bone::hips, "hips"},
          {Bone::head, "head"},
          {Bone::left_hand, "wrist.l"},
          {Bone::right_toes, "toes.r"}}},
        {"valid_Black_F_1_Casual.glb",
         {{Bone::hips, "Hips"},
          {Bone::upper_chest, "Spine2"},
          {Bone::right_thumb_metacarpal, "RightHandThumb1"},
          {Bone::left_little_distal, "LeftHandPinky3"}}},
    };
    for (const KnownFigure& figure : known) {
        SCOPED_TRACE(figure.file);
        auto model = load_model(figures() / "models" / "gltf" / figure.file);
        ASSERT_TRUE(model) << model.error().message;
        const auto mapped = map_humanoid(*model);
        ASSERT_TRUE(mapped) << mapped.error().message;
        for (const auto& [bone, name] : figure.bones) {
            EXPECT_EQ(found_name(*model, model->character.humanoid, bone), name)
                << motion::kBoneNames[motion::index_of(bone)];
        }
        const StandingBody standing = stand_up(*model);
        const auto place = [&](Bone bone) {
            return glm::vec3(standing.world[static_cast<std::size_t>(
                model->character.humanoid.nodes[motion::index_of(bone)])][3]);
        };
        EXPECT_GT(place(Bone::left_hand).x, place(Bone::right_hand).x);
        EXPECT_GT(place(Bone::head).y, place(Bone::hips).y);
        EXPECT_GT(place(Bone::hips).y, place(Bone::left_foot).y);
        EXPECT_GE(standing.height * standing.scale, kLeastHeight);
        EXPECT_LE(standing.height * standing.scale, kMostHeight);
    }
}

TEST_F(SharedFigures, that_are_no_humanoids_are_refused_with_what_is_missing) {
    for (const std::string file :
         {"Fox.glb", "greenman.glb", "SimpleSkin.gltf", "RiggedSimple.glb"}) {
        auto model = load_model(figures() / "models" / "gltf" / file);
        ASSERT_TRUE(model) << model.error().message;
        const auto mapped = map_humanoid(*model);
        ASSERT_FALSE(mapped) << file;
        if (file == "Fox.glb") {
            EXPECT_EQ(mapped.error().message, "it does not stand upright on two legs");
        } else {
            EXPECT_NE(mapped.error().message.find("no humanoid is found in it: no "),
                      std::string::npos)
                << mapped.error().message;
            EXPECT_NE(mapped.error().message.find("leftLowerArm"), std::string::npos);
        }
    }
}

TEST_F(SharedFigures, of_vrm_that_are_bad_say_what_was_wrong) {
    int files = 0;
    for (const raks::test::TableRow& row :
         raks::test::read_table(figures() / "bad" / "INDEX.tsv")) {
        if (row.at("format").rfind("VRM", 0) != 0) {
            continue;
        }
        SCOPED_TRACE(row.at("file") + ": " + row.at("what is wrong"));
        ++files;
        const auto model = load_model(figures() / "bad" / row.at("file"));
        const std::string& expected = row.at("expected");
        if (!model) {
            EXPECT_NE(expected.find("reject"), std::string::npos) << model.error().message;
            EXPECT_EQ(expected.find("reject spring"), std::string::npos) << model.error().message;
            continue;
        }
        EXPECT_NE(expected.find("accept"), std::string::npos);
        if (expected.find("warning") != std::string::npos &&
            expected.find("accept or") == std::string::npos) {
            EXPECT_FALSE(model->warnings.empty());
        }
        if (expected.rfind("reject spring", 0) == 0) {
            EXPECT_TRUE(model->character.springs.empty());
        }
    }
    EXPECT_GE(files, 50);
}

}  // namespace
