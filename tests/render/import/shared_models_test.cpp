// The models and the hostile files of the shared data: what independent readers and Khronos'
// validator say of them is what our reader says.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "base/file.hpp"
#include "render/import/model_reader.hpp"
#include "render/model/animation_channel.hpp"
#include "render/model/model_survey.hpp"
#include "tests/render/import/table.hpp"
#include "tests/support/process.hpp"
#include "tests/support/shared_data.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/gtc/matrix_transform.hpp>

namespace {

namespace fs = std::filesystem;
using namespace raks;
using namespace raks::render;
using raks::test::TableRow;

fs::path avatars() { return raks::test::shared_data() / "avatars"; }

/// Models that lie in the repository.
const fs::path kOwnModels = fs::path(RAKS_SOURCE_DIR) / "tests" / "data" / "avatars";

class SharedModels : public testing::Test {
 protected:
    void SetUp() override {
        if (!fs::exists(avatars() / "expected.tsv")) {
            GTEST_SKIP() << "no shared data";
        }
    }
};

/// Whether a file is one of those that we read ourselves: of the others raks-import makes glTF.
bool is_read_here(const fs::path& file) {
    const fs::path ending = file.extension();
    return is_model_name(file) && ending != ".fbx" && ending != ".dae" && ending != ".obj";
}

void expect_count(const TableRow& row, const std::string& column, std::size_t count) {
    if (row.at(column) != "-") {
        EXPECT_EQ(row.at(column), std::to_string(count)) << column;
    } else {
        EXPECT_EQ(count, 0U) << column;
    }
}

/// Three numbers, within 0.1 % of `size`.
void expect_point(const std::string& text, const glm::vec3& point, float size) {
    std::istringstream stream(text);
    glm::vec3 wanted(0.0F);
    stream >> wanted.x >> wanted.y >> wanted.z;
    EXPECT_LT(glm::length(wanted - point), 1e-3F * size) << text;
}

void expect_box(const TableRow& row, const ModelSurvey& found) {
    if (row.at("bbox_min") != "-") {
        ASSERT_TRUE(found.box);
        const float size = glm::length(found.box->high - found.box->low);
        expect_point(row.at("bbox_min"), found.box->low, size);
        expect_point(row.at("bbox_max"), found.box->high, size);
    }
}

/// A 3DS file stores vertices once for all normals and no clips; its table shows the stored places,
/// which of what moves are those of another frame.
void expect_tds_row(const TableRow& row, const ModelSurvey& found) {
    expect_count(row, "meshes", found.meshes);
    expect_count(row, "primitives", found.primitives);
    expect_count(row, "triangles", found.triangles);
    EXPECT_GE(found.vertices, std::stoul(row.at("vertices")));
    if (row.at("nodes") != "0") {  // no keyframer
        expect_count(row, "nodes", found.nodes);
    }
    if (found.animations == 0) {
        expect_box(row, found);
    }
}

void expect_row(const TableRow& row, const ModelSurvey& found) {
    EXPECT_EQ(found.format, row.at("format"));
    if (found.format.rfind("3DS", 0) == 0) {
        expect_tds_row(row, found);
        return;
    }
    expect_count(row, "nodes", found.nodes);
    expect_count(row, "joints_or_bones", found.joints);
    expect_count(row, "skins", found.skins);
    expect_count(row, "meshes", found.meshes);
    expect_count(row, "primitives", found.primitives);
    expect_count(row, "vertices", found.vertices);
    expect_count(row, "triangles", found.triangles);
    expect_count(row, "max_morphs", found.max_morphs);
    expect_count(row, "images", found.images);
    expect_count(row, "animations", found.animations);
    expect_count(row, "springs", found.springs);
    // Where the file has none by itself, some are made of morphs with known names.
    if (row.at("expressions") != "-") {
        expect_count(row, "expressions", found.expressions);
    }
    if (row.at("rest_minus_bind_m") != "-") {
        const float wanted = std::stof(row.at("rest_minus_bind_m"));
        EXPECT_NEAR(found.rest_minus_bind.value_or(-1.0F), wanted, 2e-4F + 1e-2F * wanted);
    }
    expect_box(row, found);
}

/// Every row of the table against the model that it names. Returns how many there were.
int expect_measures(const fs::path& table, const fs::path& models) {
    int found_models = 0;
    for (const TableRow& row : raks::test::read_table(table)) {
        const fs::path file = models / row.at("file");
        if (!is_read_here(file)) {
            continue;
        }
        SCOPED_TRACE(row.at("file"));
        const auto model = load_model(file);
        if (!model) {
            ADD_FAILURE() << model.error().message;
            continue;
        }
        ++found_models;
        expect_row(row, survey(*model));
    }
    return found_models;
}

TEST(OwnModels, are_counted_and_measured_as_by_an_independent_reader) {
    EXPECT_EQ(expect_measures(kOwnModels / "expected.tsv", kOwnModels), 8);
}

TEST_F(SharedModels, are_counted_and_measured_as_by_independent_readers) {
    EXPECT_GE(expect_measures(avatars() / "expected.tsv", avatars() / "models"), 33);
}

/// What a file is said to do: any of what the words of `expected` allow.
void expect_as_told(const fs::path& file, const std::string& expected) {
    const auto model = load_model(file);
    const bool may_be_refused = expected.find("reject") != std::string::npos;
    // It asks for Draco, which is read, and packs nothing by it.
    const bool may_be_read = expected.find("accept") != std::string::npos ||
                             expected.find("repair") != std::string::npos ||
                             file.filename() == "ext_required_draco.glb";
    if (!model) {
        EXPECT_TRUE(may_be_refused) << model.error().message;
        EXPECT_EQ(model.error().message.find('\n'), std::string::npos);
        EXPECT_EQ(model.error().message.rfind(file.string() + ": ", 0), 0U)
            << model.error().message;
        return;
    }
    EXPECT_TRUE(may_be_read) << "was read";
    // As it is stored its chunk has 44 bytes, and there is nothing to say.
    const bool is_whole = file.filename() == "zero-sized-bin-chunk-issue-440.glb";
    if (expected.find("warning") != std::string::npos && !is_whole) {
        EXPECT_FALSE(model->warnings.empty()) << "nothing was said";
    }
    (void)survey(*model);
}

/// World of a node that hangs on nothing, as a clip has it at a time.
glm::mat4 clip_world(const Model& model, int node, float seconds) {
    NodeChannels channels;
    for (const AnimationChannel& channel : model.animations.at(0).channels) {
        if (channel.node == node) {
            channels.take(channel);
        }
    }
    const NodePlace place = channels.at(model.nodes[static_cast<std::size_t>(node)], seconds);
    return glm::translate(glm::mat4(1.0F), place.translation) * glm::mat4_cast(place.rotation) *
           glm::scale(glm::mat4(1.0F), place.scale);
}

// Its vertices are stored as they lie at the end of its 181 turns: a key's turn is clockwise, and
// comes after those before it.
TEST_F(SharedModels, of_3ds_turn_until_they_stand_as_their_vertices_are_stored) {
    const auto model = load_model(avatars() / "models" / "3ds" / "RotatingCube.3DS");
    ASSERT_TRUE(model) << model.error().message;
    const glm::mat4 world = clip_world(*model, 0, 181.0F / 30.0F);
    glm::vec3 low(1e9F);
    glm::vec3 high(-1e9F);
    for (const glm::vec3& place : model->meshes[0].primitives[0].positions) {
        const glm::vec3 at(world * glm::vec4(place, 1.0F));
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    EXPECT_LT(glm::distance(low, glm::vec3(-46.0925F, -35.5429F, -25.8876F)), 1e-3F);
    EXPECT_LT(glm::distance(high, glm::vec3(8.76112F, 39.0875F, 40.8152F)), 1e-3F);
}

/// Names of all nodes with that of their parent, in order.
std::vector<std::string> tree_of(const Model& model) {
    std::vector<std::string> lines;
    for (const ModelNode& node : model.nodes) {
        lines.push_back(
            (node.parent < 0 ? "" : model.nodes[static_cast<std::size_t>(node.parent)].name) + "/" +
            node.name);
    }
    return lines;
}

TEST_F(SharedModels, of_3ds_have_the_trees_that_the_keyframer_says) {
    const auto wheel = load_model(avatars() / "models" / "3ds" / "cart_wheel.3DS");
    ASSERT_TRUE(wheel) << wheel.error().message;
    std::vector<std::string> lines = {"/wheel_2", "wheel_2/wheel_inne"};
    for (int spoke = 11; spoke <= 20; ++spoke) {
        lines.push_back("wheel_2/rad" + std::to_string(spoke));
    }
    lines.insert(lines.end(), {"wheel_2/wheel_meta", "wheel_2/wheel_oute"});
    EXPECT_EQ(tree_of(*wheel), lines);
    const auto branching = load_model(avatars() / "bad" / "3ds" / "ok_branching.3ds");
    ASSERT_TRUE(branching) << branching.error().message;
    EXPECT_EQ(tree_of(*branching),
              (std::vector<std::string>{
                  "/Torso", "Torso/Head", "Torso/ArmL", "Torso/ArmR", "ArmL/HandL"}));
}

/// Corner places of all triangles of a node, in the world.
std::vector<glm::vec3> corners_of(const Model& model, const std::string& name) {
    std::vector<glm::vec3> corners;
    const auto world = rest_world(model);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (model.nodes[i].name != name || model.nodes[i].mesh < 0) {
            continue;
        }
        for (const auto& primitive :
             model.meshes[static_cast<std::size_t>(model.nodes[i].mesh)].primitives) {
            for (const std::uint32_t index : primitive.indices) {
                corners.emplace_back(world[i] * glm::vec4(primitive.positions[index], 1.0F));
            }
        }
    }
    return corners;
}

TEST(OwnModels, of_3ds_have_the_parts_of_the_glb_that_they_were_made_of) {
    const auto tds = load_model(kOwnModels / "derived_kenney_character.3ds");
    const auto glb = load_model(kOwnModels / "kenney_character.glb");
    ASSERT_TRUE(tds && glb);
    for (const std::string name :
         {"leg-left", "leg-right", "torso", "arm-left", "arm-right", "antenna"}) {
        SCOPED_TRACE(name);
        const auto found = corners_of(*tds, name);
        const auto wanted = corners_of(*glb, name);
        ASSERT_EQ(found.size(), wanted.size());
        ASSERT_FALSE(found.empty());
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_LT(glm::distance(found[i], wanted[i]), 1e-4F);
        }
    }
}

TEST_F(SharedModels, that_are_bad_are_refused_or_mended_as_their_index_says) {
    int files = 0;
    for (const TableRow& row : raks::test::read_table(avatars() / "bad" / "INDEX.tsv")) {
        const fs::path file = avatars() / "bad" / row.at("file");
        if (is_read_here(file)) {
            SCOPED_TRACE(row.at("file") + ": " + row.at("what is wrong"));
            expect_as_told(file, row.at("expected"));
            ++files;
        }
    }
    EXPECT_GE(files, 250);
}

TEST_F(SharedModels, that_khronos_validator_finds_faults_in_are_not_read_silently) {
    const raks::test::TemporaryFolder folder;
    const fs::path archive = avatars() / "bad" / "khronos-validator-base.tar.xz";
    raks::test::ProcessPlan unpack;
    unpack.command = {"tar", "xf", archive.string(), "-C", folder.path().string()};
    ASSERT_EQ(raks::test::run_process(unpack).exit_code, 0);
    for (const TableRow& row : raks::test::read_table(avatars() / "bad" / "khronos.tsv")) {
        const fs::path file = folder.path() / row.at("file");
        if (!is_read_here(file)) {
            continue;
        }
        SCOPED_TRACE(row.at("file") + ": " + row.at("error_codes"));
        const auto model = load_model(file);
        if (row.at("errors") != "0") {
            EXPECT_TRUE(!model || !model->warnings.empty()) << "read without a word";
        } else if (row.at("warnings") == "0") {
            // Two are whole but for the bytes of their meshes.
            const bool has_no_bytes =
                !model && model.error().message.find("are not in the file") != std::string::npos;
            EXPECT_TRUE(model || has_no_bytes) << model.error().message;
        }
    }
}

}  // namespace
