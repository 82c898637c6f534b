// FBX, Collada and OBJ of the shared data, read through raks-import: what independent readers and
// the program that wrote a model say of it is what we read.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "render/import/model_reader.hpp"
#include "render/model/animation_channel.hpp"
#include "render/model/model_survey.hpp"
#include "tests/render/import/table.hpp"
#include "tests/support/shared_data.hpp"

#include <glm/gtc/matrix_transform.hpp>

namespace raks::test {
namespace {

namespace fs = std::filesystem;
using namespace render;

fs::path avatars() { return shared_data() / "avatars"; }

bool is_foreign(const std::string& format) {
    return format.rfind("FBX", 0) == 0 || format.rfind("COLLADA", 0) == 0 ||
           format.rfind("OBJ", 0) == 0;
}

class SharedForeignModels : public testing::Test {
 protected:
    void SetUp() override {
        if (!fs::exists(avatars() / "expected.tsv")) {
            GTEST_SKIP() << "no shared data";
        }
    }
};

void expect_point(const std::string& text, const glm::vec3& point, float size) {
    std::istringstream stream(text);
    glm::vec3 wanted(0.0F);
    stream >> wanted.x >> wanted.y >> wanted.z;
    EXPECT_LT(glm::length(wanted - point), 1e-3F * size)
        << text << " is " << point.x << " " << point.y << " " << point.z;
}

TEST_F(SharedForeignModels, have_the_boxes_and_triangles_that_independent_readers_find) {
    int found = 0;
    for (const TableRow& row : read_table(avatars() / "expected.tsv")) {
        if (!is_foreign(row.at("format"))) {
            continue;
        }
        SCOPED_TRACE(row.at("file"));
        const auto model = load_model(avatars() / "models" / row.at("file"));
        ASSERT_TRUE(model) << model.error().message;
        const ModelSurvey measured = survey(*model);
        // Of this one file the table counts polygons, which have four corners.
        const std::size_t parts = row.at("file") == "dae/library_animation_clips.dae" ? 2 : 1;
        EXPECT_EQ(std::to_string(measured.triangles / parts), row.at("triangles"));
        if (row.at("bbox_min") != "-") {
            ASSERT_TRUE(measured.box);
            const float size = glm::length(measured.box->high - measured.box->low);
            expect_point(row.at("bbox_min"), measured.box->low, size);
            expect_point(row.at("bbox_max"), measured.box->high, size);
        }
        ++found;
    }
    EXPECT_GE(found, 15);
}

/// Where the nodes are at a time of the first clip: world from node.
std::vector<glm::mat4> world_at(const Model& model, float seconds) {
    std::vector<NodeChannels> channels(model.nodes.size());
    for (const AnimationChannel& channel : model.animations.at(0).channels) {
        channels[static_cast<std::size_t>(channel.node)].take(channel);
    }
    std::vector<glm::mat4> world(model.nodes.size(), glm::mat4(1.0F));
    std::vector<int> waiting = model.roots;
    while (!waiting.empty()) {
        const auto node = static_cast<std::size_t>(waiting.back());
        waiting.pop_back();
        const NodePlace place = channels[node].at(model.nodes[node], seconds);
        const glm::mat4 local = glm::translate(glm::mat4(1.0F), place.translation) *
                                glm::mat4_cast(place.rotation) *
                                glm::scale(glm::mat4(1.0F), place.scale);
        const int parent = model.nodes[node].parent;
        world[node] = parent < 0 ? local : world[static_cast<std::size_t>(parent)] * local;
        waiting.insert(
            waiting.end(), model.nodes[node].children.begin(), model.nodes[node].children.end());
    }
    return world;
}

/// All vertices of skinned meshes at a time of the first clip.
std::vector<glm::vec3> posed(const Model& model, float seconds) {
    const auto world = world_at(model, seconds);
    std::vector<glm::vec3> places;
    for (const ModelNode& node : model.nodes) {
        if (node.mesh < 0 || node.skin < 0) {
            continue;
        }
        const ModelSkin& skin = model.skins[static_cast<std::size_t>(node.skin)];
        for (const ModelPrimitive& part :
             model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
            for (std::size_t v = 0; v < part.positions.size(); ++v) {
                glm::vec4 place(0.0F);
                for (std::size_t i = 0; i < 4; ++i) {
                    const std::size_t joint = part.joints[v][i];
                    place += part.weights[v][i] *
                             (world[static_cast<std::size_t>(skin.joints[joint])] *
                              skin.inverse_bind[joint] * glm::vec4(part.positions[v], 1.0F));
                }
                places.emplace_back(place);
            }
        }
    }
    return places;
}

/// The farthest that any of `points` is from the nearest of `others`.
float farthest(const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& others) {
    float most = 0.0F;
    for (const glm::vec3& point : points) {
        float nearest = std::numeric_limits<float>::max();
        for (const glm::vec3& other : others) {
            nearest = std::min(nearest, glm::distance(point, other));
        }
        most = std::max(most, nearest);
    }
    return most;
}

TEST_F(SharedForeignModels, a_clip_of_an_fbx_moves_its_skin_as_the_program_that_wrote_it) {
    const fs::path models = avatars() / "models";
    const auto model = load_model(models / "fbx" / "maya_kenney_character_7700_binary.fbx");
    ASSERT_TRUE(model) << model.error().message;
    for (const int frame : {4, 9}) {
        const auto mesh = load_model(models / "obj" /
                                     ("maya_kenney_character_" + std::to_string(frame) + ".obj"));
        ASSERT_TRUE(mesh) << mesh.error().message;
        std::vector<glm::vec3> wanted;
        for (const glm::vec3& place : mesh->meshes.at(0).primitives.at(0).positions) {
            constexpr float kCentimetre = 0.01F;
            wanted.push_back(kCentimetre * place);
        }
        constexpr float kFramesPerSecond = 24.0F;
        const auto found = posed(*model, static_cast<float>(frame) / kFramesPerSecond);
        EXPECT_LT(farthest(found, wanted), 1e-4F);
        EXPECT_LT(farthest(wanted, found), 1e-4F);
    }
}

/// What a file is said to do: any of what the words of `expected` allow.
void expect_as_told(const fs::path& file, const std::string& expected) {
    const auto model = load_model(file);
    const bool may_be_refused = expected.find("reject") != std::string::npos;
    const bool may_be_read = expected.find("accept") != std::string::npos ||
                             expected.find("repair") != std::string::npos;
    if (!model) {
        EXPECT_TRUE(may_be_refused) << model.error().message;
        EXPECT_EQ(model.error().message.find('\n'), std::string::npos);
        EXPECT_EQ(model.error().message.rfind(file.string() + ": ", 0), 0U)
            << model.error().message;
        return;
    }
    EXPECT_TRUE(may_be_read) << "was read";
}

TEST_F(SharedForeignModels, that_are_bad_are_refused_or_mended_as_their_index_says) {
    int files = 0;
    for (const TableRow& row : read_table(avatars() / "bad" / "INDEX.tsv")) {
        if (is_foreign(row.at("format"))) {
            SCOPED_TRACE(row.at("file") + ": " + row.at("what is wrong"));
            expect_as_told(avatars() / "bad" / row.at("file"), row.at("expected"));
            ++files;
        }
    }
    EXPECT_GE(files, 69);
}

}  // namespace
}  // namespace raks::test
