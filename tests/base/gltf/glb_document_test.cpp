// Binary glTF that is written: the container, its alignment, accessors.
#include "base/gltf/glb_document.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace raks {
namespace {

using Document = GlbDocument::Json;

std::uint32_t word_at(const std::string& file, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, file.data() + offset, sizeof(word));
    return word;
}

Document json_of(const std::string& file) {
    return Document::parse(file.substr(20, word_at(file, 12)));
}

TEST(GlbDocument, is_a_container_whose_lengths_fit) {
    GlbDocument document;
    const std::array<std::uint32_t, 3> triangle = {0, 1, 2};
    document.add_indices(triangle, 3);
    const std::array<float, 3> times = {0.0F, 0.1F, 2.0F};
    document.add_floats(times, GlbType::scalar, GlbUse::values, true);
    const auto file = document.bytes();
    ASSERT_TRUE(file);
    EXPECT_EQ(file->substr(0, 4), "glTF");
    EXPECT_EQ(word_at(*file, 8), file->size());
    const Document json = json_of(*file);
    EXPECT_EQ(json["accessors"][0]["componentType"], 5123);  // 16 bits are enough
    EXPECT_EQ(json["bufferViews"][1]["byteOffset"], 8);      // 6 bytes of corners, then floats
    EXPECT_EQ(json["accessors"][1]["max"], Document({2.0}));
    EXPECT_EQ(json["buffers"][0]["byteLength"], 20);
    EXPECT_EQ(word_at(*file, 20 + word_at(*file, 12)), 20U);
}

TEST(GlbDocument, without_bytes_has_no_buffer) {
    const auto file = GlbDocument().bytes();
    ASSERT_TRUE(file);
    EXPECT_EQ(file->size(), 20U + word_at(*file, 12));
    EXPECT_FALSE(json_of(*file).contains("buffers"));
}

TEST(GlbDocument, more_than_65535_vertices_take_corners_of_32_bits) {
    for (const auto& [vertices, component] : {std::pair{65535, 5123}, std::pair{65536, 5125}}) {
        GlbDocument document;
        const std::array<std::uint32_t, 3> triangle = {0, 1, 2};
        document.add_indices(triangle, static_cast<std::size_t>(vertices));
        EXPECT_EQ(json_of(*document.bytes())["accessors"][0]["componentType"], component);
    }
}

TEST(GlbDocument, bounds_of_sparse_vectors_count_the_zeros) {
    GlbDocument document;
    const std::array<std::uint32_t, 1> place = {2};
    const std::array<float, 3> value = {1.0F, -2.0F, 3.0F};
    document.add_sparse_vec3(4, place, value, true);
    document.add_sparse_vec3(1, std::array<std::uint32_t, 1>{0}, value, true);
    document.add_sparse_vec3(4, {}, {}, true);
    const Document accessors = json_of(*document.bytes())["accessors"];
    EXPECT_EQ(accessors[0]["min"], Document({0.0, -2.0, 0.0}));
    EXPECT_EQ(accessors[0]["max"], Document({1.0, 0.0, 3.0}));
    EXPECT_EQ(accessors[1]["min"], Document({1.0, -2.0, 3.0}));
    EXPECT_EQ(accessors[2]["sparse"]["count"], 1) << "some readers want values";
    EXPECT_EQ(accessors[2]["max"], Document({0.0, 0.0, 0.0}));
}

TEST(GlbDocument, names_an_extension_once) {
    GlbDocument document;
    document.use_extension("A");
    document.use_extension("B");
    document.use_extension("A");
    EXPECT_EQ(json_of(*document.bytes())["extensionsUsed"], Document({"A", "B"}));
}

}  // namespace
}  // namespace raks
