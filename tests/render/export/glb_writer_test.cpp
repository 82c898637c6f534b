// A model that is written is read back as it was.
#include "render/export/glb_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "render/import/gltf_reader.hpp"

namespace raks::render {
namespace {

// The smallest PNG: one pixel.
const std::vector<unsigned char> kPng = {
    0x89, 'P',  'N',  'G',  0x0D, 0x0A, 0x1A, 0x0A, 0,    0,   0,    0x0D, 'I',  'H',
    'D',  'R',  0,    0,    0,    1,    0,    0,    0,    1,   8,    6,    0,    0,
    0,    0x1F, 0x15, 0xC4, 0x89, 0,    0,    0,    0x0D, 'I', 'D',  'A',  'T',  0x78,
    0x9C, 0x63, 0xF8, 0xCF, 0xC0, 0xF0, 0x1F, 0,    5,    0,   1,    0xFF, 0x89, 0x99,
    0x3D, 0x1D, 0,    0,    0,    0,    'I',  'E',  'N',  'D', 0xAE, 0x42, 0x60, 0x82};

/// A triangle with all that a primitive can have.
ModelPrimitive triangle() {
    ModelPrimitive primitive;
    primitive.material = 0;
    primitive.positions = {{0.0F, 0.1F, 0.0F}, {1.0F, 0.0F, 0.3F}, {0.0F, 2.0F, 0.0F}};
    primitive.normals = {{0.0F, 0.0F, 1.0F}, {0.0F, 1.0F, 0.0F}, {0.6F, 0.0F, 0.8F}};
    primitive.uv[0] = {{0.1F, 0.2F}, {0.7F, 0.3F}, {1.0F, 0.0F}};
    primitive.uv[1] = {{0.0F, 0.0F}, {0.5F, 0.5F}, {0.25F, 0.75F}};
    primitive.colours = {{1.0F, 0.5F, 0.25F, 1.0F}, {0.0F, 0.1F, 0.2F, 1.0F}, glm::vec4(1.0F)};
    primitive.joints = {{0, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}};
    primitive.weights = {{1.0F, 0.0F, 0.0F, 0.0F}, {0.7F, 0.3F, 0.0F, 0.0F}, {1.0F, 0, 0, 0}};
    primitive.indices = {0, 1, 2};
    MorphTarget smile;
    smile.vertices = {1};
    smile.positions = {{0.0F, 0.25F, -0.5F}};
    smile.normals = {{0.1F, 0.0F, 0.0F}};
    primitive.morphs = {smile};
    return primitive;
}

ModelMaterial glass() {
    ModelMaterial material;
    material.name = "glass";
    material.base_colour = {0.2F, 0.4F, 0.6F, 0.5F};
    material.base_texture = {.texture = 0, .uv_set = 1, .offset = {0.1F, 0.2F}, .scale = {2, 3}};
    material.metallic = 0.25F;
    material.roughness = 0.75F;
    material.emissive = {4.0F, 2.0F, 0.0F};
    material.alpha_mode = AlphaMode::blend;
    material.is_double_sided = true;
    return material;
}

AnimationChannel channel(ChannelPath path, std::vector<float> values) {
    return {
        .node = path == ChannelPath::weights ? 0 : 2,
        .path = path,
        .interpolation = path == ChannelPath::scale ? Interpolation::step : Interpolation::linear,
        .times = {0.0F, 0.5F},
        .values = std::move(values)};
}

/// A skinned triangle below a root, with a clip, an image and a morph target.
Model figure() {
    Model model;
    model.nodes.resize(3);
    model.nodes[0].name = "body";
    model.nodes[0].mesh = 0;
    model.nodes[0].skin = 0;
    model.nodes[1].name = "hips \"\xC3\xA9\"";
    model.nodes[1].children = {2};
    model.nodes[1].translation = {0.0F, 1.0F, 0.0F};
    model.nodes[2].parent = 1;
    model.nodes[2].rotation = glm::quat(std::sqrt(0.5F), 0.0F, std::sqrt(0.5F), 0.0F);
    model.nodes[2].scale = {1.0F, 2.0F, 0.5F};
    model.roots = {0, 1};
    model.meshes.push_back({"skin", {triangle()}, {"smile"}, {0.5F}});
    glm::mat4 bind(1.0F);
    bind[3] = {0.0F, -1.0F, 0.5F, 1.0F};
    model.skins.push_back({{1, 2}, {glm::mat4(1.0F), bind}});
    model.materials = {glass()};
    const auto* const bytes = reinterpret_cast<const std::byte*>(kPng.data());
    model.images.push_back({"dot", {bytes, bytes + kPng.size()}, 1, 1, 0});
    model.textures.push_back({0, TextureWrap::clamp, TextureWrap::mirror, false, true});
    model.animations.push_back({"nod",
                                {channel(ChannelPath::translation, {0, 0, 0, 0.1F, 0.2F, 0.3F}),
                                 channel(ChannelPath::rotation, {0, 0, 0, 1, 0, 1, 0, 0}),
                                 channel(ChannelPath::scale, {1, 1, 1, 1, 2, 1}),
                                 channel(ChannelPath::weights, {0.0F, 1.0F})}});
    return model;
}

Expected<Model> read_back(const std::string& bytes) {
    return read_gltf(std::as_bytes(std::span(bytes.data(), bytes.size())), SideFiles());
}

template <typename Vector>
void expect_near(const std::vector<Vector>& found, const std::vector<Vector>& wanted) {
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_LT(glm::length(found[i] - wanted[i]), 1e-6F) << i;
    }
}

TEST(GlbWriter, meshes_are_read_back_within_a_micrometre) {
    const Model model = figure();
    const auto bytes = glb_bytes(model);
    ASSERT_TRUE(bytes);
    const auto read = read_back(*bytes);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(read->warnings.empty()) << read->warnings.front();
    const ModelPrimitive& found = read->meshes.at(0).primitives.at(0);
    const ModelPrimitive& wanted = model.meshes[0].primitives[0];
    expect_near(found.positions, wanted.positions);
    expect_near(found.normals, wanted.normals);
    expect_near(found.uv[0], wanted.uv[0]);
    expect_near(found.uv[1], wanted.uv[1]);
    expect_near(found.colours, wanted.colours);
    EXPECT_EQ(found.joints, wanted.joints);
    EXPECT_EQ(found.weights, wanted.weights);
    EXPECT_EQ(found.indices, wanted.indices);
    ASSERT_EQ(found.morphs.size(), 1U);
    EXPECT_EQ(found.morphs[0].vertices, wanted.morphs[0].vertices);
    expect_near(found.morphs[0].positions, wanted.morphs[0].positions);
    expect_near(found.morphs[0].normals, wanted.morphs[0].normals);
    EXPECT_EQ(read->meshes[0].morph_names, model.meshes[0].morph_names);
    EXPECT_EQ(read->meshes[0].morph_weights, model.meshes[0].morph_weights);
}

TEST(GlbWriter, nodes_skins_and_clips_are_read_back) {
    const Model model = figure();
    const auto read = read_back(*glb_bytes(model));
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->nodes.size(), model.nodes.size());
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        EXPECT_EQ(read->nodes[i].name, model.nodes[i].name);
        EXPECT_EQ(read->nodes[i].parent, model.nodes[i].parent);
        EXPECT_EQ(read->nodes[i].translation, model.nodes[i].translation);
        EXPECT_GT(glm::dot(read->nodes[i].rotation, model.nodes[i].rotation), 1.0F - 1e-6F);
        EXPECT_EQ(read->nodes[i].scale, model.nodes[i].scale);
        EXPECT_EQ(read->nodes[i].mesh, model.nodes[i].mesh);
        EXPECT_EQ(read->nodes[i].skin, model.nodes[i].skin);
    }
    EXPECT_EQ(read->roots, model.roots);
    ASSERT_EQ(read->skins.size(), 1U);
    EXPECT_EQ(read->skins[0].joints, model.skins[0].joints);
    EXPECT_EQ(read->skins[0].inverse_bind, model.skins[0].inverse_bind);
    ASSERT_EQ(read->animations.size(), 1U);
    EXPECT_EQ(read->animations[0].name, "nod");
    ASSERT_EQ(read->animations[0].channels.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        const AnimationChannel& found = read->animations[0].channels[i];
        const AnimationChannel& wanted = model.animations[0].channels[i];
        EXPECT_EQ(found.node, wanted.node);
        EXPECT_EQ(found.path, wanted.path);
        EXPECT_EQ(found.interpolation, wanted.interpolation);
        EXPECT_EQ(found.times, wanted.times);
        EXPECT_EQ(found.values, wanted.values);
    }
}

TEST(GlbWriter, materials_and_images_are_read_back) {
    const Model model = figure();
    const auto read = read_back(*glb_bytes(model));
    ASSERT_TRUE(read) << read.error().message;
    const ModelMaterial& found = read->materials.at(0);
    const ModelMaterial& wanted = model.materials[0];
    EXPECT_EQ(found.name, wanted.name);
    EXPECT_EQ(found.base_colour, wanted.base_colour);
    EXPECT_EQ(found.base_texture.texture, 0);
    EXPECT_EQ(found.base_texture.uv_set, 1);
    EXPECT_EQ(found.base_texture.offset, wanted.base_texture.offset);
    EXPECT_EQ(found.base_texture.scale, wanted.base_texture.scale);
    EXPECT_EQ(found.metallic, wanted.metallic);
    EXPECT_EQ(found.roughness, wanted.roughness);
    EXPECT_LT(glm::length(found.emissive - wanted.emissive), 1e-6F);
    EXPECT_EQ(found.alpha_mode, wanted.alpha_mode);
    EXPECT_TRUE(found.is_double_sided);
    EXPECT_EQ(read->images.at(0).packed, model.images[0].packed);
    EXPECT_EQ(read->textures.at(0).wrap_u, TextureWrap::clamp);
    EXPECT_EQ(read->textures.at(0).wrap_v, TextureWrap::mirror);
    EXPECT_FALSE(read->textures.at(0).is_smooth);
    EXPECT_TRUE(read->textures.at(0).has_mipmaps);
}

TEST(GlbWriter, the_same_model_gives_the_same_bytes_also_when_it_was_read) {
    const auto bytes = glb_bytes(figure());
    ASSERT_TRUE(bytes);
    EXPECT_TRUE(*bytes == *glb_bytes(figure()));
    // Once read, rotations have the length that the reader gives them.
    const auto read = glb_bytes(*read_back(*bytes));
    EXPECT_TRUE(*read == *glb_bytes(*read_back(*read)));
}

TEST(GlbWriter, an_image_that_could_not_be_read_leaves_a_texture_without) {
    Model model = figure();
    model.images[0].packed.clear();
    const auto read = read_back(*glb_bytes(model));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(read->images.empty());
    EXPECT_EQ(read->textures.at(0).image, -1);
}

}  // namespace
}  // namespace raks::render
