// What the reader makes of a model that the tests write, and what it says of one that is damaged.
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "render/model/model_survey.hpp"
#include "tests/render/import/tiny_gltf.hpp"
#include "tests/support/mangled.hpp"

namespace {

using namespace raks;
using namespace raks::render;
using raks::test::read_text;
using raks::test::replaced;
using raks::test::tiny_gltf;

TEST(GltfReader, reads_all_parts_of_a_model) {
    const auto model = read_text(tiny_gltf());
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_EQ(model->name, "x");
    EXPECT_TRUE(model->warnings.empty()) << model->warnings.front();
    ASSERT_EQ(model->nodes.size(), 3U);
    EXPECT_EQ(model->nodes[2].name, "upper");
    EXPECT_EQ(model->nodes[2].parent, 1);
    EXPECT_EQ(model->nodes[2].translation, glm::vec3(0, 1, 0));
    EXPECT_EQ(model->roots, (std::vector<int>{0, 1}));
    ASSERT_EQ(model->skins.size(), 1U);
    EXPECT_EQ(model->skins[0].joints, (std::vector<int>{1, 2}));
    EXPECT_EQ(model->skins[0].inverse_bind[1][3], glm::vec4(0, -1, 0, 1));
}

TEST(GltfReader, reads_a_mesh_with_joints_and_morph_targets) {
    const auto model = read_text(tiny_gltf());
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_EQ(model->meshes.size(), 1U);
    const ModelMesh& mesh = model->meshes[0];
    EXPECT_EQ(mesh.morph_names, (std::vector<std::string>{"smile"}));
    EXPECT_EQ(mesh.morph_weights, (std::vector<float>{0.25F}));
    ASSERT_EQ(mesh.primitives.size(), 1U);
    const ModelPrimitive& triangle = mesh.primitives[0];
    EXPECT_EQ(triangle.positions[2], glm::vec3(0, 2, 0));
    EXPECT_EQ(triangle.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(triangle.weights[1], (std::array<float, 4>{0.5F, 0.5F, 0, 0}));
    EXPECT_EQ(triangle.joints[2][0], 1);
    // Only what it moves is kept.
    ASSERT_EQ(triangle.morphs.size(), 1U);
    EXPECT_EQ(triangle.morphs[0].vertices, (std::vector<std::uint32_t>{2}));
    EXPECT_EQ(triangle.morphs[0].positions[0], glm::vec3(0, 0, 1));
}

TEST(GltfReader, reads_materials_with_their_extensions) {
    const auto model = read_text(tiny_gltf());
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_EQ(model->materials.size(), 1U);
    const ModelMaterial& material = model->materials[0];
    EXPECT_EQ(material.base_colour, glm::vec4(1, 0.5F, 0.25F, 1));
    EXPECT_EQ(material.metallic, 0.0F);
    EXPECT_EQ(material.emissive, glm::vec3(2, 0, 0));
    EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(material.alpha_cutoff, 0.25F);
    EXPECT_TRUE(material.is_double_sided);
    EXPECT_TRUE(material.is_unlit);
}

TEST(GltfReader, reads_animations) {
    const auto model = read_text(tiny_gltf());
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_EQ(model->animations.size(), 1U);
    const auto& channels = model->animations[0].channels;
    ASSERT_EQ(channels.size(), 2U);
    EXPECT_EQ(channels[0].path, ChannelPath::rotation);
    EXPECT_EQ(channels[0].times, (std::vector<float>{0, 1}));
    EXPECT_EQ(channels[1].node, 1);
    EXPECT_EQ(channels[1].values, (std::vector<float>{0, 0, 0, 1, 2, 3}));
}

TEST(GltfReader, reads_the_same_from_a_container) {
    const auto text = read_text(tiny_gltf());
    const auto container = read_text(raks::test::tiny_glb(), "x.GLB");
    ASSERT_TRUE(container) << container.error().message;
    EXPECT_EQ(container->meshes[0].primitives[0].positions,
              text->meshes[0].primitives[0].positions);
    EXPECT_EQ(survey(*container).box->high, glm::vec3(1, 2, 0));
}

/// A change to the model, and the line that it is refused with.
struct Fault {
    std::string_view from;
    std::string_view to;
    std::string_view line;
};

constexpr Fault kFaults[] = {
    {R"("version":"2.0")", R"("version":"3.0")", "asset: is not of glTF 2.0; export it as that"},
    {R"("extensionsUsed")",
     R"("extensionsRequired":["KHR_texture_basisu"],"extensionsUsed")",
     "extensionsRequired: it needs the extension KHR_texture_basisu, which Raks does not read; "
     "export it without"},
    {R"("mesh":0)", R"("mesh":9)", "nodes[0].mesh: 9 does not exist: there are 1, counted from 0"},
    {R"("mesh":0)",
     R"("mesh":-1)",
     "nodes[0].mesh: -1 does not exist: there are 1, counted from 0"},
    {R"("mesh":0)", R"("mesh":"0")", "nodes[0].mesh: is a text, not a number"},
    {R"("mesh":0)", R"("mesh":0.5)", "nodes[0].mesh: 0.5 is not a whole number"},
    {R"("children":[2])",
     R"("children":[2,2])",
     "nodes[1].children[1]: node 2 has two parents, but may have one"},
    {R"("translation":[0,1,0])", R"("children":[1])", "nodes: a node lies below itself"},
    {R"("translation":[0,1,0])",
     R"("translation":[0,1])",
     "nodes[2].translation: is not a list of 3 numbers"},
    {R"("nodes":[0,1])",
     R"("nodes":[0,2])",
     "scenes[0].nodes[1]: node 2 has a parent, so that it cannot be listed here"},
    {R"("joints":[1,2])",
     R"("joints":[1])",
     "nodes[0]: meshes[0] names joint 1, but its skin has 1 joints"},
    {R"("joints":[1,2])", R"("joints":[])", "skins[0]: has no joints"},
    {R"("WEIGHTS_0":3)",
     R"("X":3)",
     "meshes[0].primitives[0].attributes: has only one of JOINTS_0 and WEIGHTS_0; both are needed"},
    {R"("POSITION":0)",
     R"("POSITION":6)",
     "meshes[0].primitives[0].attributes.POSITION: accessors[6] is SCALAR, not VEC3"},
    {R"("count":3,"type":"VEC3")",
     R"("count":4000000,"type":"VEC3")",
     "accessors[0]: 4000000 elements need 48000000 bytes; bufferViews[0] has 36"},
    {R"("count":3,"type":"VEC3")",
     R"("count":-3,"type":"VEC3")",
     "accessors[0].count: -3 is not in 1 .. 100000000"},
    {R"("componentType":5126)",
     R"("componentType":5130)",
     "accessors[0].componentType: 5130 is not a value that glTF knows"},
    {R"("byteOffset":0,"byteLength":36)",
     R"("byteOffset":330,"byteLength":36)",
     "bufferViews[0]: bytes 330 to 366 of a buffer of 332"},
    {R"("byteLength":36)",
     R"("byteLength":36,"byteStride":8)",
     "accessors[0]: its elements of 12 bytes lie 8 bytes apart"},
    {R"("byteLength":332)",
     R"("byteLength":333)",
     "buffers[0]: says that it has 333 bytes, but has 332"},
    {"base64,AAAA", "base64,????", "buffers[0].uri: is not base64"},
    {R"("input":6,"output":7)",
     R"("input":6,"output":3)",
     "animations[0].channels[0]: 3 values for 2 times"},
    {R"("name":"lower")",
     R"("name":1e999)",
     "is not glTF, as it is not JSON: Problem while parsing a number"},
    {R"("scene":0)", R"("scene":0,"scene":0)", "is not glTF, as it has a key twice in one object"},
    {R"("scene":0)",
     R"("scene":0,"x":[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[)"
     R"(]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]])",
     "is not glTF, as it has JSON that is nested deeper than 64 levels"},
};

TEST(GltfReader, says_where_a_fault_is_in_one_line) {
    const std::string good = tiny_gltf();
    for (const Fault& fault : kFaults) {
        SCOPED_TRACE(std::string(fault.from) + " -> " + std::string(fault.to));
        const std::string bad = replaced(good, fault.from, fault.to);
        ASSERT_NE(bad, good);
        const auto model = read_text(bad);
        ASSERT_FALSE(model);
        EXPECT_EQ(model.error().message, fault.line);
    }
}

/// A change that is mended, and a part of what is said of it.
struct Mended {
    std::string_view from;
    std::string_view to;
    std::string_view warning;
};

constexpr Mended kMended[] = {
    {R"("translation":[0,1,0])",
     R"("rotation":[0,0,0,2])",
     "nodes[2].rotation: has a rotation that"},
    {R"("translation":[0,1,0])", R"("scale":[1,0,1])", "nodes[2]: has a scale of 0"},
    {R"("name":"upper")", R"("name":"lower")", "several nodes have one name, such as \"lower\""},
    {R"("mode":4)", R"("mode":1)", "holds points or lines, not triangles; left out"},
    {R"("max":[1,2,0])", R"("max":[1,5,0])", "accessors[0]: its min and max differ"},
    {R"("path":"rotation")", R"("path":"colour")", "\"colour\" is left out"},
    {R"("weights":[0.25])", R"("weights":[1,2])", "meshes[0]: has 2 weights for 1 morph targets"},
    {R"("scenes":[{"nodes":[0,1]}],)", "", "has no scene"},
    {R"("alphaMode")", R"("normalTexture":{"index":0,"texCoord":5},"alphaMode")", "texCoord 5"},
};

TEST(GltfReader, mends_what_can_be_mended_and_says_so) {
    std::string good = replaced(tiny_gltf(), R"("indices":1)", R"("mode":4,"indices":1)");
    good = replaced(good, R"("skins":)", R"("textures":[{}],"skins":)");
    for (const Mended& mended : kMended) {
        SCOPED_TRACE(mended.to);
        std::string odd = replaced(good, mended.from, mended.to);
        ASSERT_NE(odd, good);
        if (odd.find("\"scenes\"") == std::string::npos) {
            odd = replaced(odd, "\"scene\":0,", "");
        }
        const auto model = read_text(odd);
        ASSERT_TRUE(model) << model.error().message;
        std::string all;
        for (const std::string& warning : model->warnings) {
            all += warning + "\n";
        }
        EXPECT_NE(all.find(mended.warning), std::string::npos) << all;
    }
}

TEST(GltfReader, takes_strips_and_fans_apart) {
    // Eight bytes that were the times are the corners 0 1 2 1 0 0 0 0.
    std::string buffer = raks::test::tiny_buffer();
    buffer.replace(268, 8, std::string_view("\0\1\2\1\0\0\0\0", 8));
    std::string text = tiny_gltf(buffer);
    text.erase(text.find("\"animations\""),
               text.find("\"accessors\"") - text.find("\"animations\""));
    text = replaced(text,
                    R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"})",
                    R"({"bufferView":6,"componentType":5121,"count":4,"type":"SCALAR"})");
    const auto corners = [&](std::string_view mode) {
        const auto model = read_text(replaced(text, "\"indices\":1", mode));
        return model ? model->meshes[0].primitives[0].indices : std::vector<std::uint32_t>{};
    };
    EXPECT_EQ(corners("\"mode\":5,\"indices\":1"), (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 1}));
    EXPECT_EQ(corners("\"mode\":6,\"indices\":1"), (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 1}));
}

TEST(GltfReader, survives_a_model_cut_at_every_byte) {
    for (const std::string& file : {raks::test::tiny_glb(), tiny_gltf()}) {
        for (std::size_t size = 0; size < file.size(); ++size) {
            const auto model = read_text(file.substr(0, size), "x.glb");
            ASSERT_FALSE(model) << size << " bytes";
            ASSERT_EQ(model.error().message.find('\n'), std::string::npos);
        }
    }
}

TEST(GltfReader, survives_damaged_bytes) {
    const std::string good = raks::test::tiny_glb();
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        const auto model =
            read_text(raks::test::mangled(good, {.seed = seed, .bytes = 1 + seed % 5}), "x.glb");
        if (model) {
            (void)survey(*model);
        } else {
            ASSERT_FALSE(model.error().message.empty());
            ASSERT_EQ(model.error().message.find('\n'), std::string::npos);
        }
    }
}

}  // namespace
