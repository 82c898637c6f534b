// Meshes that Draco packed: they come out as they were put in, and what is damaged is told.
#include "engine/import/draco_unpacker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/gltf/glb_document.hpp"
#include "base/pending_file.hpp"
#include "render/import/model_reader.hpp"
#include "tests/fuzz/mutation.hpp"
#include "tests/support/temporary_folder.hpp"

#include <draco/compression/encode.h>
#include <glm/geometric.hpp>

namespace raks::engine {
namespace {

constexpr std::uint32_t kSide = 8;  // points along a side
constexpr std::uint32_t kPoints = kSide * kSide;

/// A sheet of points with waves.
glm::vec3 place(std::uint32_t point) {
    const auto x = static_cast<float>(point % kSide);
    const auto y = static_cast<float>(point / kSide);
    return {0.25F * x, 0.5F * y, 0.125F * x * y};
}

std::vector<std::uint32_t> corners() {
    std::vector<std::uint32_t> all;
    for (std::uint32_t y = 0; y + 1 < kSide; ++y) {
        for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
            const std::uint32_t a = y * kSide + x;
            const std::uint32_t b = a + kSide;
            all.insert(all.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    }
    return all;
}

int add_attribute(draco::Mesh& mesh,
                  draco::GeometryAttribute::Type type,
                  draco::DataType data,
                  bool is_whole) {
    draco::GeometryAttribute attribute;
    const std::uint8_t width = is_whole ? 4 : 3;
    attribute.Init(type, nullptr, width, data, false, width * (is_whole ? 2 : 4), 0);
    return mesh.AddAttribute(attribute, true, kPoints);
}

/// The sheet without any loss: places, and four joints for each point.
std::string packed() {
    draco::Mesh mesh;
    mesh.set_num_points(kPoints);
    const int places =
        add_attribute(mesh, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, false);
    const int joints =
        add_attribute(mesh, draco::GeometryAttribute::GENERIC, draco::DT_UINT16, true);
    for (std::uint32_t p = 0; p < kPoints; ++p) {
        const glm::vec3 at = place(p);
        const std::array<std::uint16_t, 4> four = {static_cast<std::uint16_t>(p), 1, 2, 300};
        mesh.attribute(places)->SetAttributeValue(draco::AttributeValueIndex(p), &at.x);
        mesh.attribute(joints)->SetAttributeValue(draco::AttributeValueIndex(p), four.data());
    }
    const std::vector<std::uint32_t> all = corners();
    for (std::size_t i = 0; i < all.size(); i += 3) {
        mesh.AddFace({draco::PointIndex(all[i]),
                      draco::PointIndex(all[i + 1]),
                      draco::PointIndex(all[i + 2])});
    }
    draco::Encoder encoder;
    encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
    return {buffer.data(), buffer.size()};
}

/// The sheet as a GLB that says nothing of it but how it is packed.
std::string packed_glb(const std::string& mesh) {
    GlbDocument glb;
    GlbDocument::Json& json = glb.json();
    const std::size_t view = glb.add_view(std::as_bytes(std::span(mesh.data(), mesh.size())));
    json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    glb.use_extension("KHR_draco_mesh_compression");
    json["accessors"] = {
        {{"componentType", 5126},
         {"type", "VEC3"},
         {"count", kPoints},
         {"min", {0.0, 0.0, 0.0}},
         {"max", {1.75, 3.5, 6.125}}},
        {{"componentType", 5123}, {"type", "SCALAR"}, {"count", corners().size()}}};
    json["meshes"] = {{{"primitives",
                        {{{"attributes", {{"POSITION", 0}}},
                          {"indices", 1},
                          {"extensions",
                           {{"KHR_draco_mesh_compression",
                             {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}}}}}}}}}};
    json["nodes"] = {{{"mesh", 0}}};
    json["scenes"] = {{{"nodes", {0}}}};
    json["scene"] = 0;
    return *glb.bytes();
}

/// The places of each triangle's corners, whatever their order in the file; each begins with its
/// least corner.
using Triangles = std::multiset<std::vector<std::tuple<float, float, float>>>;

Triangles triangles_of(const std::vector<glm::vec3>& places,
                       const std::vector<std::uint32_t>& indices) {
    Triangles all;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        std::vector<std::tuple<float, float, float>> triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3& p = places.at(indices[i + k]);
            triangle.emplace_back(p.x, p.y, p.z);
        }
        std::rotate(
            triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
        all.insert(triangle);
    }
    return all;
}

Triangles sheet() {
    std::vector<glm::vec3> places;
    for (std::uint32_t p = 0; p < kPoints; ++p) {
        places.push_back(place(p));
    }
    return triangles_of(places, corners());
}

ImportWays no_ways() {
    return {[](std::string_view) -> Expected<std::string> { return fail("no file"); },
            [](const std::string&) {}};
}

TEST(DracoUnpacker, a_mesh_comes_out_as_it_was_put_in) {
    const test::TemporaryFolder folder;
    const auto file = folder / "sheet.glb";
    ASSERT_TRUE(write_file(file, packed_glb(packed())));
    const auto model = render::load_model(file);
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_EQ(model->meshes.size(), 1U);
    const render::ModelPrimitive& part = model->meshes[0].primitives.at(0);
    EXPECT_EQ(part.positions.size(), kPoints);
    EXPECT_EQ(triangles_of(part.positions, part.indices), sheet());
}

TEST(DracoUnpacker, nothing_of_the_extension_is_left) {
    const auto unpacked = unpack_draco(packed_glb(packed()), no_ways());
    ASSERT_TRUE(unpacked) << unpacked.error().message;
    EXPECT_EQ(unpacked->find("KHR_draco_mesh_compression"), std::string::npos);
}

TEST(DracoUnpacker, what_is_no_packed_mesh_is_told) {
    const auto garbage = unpack_draco(packed_glb("no mesh at all"), no_ways());
    ASSERT_FALSE(garbage);
    EXPECT_EQ(garbage.error().message.find("Draco cannot unpack bufferViews[0]: "), 0U);
    const auto cut = unpack_draco(packed_glb(packed().substr(0, 40)), no_ways());
    ASSERT_FALSE(cut);
    EXPECT_EQ(unpack_draco("{}", no_ways()).error().message,
              "is not glTF that Draco has packed: a part of it is missing or damaged");
}

// RAKS_MODEL_MUTANTS=2000 tries that many; each in the child, which may end, but not Raks.
TEST(DracoUnpacker, damaged_meshes_are_read_or_refused_in_one_line) {
    const char* const more = std::getenv("RAKS_MODEL_MUTANTS");
    const int mutants = more == nullptr ? 30 : std::atoi(more);
    const test::TemporaryFolder folder;
    const std::string good = packed();
    for (int seed = 0; seed < mutants; ++seed) {
        const auto file = folder / "damaged.glb";
        ASSERT_TRUE(write_file(
            file, packed_glb(fuzz::mutated_bytes(good, static_cast<std::uint64_t>(seed)))));
        const auto model = render::load_model(file);
        const std::string message = model ? std::string() : model.error().message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << seed;
        EXPECT_EQ(message.find("took more than"), std::string::npos) << seed;
    }
}

}  // namespace
}  // namespace raks::engine
