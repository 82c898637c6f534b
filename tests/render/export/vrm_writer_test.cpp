// VRM 1.0 that is written: what it must say, and what must be known for it.
#include "render/export/vrm_writer.hpp"

#include <gtest/gtest.h>

#include "render/import/gltf_reader.hpp"

namespace raks::render {
namespace {

/// A figure of nodes alone: one for each bone.
Model bones_alone() {
    Model model;
    for (std::size_t bone = 0; bone < motion::kBoneNames.size(); ++bone) {
        ModelNode node;
        node.name = motion::kBoneNames[bone];
        node.parent = bone == 0 ? -1 : static_cast<int>(motion::kBoneParents[bone]);
        node.translation = {0.0F, 0.1F, 0.0F};
        model.nodes.push_back(node);
        model.character.humanoid.nodes[bone] = static_cast<int>(bone);
        if (bone > 0) {
            model.nodes[static_cast<std::size_t>(node.parent)].children.push_back(
                static_cast<int>(bone));
        }
    }
    model.roots = {0};
    model.character.licence.title = "A figure";
    model.character.licence.authors = {"Ada", "Grace"};
    model.character.licence.name = "https://creativecommons.org/licenses/by/4.0/";
    model.character.licence.is_credit_required = true;
    model.character.licence.terms = {{"commercialUsage", "personalProfit"},
                                     {"allowRedistribution", "true"},
                                     {"unknownTerm", "x"}};
    return model;
}

TEST(VrmWriter, bones_and_licence_are_read_back) {
    const Model model = bones_alone();
    const auto bytes = vrm_bytes(model);
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_TRUE(*bytes == *vrm_bytes(model));
    const auto read = read_gltf(std::as_bytes(std::span(bytes->data(), bytes->size())), {});
    ASSERT_TRUE(read) << read.error().message;
    const Character& found = read->character;
    EXPECT_EQ(found.vrm, VrmVersion::vrm1);
    EXPECT_EQ(found.humanoid.nodes, model.character.humanoid.nodes);
    EXPECT_EQ(found.licence.title, "A figure");
    EXPECT_EQ(found.licence.authors, model.character.licence.authors);
    EXPECT_TRUE(found.licence.is_credit_required);
    const auto says = [&](const char* name, const char* value) {
        const std::pair<std::string, std::string> term(name, value);
        return std::find(found.licence.terms.begin(), found.licence.terms.end(), term) !=
               found.licence.terms.end();
    };
    EXPECT_TRUE(says("commercialUsage", "personalProfit"));
    EXPECT_TRUE(says("allowRedistribution", "true"));
    EXPECT_TRUE(says("otherLicenseUrl", "https://creativecommons.org/licenses/by/4.0/"));
    EXPECT_FALSE(says("unknownTerm", "x"));
}

TEST(VrmWriter, constraints_and_springs_are_read_back) {
    Model model = bones_alone();
    const auto hand = static_cast<int>(motion::index_of(motion::Bone::left_hand));
    model.character.constraints = {{.node = hand,
                                    .source = 0,
                                    .kind = ConstraintKind::roll,
                                    .axis = NodeAxis::y,
                                    .weight = 0.5F}};
    SpringCollider ball;
    ball.node = 0;
    ball.radius = 0.25F;
    SpringCollider wall;
    wall.node = 0;
    wall.shape = ColliderShape::plane;
    model.character.colliders = {ball, wall};
    SpringChain chain;
    chain.name = "thumb";
    for (const motion::Bone bone :
         {motion::Bone::left_thumb_metacarpal, motion::Bone::left_thumb_proximal}) {
        chain.joints.push_back({.node = static_cast<int>(motion::index_of(bone)), .drag = 0.25F});
    }
    chain.colliders = {0, 1};
    model.character.springs = {chain};
    const auto bytes = vrm_bytes(model);
    ASSERT_TRUE(bytes) << bytes.error().message;
    const auto read = read_gltf(std::as_bytes(std::span(bytes->data(), bytes->size())), {});
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->character.constraints.size(), 1U);
    EXPECT_EQ(read->character.constraints[0].node, hand);
    EXPECT_EQ(read->character.constraints[0].kind, ConstraintKind::roll);
    EXPECT_EQ(read->character.constraints[0].axis, NodeAxis::y);
    EXPECT_EQ(read->character.constraints[0].weight, 0.5F);
    ASSERT_EQ(read->character.colliders.size(), 2U);
    EXPECT_EQ(read->character.colliders[0].radius, 0.25F);
    EXPECT_EQ(read->character.colliders[1].shape, ColliderShape::plane);
    ASSERT_EQ(read->character.springs.size(), 1U);
    EXPECT_EQ(read->character.springs[0].colliders, chain.colliders);
    EXPECT_EQ(read->character.springs[0].joints.size(), 2U);
    EXPECT_EQ(read->character.springs[0].joints[0].drag, 0.25F);
}

TEST(VrmWriter, what_vrm_asks_for_must_be_known) {
    Model model = bones_alone();
    model.character.humanoid.nodes[motion::index_of(motion::Bone::left_foot)] = -1;
    EXPECT_EQ(vrm_bytes(model).error().message, "VRM asks for the bone leftFoot, which it lacks");
    model = bones_alone();
    model.character.licence.authors.clear();
    EXPECT_EQ(vrm_bytes(model).error().message,
              "VRM asks for a title and an author, which it does not name");
}

}  // namespace
}  // namespace raks::render
