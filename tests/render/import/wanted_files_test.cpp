// A reader in a process of its own gets of what lies beside a model what the model names, and
// nothing else.
#include "render/import/wanted_files.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace raks::render {
namespace {

namespace fs = std::filesystem;

class WantedFilesTest : public testing::Test {
 protected:
    void SetUp() override {
        fs::create_directories(folder_ / "model/textures");
        fs::create_directories(folder_ / "model/.ssh");
        for (const char* const name : {"id_rsa",
                                       "secret.png",
                                       "model/skin.png",
                                       "model/other.png",
                                       "model/notes.txt",
                                       "model/textures/deep.JPG",
                                       "model/.ssh/id_rsa",
                                       "model/.ssh/skin.png"}) {
            write(name, "inside");
        }
        write("model/square.mtl", "newmtl red\nmap_Kd other.png\n");
        fs::create_symlink(folder_ / "secret.png", folder_ / "model/link.png");
        fs::create_directory_symlink(folder_.path(), folder_ / "model/out");
    }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
    }

    /// What a model of this text gets when it wants `uri`, or why it gets nothing.
    [[nodiscard]] std::string read(const std::string& model, std::string_view uri) const {
        const SideFiles side(folder_ / "model");
        WantedFiles wanted(std::as_bytes(std::span(model)), side);
        const auto bytes = wanted.read(uri, 100);
        return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size())
                     : bytes.error().message;
    }

    raks::test::TemporaryFolder folder_;
};

TEST_F(WantedFilesTest, that_the_model_names_are_handed_out) {
    EXPECT_EQ(read("a picture: skin.png", "skin.png"), "inside");
    EXPECT_EQ(read("C:\\art\\deep.JPG", "textures/deep.JPG"), "inside");
    EXPECT_EQ(read("mtllib square.mtl", "./square.mtl").substr(0, 6), "newmtl");
}

TEST_F(WantedFilesTest, that_it_does_not_name_are_not) {
    EXPECT_EQ(read("a picture: skin.png", "other.png"),
              "\"other.png\" is not a file that the model names");
    EXPECT_EQ(read("", "skin.png"), "\"skin.png\" is not a file that the model names");
}

TEST_F(WantedFilesTest, are_named_by_materials_that_were_handed_out_before) {
    const SideFiles side(folder_ / "model");
    const std::string model = "mtllib square.mtl";
    WantedFiles wanted(std::as_bytes(std::span(model)), side);
    EXPECT_FALSE(wanted.read("other.png", 100));
    EXPECT_TRUE(wanted.read("square.mtl", 100));
    EXPECT_TRUE(wanted.read("other.png", 100));
}

TEST_F(WantedFilesTest, are_parts_of_models_alone_whatever_the_model_names) {
    const std::string model =
        "id_rsa .ssh/id_rsa notes.txt .ssh/skin.png ../secret.png link.png out/secret.png";
    EXPECT_EQ(read(model, "id_rsa"), "\"id_rsa\" is not a picture of a kind that Raks reads");
    EXPECT_EQ(read(model, "notes.txt"), "\"notes.txt\" is not a picture of a kind that Raks reads");
    EXPECT_EQ(read(model, ".ssh/id_rsa"), "\".ssh/id_rsa\" is a hidden file, which is not read");
    EXPECT_EQ(read(model, ".ssh/skin.png"),
              "\".ssh/skin.png\" is a hidden file, which is not read");
    EXPECT_EQ(read(model, "../secret.png"), "\"../secret.png\" leads out of the model's folder");
    EXPECT_EQ(read(model, "link.png"),
              "\"link.png\" is a symbolic link, which is not followed; put the file itself there");
    EXPECT_NE(read(model, "out/secret.png"), "inside");
}

TEST(SpellsName, however_a_program_spells_it) {
    struct Case {
        const char* text;
        const char* name;
        bool is_spelt;
    };
    constexpr Case kCases[] = {
        {"x skin.png", "skin.png", true},
        {"x skin.pn", "skin.png", false},
        {"", "skin.png", false},
        {"<init_from>my%20skin.png<", "my skin.png", true},
        {"my%2skin.png", "my skin.png", false},
        {"a &amp; b.png", "a & b.png", true},
        {"a &amp b.png", "a & b.png", false},
        {"b\\u00e9b\\u00e9.png",
         "b\xC3\xA9"
         "b\xC3\xA9.png",
         true},
        {"b%C3%A9.png", "b\xC3\xA9.png", true},
        {"b&#233;.png", "b\xC3\xA9.png", true},
        {"b\xE9.png", "b\xC3\xA9.png", true},  // Latin 1
        {"be.png", "b\xC3\xA9.png", false},
        {"sskin.png", "skin.png", true},
    };
    for (const Case& one : kCases) {
        EXPECT_EQ(spells_name(one.text, one.name), one.is_spelt) << one.text << " " << one.name;
    }
    // UTF-16, whose mark says so.
    const std::string wide("\xFF\xFEs\0k\0i\0n\0.\0p\0n\0g\0", 18);
    const raks::test::TemporaryFolder folder;
    std::ofstream(folder / "skin.png") << "inside";
    const SideFiles side(folder.path());
    EXPECT_TRUE(WantedFiles(std::as_bytes(std::span(wide)), side).read("skin.png", 100));
}

}  // namespace
}  // namespace raks::render
