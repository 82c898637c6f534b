// Models that raks-import reads in a process of its own: what it makes of them, and what becomes of
// us when it does not do what it should.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <thread>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "render/import/foreign_model.hpp"
#include "render/import/model_reader.hpp"
#include "render/model/model_survey.hpp"
#include "tests/fuzz/mutation.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace raks::test {
namespace {

namespace fs = std::filesystem;
using namespace render;
using namespace std::chrono_literals;

/// A square with a picture's name and a colour; metres as the file has them.
constexpr const char* kObj = R"(mtllib square.mtl
v 0 0 0
v 2 0 0
v 2 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl red
f 1/1 2/2 3/3 4/4
)";

constexpr const char* kMaterial = "newmtl red\nKd 1 0 0\nd 0.5\nmap_Kd ../outside.png\n";

/// One triangle in inches with z up, on a node that is moved and turned by a clip.
constexpr const char* kCollada =
    R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="0.0254"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="gp"><float_array id="gpa" count="9">0 0 0 1 0 0 0 0 1</float_array>
<technique_common><accessor source="#gpa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="gv"><input semantic="POSITION" source="#gp"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#gv" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="n"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";

/// Says in bash that a glTF comes (5: done); its length in eight bytes and "'" must follow.
const std::string kDone = "printf '\\x01\\0IR\\5\\0\\0\\0";

/// Whether a process has ended; one that was killed may need a moment.
bool is_gone(pid_t pid) {
    for (int i = 0; i < 5000; ++i) {
        std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
        std::string number;
        std::string name;
        std::string state;
        if (!(stat >> number >> name >> state) || state == "Z") {
            return true;
        }
        std::this_thread::yield();
    }
    return false;
}

std::string message(const Expected<Model>& model) {
    return model ? std::string() : model.error().message;
}

class ImportChild : public testing::Test {
 protected:
    ~ImportChild() override { setenv("RAKS_IMPORTER", importer_.c_str(), 1); }

    fs::path give(const std::string& name, const std::string& bytes) const {
        EXPECT_TRUE(write_file(folder_ / name, bytes));
        return folder_ / name;
    }

    /// Another program takes the place of raks-import.
    void replace(const std::string& script) const {
        const fs::path program = give("importer", "#!/bin/bash\n" + script);
        fs::permissions(program, fs::perms::owner_all);
        setenv("RAKS_IMPORTER", program.c_str(), 1);
    }

    /// A Collada model within a time.
    Expected<Model> read_within(std::chrono::milliseconds longest,
                                const std::string& bytes = kCollada) const {
        return read_foreign_model("dae",
                                  std::as_bytes(std::span(bytes.data(), bytes.size())),
                                  SideFiles(fs::path(folder_ / "")),
                                  longest);
    }

    const std::string importer_ = std::getenv("RAKS_IMPORTER");
    const TemporaryFolder folder_;
};

TEST_F(ImportChild, reads_an_obj_with_what_lies_beside_it_and_nothing_outside) {
    give("square.mtl", kMaterial);
    const auto model = load_model(give("square.obj", kObj));
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_EQ(model->format, "OBJ");
    ASSERT_EQ(model->meshes.size(), 1U);
    const ModelPrimitive& part = model->meshes[0].primitives.at(0);
    EXPECT_EQ(part.positions.size(), 4U);
    EXPECT_EQ(part.indices.size(), 6U);
    EXPECT_EQ(part.uv[0].at(0), glm::vec2(0.0F, 1.0F));  // counted from the upper edge
    const ModelMaterial& red = model->materials.at(static_cast<std::size_t>(part.material));
    EXPECT_EQ(red.base_colour, glm::vec4(1.0F, 0.0F, 0.0F, 0.5F));
    EXPECT_EQ(red.alpha_mode, AlphaMode::blend);
    ASSERT_FALSE(model->warnings.empty());
    EXPECT_NE(model->warnings[0].find("leads out of the model's folder"), std::string::npos)
        << model->warnings[0];
}

TEST_F(ImportChild, hands_pictures_of_old_formats_on_as_png) {
    std::string tga(18 + 4, '\0');
    tga[2] = 2;
    tga[12] = tga[14] = 1;
    tga[16] = 32;
    give("skin.tga", tga);
    give("square.mtl", "newmtl red\nmap_Kd C:\\art\\skin.tga\n");
    const auto model = load_model(give("square.obj", kObj));
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_EQ(model->images.size(), 1U);
    EXPECT_EQ(model->images[0].width, 1);
    EXPECT_EQ(std::to_integer<char>(model->images[0].packed.at(1)), 'P');
}

TEST_F(ImportChild, brings_collada_to_metres_and_y_up) {
    const auto model = load_model(give("x.dae", kCollada));
    ASSERT_TRUE(model) << model.error().message;
    const auto& places = model->meshes.at(0).primitives.at(0).positions;
    ASSERT_EQ(places.size(), 3U);
    // The turn is the root's.
    EXPECT_NEAR(places[1].x, 0.0254F, 1e-7F);
    const glm::vec3 up = model->nodes.at(0).rotation * places[2];
    EXPECT_NEAR(up.y, 0.0254F, 1e-7F);
}

/// The bar of two bones with bones a hundredth as large, each as it is itself (2) or as large
/// against its parent (1); the upper one is 100 units up in both.
std::string bar_of_small_bones(int inherit_type, double up) {
    std::string text =
        read_file(std::string(RAKS_SOURCE_DIR) + "/tests/data/avatars/bent_bar_text.fbx").value();
    const std::string small = fmt::format(
        "P: \"InheritType\", \"enum\", \"\", \"\", {}\n"
        "P: \"Lcl Scaling\", \"Lcl Scaling\", \"\", \"A\", 0.01, 0.01, 0.01\n",
        inherit_type);
    const std::string lower = "\"Model::lower\", \"LimbNode\" {\n\t\tVersion: 232\n";
    text.insert(text.find(lower) + lower.size(), "Properties70:  {\n" + small + "}\n");
    const std::string upper = R"(P: "Lcl Translation", "Lcl Translation", "", "A", 0, 100, 0)";
    text.replace(
        text.find(upper),
        upper.size(),
        fmt::format(
            "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\", 0, {}, 0\n{}", up, small));
    return text;
}

TEST_F(ImportChild, a_bone_that_has_its_own_size_does_not_take_that_of_its_parent) {
    for (const auto& [inherit_type, size] : {std::pair{2, 0.01F}, std::pair{1, 0.0001F}}) {
        const auto model = load_model(give("x.fbx", bar_of_small_bones(inherit_type, 1e4)));
        ASSERT_TRUE(model) << model.error().message;
        const auto upper = std::find_if(model->nodes.begin(),
                                        model->nodes.end(),
                                        [](const ModelNode& node) { return node.name == "upper"; });
        ASSERT_NE(upper, model->nodes.end());
        const glm::mat4 world =
            rest_world(*model)[static_cast<std::size_t>(upper - model->nodes.begin())];
        EXPECT_NEAR(world[3].y, 1.0F, 1e-5F) << inherit_type;
        EXPECT_NEAR(glm::length(world[0]), size, 1e-3F * size) << inherit_type;
    }
}

std::string bar_as_text() {
    return read_file(std::string(RAKS_SOURCE_DIR) + "/tests/data/avatars/bent_bar_text.fbx")
        .value();
}

std::string with_in_place(std::string text, const std::string& old, const std::string& now) {
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return at == std::string::npos ? text : text.replace(at, old.size(), now);
}

const char* const kBarColour = R"(P: "DiffuseColor", "Color", "", "A", 0.8, 0.4, 0.2)";
const char* const kBarPicture = R"(C: "OP", 520, 500, "DiffuseColor")";

TEST_F(ImportChild, colours_of_an_fbx_are_linear_and_have_no_factor_but_for_glow) {
    const std::string colours = R"(P: "DiffuseColor", "Color", "", "A", 0.1746, 0.1144, 0.0612
P: "DiffuseFactor", "Number", "", "A", 0.8
P: "EmissiveColor", "Color", "", "A", 0.5, 0.25, 0
P: "EmissiveFactor", "Number", "", "A", 0.5
)";
    const std::string text =
        with_in_place(with_in_place(bar_as_text(), kBarColour, colours), kBarPicture, "");
    const auto model = load_model(give("x.fbx", text));
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_EQ(model->materials.size(), 1U);
    EXPECT_EQ(model->materials[0].base_colour, glm::vec4(0.1746F, 0.1144F, 0.0612F, 1.0F));
    EXPECT_EQ(model->materials[0].emissive, glm::vec3(0.25F, 0.125F, 0.0F));
}

TEST_F(ImportChild, connections_of_properties_do_not_keep_an_fbx_from_being_read) {
    const std::string turn = R"(C: "OP", 620, 312, "Lcl Rotation")";
    const std::string turned = R"(C: "PO", 620, "Lcl Rotation", 312)";
    const std::string text =
        with_in_place(bar_as_text(), turn, turned + "\n\tC: \"PP\", 200, \"Show\", 312, \"Show\"");
    const auto plain = load_model(give("plain.fbx", bar_as_text()));
    const auto model = load_model(give("x.fbx", text));
    ASSERT_TRUE(plain) << plain.error().message;
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_TRUE(model->warnings.empty());
    ASSERT_EQ(model->animations.size(), 1U);
    ASSERT_EQ(model->animations[0].channels.size(), plain->animations.at(0).channels.size());
    EXPECT_EQ(model->animations[0].channels[0].values, plain->animations[0].channels[0].values);
}

TEST_F(ImportChild, a_whole_fbx_that_assimp_cannot_read_is_to_be_saved_as_glb) {
    const std::string text =
        with_in_place(bar_as_text(), "C: \"OO\", 100, 200", "C: \"OO\", \"a\", 200");
    const std::string said = message(load_model(give("x.fbx", text)));
    EXPECT_NE(said.find("the file is whole, but assimp"), std::string::npos) << said;
    EXPECT_NE(said.find("save it as GLB"), std::string::npos) << said;
}

TEST_F(ImportChild, that_breaks_off_is_one_line) {
    const fs::path file = give("x.dae", kCollada);
    replace("exit 3\n");
    EXPECT_EQ(
        message(load_model(file)),
        file.string() + ": its reader ended too soon (exit code 3): it is damaged, or too large");
    replace("kill -SEGV $$\n");
    EXPECT_NE(message(load_model(file)).find("(killed by SIGSEGV)"), std::string::npos);
}

TEST_F(ImportChild, that_needs_too_much_memory_says_so) {
#ifdef RAKS_SANITIZED
    GTEST_SKIP() << "skipped: without a cage it may take as much as it likes";
#endif
    const std::string place = "<triangles count=\"1\">";
    std::string bytes = kCollada;
    bytes.replace(bytes.find(place), place.size(), "<polylist count=\"1\">");
    bytes.replace(bytes.find("</triangles>"), 12, "</polylist>");
    bytes.insert(bytes.find("<p>"), "<vcount>2147483648</vcount>");
    EXPECT_EQ(message(read_within(20s, bytes)),
              "it takes more than 1 GiB to read: it is damaged, or too large");
}

TEST_F(ImportChild, that_says_nonsense_is_one_line) {
    const fs::path file = give("x.dae", kCollada);
    replace("head -c 100000 /dev/urandom >&3\nsleep 100\n");
    EXPECT_EQ(message(load_model(file)),
              file.string() + ": its reader sent a broken answer and was ended");
    replace("while echo raks-import: all is well; do :; done >&3\n");
    EXPECT_EQ(message(load_model(file)),
              file.string() + ": its reader sent a broken answer and was ended");
    // A part of the right kind (5: done) with a garbled model in it.
    replace(kDone + "\\x08\\0\\0\\0\\0\\0\\0\\0glTFglTF' >&3\nsleep 100\n");
    EXPECT_EQ(message(load_model(file)),
              file.string() + ": read as glTF: is cut off within its header; copy it again");
    // A file (0), which only we may send.
    replace("printf '\\x01\\0IR\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0' >&3\nsleep 100\n");
    EXPECT_EQ(message(load_model(file)),
              file.string() + ": its reader sent a broken answer and was ended");
    // Notes without end.
    replace("while printf '\\x01\\0IR\\3\\0\\0\\0\\1\\0\\0\\0\\0\\0\\0\\0n'; do :; done >&3\n");
    EXPECT_EQ(message(load_model(file)),
              file.string() + ": its reader sent a broken answer and was ended");
}

TEST_F(ImportChild, that_lies_about_lengths_is_one_line) {
    const fs::path file = give("x.dae", kCollada);
    // More than any model may have.
    replace(kDone + "\\0\\0\\0\\0\\0\\0\\0\\x10glTF' >&3\nsleep 100\n");
    EXPECT_EQ(message(load_model(file)),
              file.string() + ": its reader sent a broken answer and was ended");
    // 400 MB of which four bytes come: nothing is reserved for what does not come.
    const std::string much = kDone + "\\0\\0\\0\\x18\\0\\0\\0\\0glTF' >&3\n";
    replace(much + "exit 0\n");
    EXPECT_EQ(
        message(load_model(file)),
        file.string() + ": its reader ended too soon (exit code 0): it is damaged, or too large");
    replace(much + "sleep 100\n");
    EXPECT_EQ(message(read_within(200ms)), "its reader took more than 0.2 s and was ended");
    // A glTF of 20 bytes that says it has 200. (Who ended without having read what it was given
    // would have broken off.)
    replace(kDone +
            "\\x14\\0\\0\\0\\0\\0\\0\\0glTF\\2\\0\\0\\0\\xc8\\0\\0\\0\\0\\0\\0\\0JSON' >&3\nsleep "
            "100\n");
    const std::string said = message(load_model(file));
    EXPECT_EQ(said.rfind(file.string() + ": read as glTF: ", 0), 0U) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
}

TEST_F(ImportChild, gets_of_what_lies_beside_a_model_what_the_model_names) {
    fs::create_directories(folder_ / ".ssh");
    give(".ssh/id_rsa", "secret");
    give("holiday.png", "secret");
    give("square.png", "inside");
    const std::string model = kCollada + std::string("<!-- square.png -->");
    // It reads the model, wants a file (2: want) and keeps what it is answered.
    const auto answer_to = [&](const std::string& wanted) {
        const std::string kept = (folder_ / "kept").string();
        replace(
            fmt::format("head -c {} <&3 >/dev/null\n"
                        "printf '\\x01\\0IR\\2\\0\\0\\0\\x{:02x}\\0\\0\\0\\0\\0\\0\\0{}' >&3\n"
                        "head -c 22 <&3 | tail -c 6 >{}\nexit 3\n",
                        model.size() + 16,
                        wanted.size(),
                        wanted,
                        kept));
        EXPECT_FALSE(read_within(20s, model));
        return read_file(kept).value();
    };
    EXPECT_EQ(answer_to("square.png"), "inside");
    EXPECT_NE(answer_to(".ssh/id_rsa"), "secret");
    EXPECT_NE(answer_to("holiday.png"), "secret");
}

TEST_F(ImportChild, that_asks_without_end_is_ended) {
    const std::string want = "printf '\\x01\\0IR\\2\\0\\0\\0\\1\\0\\0\\0\\0\\0\\0\\0x' >&3";
    replace("cat <&3 >/dev/null &\nwhile " + want + "; do :; done\n");
    EXPECT_NE(message(read_within(20s)).find("and was ended"), std::string::npos);
}

TEST_F(ImportChild, that_hangs_is_ended_with_all_that_it_started) {
    const fs::path started = folder_ / "started";
    const std::string note = "sleep 1000 & echo $! > " + started.string() + "\n";
    const char* const kWays[] = {
        "wait\n",                                       // it never reads
        "cat <&3 >/dev/null\n",                         // it reads and says nothing
        "trap '' TERM INT HUP\nwhile :; do :; done\n",  // it is busy and does not listen
    };
    for (const char* const way : kWays) {
        SCOPED_TRACE(way);
        replace(note + way);
        // More than a socket takes at once.
        EXPECT_EQ(message(read_within(500ms, std::string(4'000'000, ' '))),
                  "its reader took more than 0.5 s and was ended");
        pid_t helper = 0;
        std::ifstream(started) >> helper;
        ASSERT_GT(helper, 0);
        EXPECT_TRUE(is_gone(helper));
        EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);  // no child of ours is left
    }
}

TEST_F(ImportChild, that_is_not_there_is_one_line) {
    const fs::path file = give("x.dae", kCollada);
    setenv("RAKS_IMPORTER", "/nowhere/raks-import", 1);
    EXPECT_NE(message(load_model(file)).find("/nowhere/raks-import: is not there"),
              std::string::npos);
}

// RAKS_MODEL_MUTANTS=2000 tries that many of each.
TEST_F(ImportChild, damaged_files_are_read_or_refused_in_one_line) {
    const char* const more = std::getenv("RAKS_MODEL_MUTANTS");
    const int mutants = more == nullptr ? 30 : std::atoi(more);
    for (const char* const name :
         {"bent_bar.fbx", "bent_bar_text.fbx", "bent_bar.dae", "bent_bar.obj"}) {
        const std::string good =
            read_file(std::string(RAKS_SOURCE_DIR) + "/tests/data/avatars/" + name).value();
        for (int seed = 0; seed < mutants; ++seed) {
            const auto number = static_cast<std::uint64_t>(seed);
            const std::string bytes =
                seed % 2 == 0 ? fuzz::mutated(good, number) : fuzz::mutated_bytes(good, number);
            const auto model = load_model(give(name, bytes));
            EXPECT_EQ(message(model).find('\n'), std::string::npos) << name << " seed " << seed;
#ifndef RAKS_SANITIZED  // where assimp's own assertion takes 20 s to end its reader
            EXPECT_EQ(message(model).find("took more than"), std::string::npos)
                << name << " seed " << seed;
#endif
            EXPECT_EQ(message(model).find("exit code"), std::string::npos)
                << name << " seed " << seed << message(model);
        }
    }
}

}  // namespace
}  // namespace raks::test
