// 3DS files: trees, pivots, names, tracks, surfaces, and what is wrong with them.
#include "render/import/tds_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/random.hpp"
#include "render/model/animation_channel.hpp"
#include "render/model/model_survey.hpp"
#include "tests/render/import/tiny_tds.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace {

using namespace raks;
using namespace raks::render;
namespace tds = raks::test::tds;

const glm::vec3 kHalf(0.5F, 0.5F, 0.5F);

/// A box of side 1 about a place, whose axes begin there.
std::string part(const std::string& name, const glm::vec3& place) {
    return tds::object(tds::box(name, place, kHalf, place));
}

/// Torso with head and arms, a hand on one of them.
std::string parts_of_torso() {
    return part("Torso", {0, 0, 0}) + part("Head", {0, 0, 2}) + part("ArmL", {2, 0, 0}) +
           part("ArmR", {-2, 0, 0}) + part("HandL", {4, 0, 0});
}

const std::vector<tds::Node> kTorso = {
    {.name = "Torso", .id = 0},
    {.name = "Head", .id = 1, .parent = 0, .place = {0, 0, 2}},
    {.name = "ArmL", .id = 2, .parent = 0, .place = {2, 0, 0}},
    {.name = "ArmR", .id = 3, .parent = 0, .place = {-2, 0, 0}},
    {.name = "HandL", .id = 4, .parent = 2, .place = {2, 0, 0}},
};

std::string nodes(const std::vector<tds::Node>& list) {
    std::string bytes;
    for (const tds::Node& node : list) {
        bytes += tds::node(node);
    }
    return bytes;
}

Model read_good(const std::string& bytes) {
    auto model = tds::read(bytes);
    EXPECT_TRUE(model) << (model ? "" : model.error().message);
    return model ? std::move(*model) : Model();
}

int index_of(const Model& model, std::string_view name) {
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (model.nodes[i].name == name) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

std::string parent_name(const Model& model, std::string_view name) {
    const int node = index_of(model, name);
    const int parent = node < 0 ? -1 : model.nodes[static_cast<std::size_t>(node)].parent;
    return parent < 0 ? "" : model.nodes[static_cast<std::size_t>(parent)].name;
}

bool warns(const Model& model, std::string_view words) {
    return std::any_of(model.warnings.begin(), model.warnings.end(), [&](const std::string& line) {
        return line.find(words) != std::string::npos;
    });
}

std::string fault(const std::string& bytes) {
    const auto model = tds::read(bytes);
    return model ? "" : model.error().message;
}

void expect_torso(const Model& model) {
    ASSERT_EQ(model.nodes.size(), 5U);
    EXPECT_EQ(parent_name(model, "Torso"), "");
    EXPECT_EQ(parent_name(model, "Head"), "Torso");
    EXPECT_EQ(parent_name(model, "ArmL"), "Torso");
    EXPECT_EQ(parent_name(model, "ArmR"), "Torso");
    EXPECT_EQ(parent_name(model, "HandL"), "ArmL");
}

// ---- Trees

TEST(TdsTree, branches_as_the_ids_say) {
    const Model model = read_good(tds::file(parts_of_torso(), nodes(kTorso)));
    expect_torso(model);
    EXPECT_EQ(model.roots, std::vector<int>{0});
    EXPECT_TRUE(model.warnings.empty());
    // y up, each part where it was modelled.
    const auto world = rest_world(model);
    EXPECT_EQ(glm::vec3(world[1][3]), glm::vec3(0, 2, 0));
    EXPECT_EQ(glm::vec3(world[4][3]), glm::vec3(4, 0, 0));
    const auto box = rest_box(model);
    ASSERT_TRUE(box);
    EXPECT_EQ(box->low, glm::vec3(-2.5F, -0.5F, -0.5F));
    EXPECT_EQ(box->high, glm::vec3(4.5F, 2.5F, 0.5F));
}

TEST(TdsTree, is_the_same_with_parents_behind_their_children) {
    std::vector<tds::Node> list = kTorso;
    std::reverse(list.begin(), list.end());
    expect_torso(read_good(tds::file(parts_of_torso(), nodes(list))));
}

TEST(TdsTree, is_the_same_without_ids) {
    std::vector<tds::Node> list = kTorso;
    for (tds::Node& node : list) {
        node.id = -1;
    }
    expect_torso(read_good(tds::file(parts_of_torso(), nodes(list))));
}

TEST(TdsTree, without_a_keyframer_is_flat_and_stands_as_modelled) {
    const Model model = read_good(tds::file(parts_of_torso()));
    ASSERT_EQ(model.nodes.size(), 5U);
    EXPECT_EQ(model.roots.size(), 5U);
    EXPECT_EQ(model.nodes[1].translation, glm::vec3(0, 2, 0));
    EXPECT_EQ(rest_box(model)->high, glm::vec3(4.5F, 2.5F, 0.5F));
}

TEST(TdsTree, tells_dummies_apart_by_their_instance_names) {
    std::vector<tds::Node> list = {
        {.name = "$$$DUMMY", .id = 0, .instance = "root"},
        {.name = "Torso", .id = 1, .parent = 0},
        {.name = "$$$DUMMY", .id = 2, .parent = 1, .place = {0, 0, 1}, .instance = "neck"},
        {.name = "Head", .id = 3, .parent = 2, .place = {0, 0, 1}},
    };
    const Model model =
        read_good(tds::file(part("Torso", {0, 0, 0}) + part("Head", {0, 0, 2}), nodes(list)));
    EXPECT_EQ(parent_name(model, "Head"), "neck");
    EXPECT_EQ(parent_name(model, "Torso"), "root");
    EXPECT_EQ(model.nodes[0].mesh, -1);
    EXPECT_TRUE(model.warnings.empty());
}

TEST(TdsTree, shows_one_mesh_in_each_of_its_instances) {
    const Model model = read_good(
        tds::file(part("A", {0, 0, 0}),
                  nodes({{.name = "A", .id = 0, .place = {1, 0, 0}, .instance = "one"},
                         {.name = "A", .id = 1, .place = {9, 0, 0}, .instance = "two"}})));
    ASSERT_EQ(model.nodes.size(), 2U);
    EXPECT_EQ(model.nodes[0].name, "A.one");
    EXPECT_EQ(model.nodes[1].name, "A.two");
    EXPECT_EQ(model.meshes.size(), 1U);
    EXPECT_EQ(rest_box(model)->high.x, 9.5F);
}

TEST(TdsTree, gives_equal_names_numbers_and_says_so) {
    const Model model =
        read_good(tds::file(part("Finger", {0, 0, 0}) + part("Finger", {2, 0, 0}),
                            nodes({{.name = "Finger", .id = 0},
                                   {.name = "Finger", .id = 1, .parent = 0, .place = {2, 0, 0}}})));
    ASSERT_EQ(model.nodes.size(), 2U);
    EXPECT_EQ(parent_name(model, "Finger.001"), "Finger");
    // Each node shows an object of its own.
    EXPECT_EQ(rest_box(model)->high.x, 2.5F);
    EXPECT_TRUE(warns(model, "another node is named \"Finger\", too: this one is \"Finger.001\""));
}

TEST(TdsTree, of_cycles_and_missing_parents_becomes_a_forest_with_a_word) {
    std::vector<tds::Node> list = kTorso;
    list[0].parent = 4;
    const Model cycle = read_good(tds::file(parts_of_torso(), nodes(list)));
    EXPECT_EQ(cycle.roots.size(), 1U);
    EXPECT_TRUE(warns(cycle, "hangs on its own child"));
    list[0].parent = 0;
    EXPECT_TRUE(warns(read_good(tds::file(parts_of_torso(), nodes(list))), "its own child"));
    list[0].parent = 77;
    EXPECT_TRUE(warns(read_good(tds::file(parts_of_torso(), nodes(list))),
                      "\"Torso\": its parent 77 is not there"));
    list = kTorso;
    list[1].id = 0;
    EXPECT_TRUE(warns(read_good(tds::file(parts_of_torso(), nodes(list))), "have the id 0"));
}

TEST(TdsTree, deeper_than_a_thousand_is_refused) {
    std::vector<tds::Node> list;
    for (int i = 0; i < 1'002; ++i) {
        list.push_back({.name = "$$$DUMMY", .id = i, .parent = i - 1, .instance = "d"});
    }
    EXPECT_EQ(fault(tds::file(part("A", {0, 0, 0}), nodes(list))),
              "has more than 1000 nodes below one another");
}

// ---- Where parts stand

TEST(TdsPart, turns_about_its_pivot) {
    // A beam along x whose own axes begin in its middle, and that turns about its left end: a
    // quarter turn, clockwise about z, sends it to -y, which is +z with y up.
    const tds::Node beam = {.name = "Beam",
                            .id = 0,
                            .place = {-2, 0, 0},
                            .pivot = {-2, 0, 0},
                            .turns = {{0, {glm::half_pi<float>(), 0, 0, 1}}}};
    const Model model = read_good(tds::file(
        tds::object(tds::box("Beam", {0, 0, 0}, {2, 0.1F, 0.1F}, {0, 0, 0})), tds::node(beam)));
    const auto box = rest_box(model);
    ASSERT_TRUE(box);
    EXPECT_NEAR(box->low.x, -2.1F, 1e-5F);
    EXPECT_NEAR(box->high.x, -1.9F, 1e-5F);
    EXPECT_NEAR(box->low.z, 0.0F, 1e-5F);
    EXPECT_NEAR(box->high.z, 4.0F, 1e-5F);
}

TEST(TdsPart, whose_axes_are_turned_stands_as_it_was_modelled) {
    // The axes of the object and the keyframer's turn are one rotation, so they cancel.
    const CounterRandom random(5);
    for (std::uint64_t i = 0; i < 20; ++i) {
        const auto draw = [&](std::uint64_t k) {
            return static_cast<float>(random.below(10 * i + k, 2'001)) / 1'000.0F - 1.0F;
        };
        const glm::vec3 axis = glm::normalize(glm::vec3(draw(0), draw(1), draw(2) + 1.5F));
        const float angle = 3.0F * draw(3);
        const glm::vec3 origin(draw(4), draw(5), draw(6));
        tds::Mesh mesh = tds::box("A", {1, 2, 3}, {0.5F, 0.4F, 0.3F}, origin);
        const glm::quat turn = glm::angleAxis(-angle, axis);
        for (int column = 0; column < 3; ++column) {
            glm::vec3 unit(0.0F);
            unit[column] = 1.0F;
            mesh.axes[static_cast<std::size_t>(column)] = turn * unit;
        }
        const Model model =
            read_good(tds::file(tds::object(mesh),
                                tds::node({.name = "A",
                                           .id = 0,
                                           .place = origin,
                                           .turns = {{0, {angle, axis.x, axis.y, axis.z}}}})));
        const auto box = rest_box(model);
        ASSERT_TRUE(box);
        EXPECT_LT(glm::distance(box->low, glm::vec3(0.5F, 2.7F, -2.4F)), 1e-5F);
        EXPECT_LT(glm::distance(box->high, glm::vec3(1.5F, 3.3F, -1.6F)), 1e-5F);
    }
}

TEST(TdsPart, with_flat_axes_stays_where_its_vertices_are) {
    tds::Mesh mesh = tds::box("A", {0, 0, 0}, kHalf, {0, 0, 0});
    mesh.axes[2] = mesh.axes[1];
    const Model model = read_good(tds::file(tds::object(mesh), nodes({{.name = "A", .id = 0}})));
    EXPECT_TRUE(warns(model, "has axes that cannot be inverted"));
    EXPECT_EQ(rest_box(model)->high, glm::vec3(0.5F));
}

// ---- Tracks

const AnimationChannel& only_channel(const Model& model) {
    EXPECT_EQ(model.animations.size(), 1U);
    EXPECT_EQ(model.animations[0].channels.size(), 1U);
    return model.animations[0].channels[0];
}

TEST(TdsTrack, of_turns_adds_each_to_those_before_and_keeps_whole_rounds) {
    // Half a turn about z, then a whole one about x, in the parent's axes; 30 frames a second.
    const float half = glm::pi<float>();
    const Model model = read_good(tds::file(
        part("A", {0, 0, 0}),
        nodes({{.name = "A",
                .id = 0,
                .turns = {{0, {0, 0, 0, 1}}, {30, {half, 0, 0, 1}}, {60, {2 * half, 1, 0, 0}}}}})));
    const AnimationChannel& channel = only_channel(model);
    const auto z_of = [&channel](float seconds) {  // where the part's z axis of the file points
        const glm::vec4 q = sample_channel(channel, seconds);
        return glm::quat(q.w, q.x, q.y, q.z) * glm::vec3(0, 1, 0);
    };
    const auto x_of = [&channel](float seconds) {
        const glm::vec4 q = sample_channel(channel, seconds);
        return glm::quat(q.w, q.x, q.y, q.z) * glm::vec3(1, 0, 0);
    };
    // Clockwise about z from above: +x goes by -y of the file, which is +z here.
    EXPECT_LT(glm::distance(x_of(0.5F), glm::vec3(0, 0, 1)), 1e-5F);
    EXPECT_LT(glm::distance(x_of(1.0F), glm::vec3(-1, 0, 0)), 1e-5F);
    EXPECT_LT(glm::distance(z_of(1.5F), glm::vec3(0, -1, 0)), 1e-5F);
    EXPECT_LT(glm::distance(z_of(2.0F), glm::vec3(0, 1, 0)), 1e-5F);
    EXPECT_LT(glm::distance(x_of(2.0F), glm::vec3(-1, 0, 0)), 1e-5F);
}

TEST(TdsTrack, of_places_goes_straight_where_its_keys_do_and_through_them_all) {
    const Model straight = read_good(
        tds::file(part("A", {0, 0, 0}),
                  nodes({{.name = "A",
                          .id = 0,
                          .places = {{0, {0, 0, 0}}, {10, {1, 0, 3}}, {30, {3, 0, 9}}}}})));
    const AnimationChannel& line = only_channel(straight);
    for (const float seconds : {0.0F, 0.2F, 0.5F, 0.9F, 1.0F}) {
        const glm::vec3 place(sample_channel(line, seconds));
        EXPECT_LT(glm::distance(place, seconds * glm::vec3(3, 9, 0)), 1e-5F) << seconds;
    }
    const Model bent = read_good(
        tds::file(part("A", {0, 0, 0}),
                  nodes({{.name = "A",
                          .id = 0,
                          .places = {{0, {0, 0, 0}}, {15, {1, 0, 0}}, {30, {0, 0, 0}}}}})));
    const AnimationChannel& curve = only_channel(bent);
    EXPECT_NEAR(sample_channel(curve, 0.5F).x, 1.0F, 1e-6F);
    EXPECT_NEAR(sample_channel(curve, 1.0F).x, 0.0F, 1e-6F);
    // Level at the top, without a bend at the ends: x = (3 u - u^3) / 2, u = 0..1 up and down.
    EXPECT_NEAR(sample_channel(curve, 0.25F).x, 0.6875F, 1e-5F);
    EXPECT_NEAR(sample_channel(curve, 0.9F).x, 0.296F, 1e-5F);
}

TEST(TdsTrack, whose_frames_fall_keeps_its_first_key) {
    const Model model = read_good(
        tds::file(part("A", {0, 0, 0}),
                  nodes({{.name = "A", .id = 0, .places = {{9, {1, 0, 0}}, {3, {2, 0, 0}}}}})));
    EXPECT_TRUE(model.animations.empty());
    EXPECT_EQ(model.nodes[0].translation.x, 1.0F);
    EXPECT_TRUE(warns(model, "its keyframes do not follow one another"));
}

// ---- Surfaces

/// Two squares that meet in an edge at a right angle.
tds::Mesh fold(std::uint32_t one, std::uint32_t other) {
    tds::Mesh mesh{
        .name = "Fold",
        .positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 1, -1}},
        .triangles = {{0, 1, 2}, {0, 2, 3}, {4, 0, 3}, {4, 3, 5}}};
    mesh.smoothing = {one, one, other, other};
    return mesh;
}

/// Normals at the fold's edge, of the first square; of the file's axes.
glm::vec3 normal_at_fold(const tds::Mesh& mesh) {
    const Model model = read_good(tds::file(tds::object(mesh)));
    const ModelPrimitive& primitive = model.meshes[0].primitives[0];
    const glm::vec3 normal = primitive.normals[primitive.indices[0]];
    return {normal.x, -normal.z, normal.y};
}

TEST(TdsSmoothing, of_a_common_group_rounds_an_edge) {
    const glm::vec3 round = glm::normalize(glm::vec3(-1, 0, 1));
    EXPECT_LT(glm::distance(normal_at_fold(fold(1, 1)), round), 1e-5F);
    EXPECT_LT(glm::distance(normal_at_fold(fold(1, 3)), round), 1e-5F);
    const glm::vec3 sharp(0, 0, 1);
    EXPECT_LT(glm::distance(normal_at_fold(fold(1, 2)), sharp), 1e-5F);
    EXPECT_LT(glm::distance(normal_at_fold(fold(0, 0)), sharp), 1e-5F);
}

TEST(TdsSmoothing, goes_over_seams_of_the_texture) {
    tds::Mesh mesh = fold(1, 1);
    mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {0, 1, 0}});
    mesh.triangles[2] = {4, 6, 7};
    mesh.triangles[3] = {4, 7, 5};
    EXPECT_LT(glm::distance(normal_at_fold(mesh), glm::normalize(glm::vec3(-1, 0, 1))), 1e-5F);
}

TEST(TdsSmoothing, shares_vertices_where_normals_are_the_same) {
    const Model smooth = read_good(tds::file(tds::object(fold(1, 1))));
    EXPECT_EQ(smooth.meshes[0].primitives[0].positions.size(), 6U);
    const Model sharp = read_good(tds::file(tds::object(fold(1, 2))));
    EXPECT_EQ(sharp.meshes[0].primitives[0].positions.size(), 8U);
    const Model flat = read_good(tds::file(tds::object(fold(0, 0))));
    EXPECT_EQ(flat.meshes[0].primitives[0].positions.size(), 12U);
}

std::string percent(int id, int share) {
    return tds::chunk(id, tds::chunk(0x0030, tds::count(static_cast<std::size_t>(share))));
}

TEST(TdsMaterial, has_colour_transparency_and_sides) {
    const std::string red =
        tds::material("Red",
                      tds::chunk(0xA020, tds::chunk(0x0011, std::string("\xFF\x00\x80", 3))) +
                          percent(0xA050, 25) + tds::chunk(0xA081, ""));
    tds::Mesh mesh = tds::box("A", {0, 0, 0}, kHalf, {0, 0, 0});
    mesh.material = "Red";
    const Model model = read_good(tds::file(red + tds::object(mesh)));
    ASSERT_EQ(model.materials.size(), 1U);
    const ModelMaterial& material = model.materials[0];
    EXPECT_EQ(material.name, "Red");
    EXPECT_NEAR(material.base_colour.r, 1.0F, 1e-6F);
    EXPECT_NEAR(material.base_colour.g, 0.0F, 1e-6F);
    EXPECT_NEAR(material.base_colour.b, 0.2159F, 1e-3F);  // sRGB 128
    EXPECT_NEAR(material.base_colour.a, 0.75F, 1e-6F);
    EXPECT_EQ(material.alpha_mode, AlphaMode::blend);
    EXPECT_TRUE(material.is_double_sided);
    EXPECT_EQ(material.metallic, 0.0F);
    EXPECT_EQ(model.meshes[0].primitives[0].material, 0);
}

TEST(TdsMaterial, finds_its_picture_beside_the_file) {
    const raks::test::TemporaryFolder folder;
    const std::string png = []() {
        std::ifstream file(
            std::string(RAKS_SOURCE_DIR) + "/tests/data/avatars/Textures/colormap.png",
            std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    }();
    std::ofstream(folder.path() / "skin.png", std::ios::binary) << png;
    const auto textured = [](const std::string& name) {
        tds::Mesh mesh = tds::box("A", {0, 0, 0}, kHalf, {0, 0, 0});
        mesh.material = "M";
        mesh.uv.assign(8, {0.25F, 0.75F});
        return tds::file(
            tds::material(
                "M",
                tds::chunk(0xA200, percent(0x0030, 100) + tds::chunk(0xA300, tds::text(name)))) +
            tds::object(mesh));
    };
    const SideFiles side(folder.path());
    for (const std::string name : {"skin.png", "SKIN.PNG", "C:\\MAPS\\Skin.png", "../x/skin.png"}) {
        const auto model = tds::read(textured(name), side);
        ASSERT_TRUE(model) << name;
        ASSERT_EQ(model->images.size(), 1U) << name;
        EXPECT_GT(model->images[0].width, 0);
        EXPECT_EQ(model->materials[0].base_texture.texture, 0);
        // Upwards in the file, downwards here.
        EXPECT_EQ(model->meshes[0].primitives[0].uv[0][0], glm::vec2(0.25F, 0.25F));
        EXPECT_EQ(model->materials[0].base_texture.offset, glm::vec2(0.0F));
    }
    for (const std::string name : {"none.png", "/etc/passwd", ".."}) {
        const auto model = tds::read(textured(name), side);
        ASSERT_TRUE(model) << name;
        EXPECT_EQ(model->materials[0].base_texture.texture, -1);
        EXPECT_TRUE(warns(*model, "texture left out")) << name;
    }
}

// ---- What is wrong

TEST(TdsFaults, are_said_with_chunk_and_place) {
    EXPECT_EQ(fault(""), "is not a 3DS file: it is empty");
    EXPECT_EQ(fault("MZ\x00\x00\x00\x00"), fault("MZ"));
    EXPECT_EQ(fault(tds::chunk(0x5A4D, "")), "is not a 3DS file: it begins with 5A4D, not 4D4D");
    EXPECT_EQ(fault(tds::chunk(0x4D4D, "")), "there is no mesh in it");
    const std::string good = tds::file(parts_of_torso(), nodes(kTorso));
    EXPECT_EQ(fault(good.substr(0, 200)),
              "chunk 4D4D at byte 0: says that it has " + std::to_string(good.size()) +
                  " bytes, but 200 are there");
    tds::Mesh mesh = tds::box("A", {0, 0, 0}, kHalf, {0, 0, 0});
    mesh.triangles[3][1] = 60'000;
    EXPECT_NE(fault(tds::file(tds::object(mesh)))
                  .find("vertex 60000 does not exist: there are 8, counted from 0"),
              std::string::npos);
    mesh = tds::box("A", {0, 0, 0}, kHalf, {0, 0, 0});
    mesh.positions[2].y = std::nanf("");
    EXPECT_NE(fault(tds::file(tds::object(mesh))).find("nan is not a number"), std::string::npos);
    const std::string no_end = tds::chunk(0x4000, "name");
    EXPECT_NE(fault(tds::file(no_end)).find("ends too soon"), std::string::npos);
    const std::string many = tds::chunk(0x4110, tds::count(65'535) + std::string(96, '\0'));
    EXPECT_NE(
        fault(tds::file(tds::chunk(0x4000, tds::text("A") + tds::chunk(0x4100, many))))
            .find("chunk 4110 at byte 36: says that it has 65535 entries, but there is room for 8"),
        std::string::npos);
}

TEST(TdsFaults, chunks_shorter_than_their_head_end_the_reading) {
    std::string bytes = tds::file(parts_of_torso());
    for (const char length : {'\0', '\5'}) {
        // The editor's length: behind the head and the version.
        std::string bad = bytes;
        bad.replace(18, 4, std::string{length, '\0', '\0', '\0'});
        EXPECT_NE(fault(bad).find("chunk 3D3D at byte 16: says that it has "), std::string::npos);
    }
}

TEST(TdsFaults, of_two_thousand_damaged_files_are_found_or_mended) {
    const std::string good = tds::figure();
    ASSERT_TRUE(tds::read(good));
    int refused = 0;
    for (std::uint64_t seed = 0; seed < 2'000; ++seed) {
        const auto model = tds::read(raks::test::mangled(
            good, {.seed = seed, .bytes = 1 + seed % 8, .reach = seed % 3 == 0 ? 400U : ~0U}));
        if (!model) {
            ++refused;
            EXPECT_EQ(model.error().message.find('\n'), std::string::npos);
            continue;
        }
        const auto box = rest_box(*model);
        EXPECT_TRUE(!box || std::isfinite(glm::length(box->high - box->low)));
    }
    EXPECT_GT(refused, 100);
    EXPECT_LT(refused, 1'900);
}

}  // namespace
