// Nothing outside the model's folder is ever opened.
#include "render/import/side_files.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace {

namespace fs = std::filesystem;
using raks::render::read_data_uri;
using raks::render::SideFiles;

class SideFilesTest : public testing::Test {
 protected:
    void SetUp() override {
        fs::create_directories(folder_ / "model" / "parts");
        write("secret.bin", "secret");
        write("model/a b.bin", "inside");
        write("model/parts/deep.bin", "deeper");
        fs::create_symlink(folder_ / "secret.bin", folder_ / "model" / "link.bin");
        fs::create_directory_symlink(folder_.path(), folder_ / "model" / "out");
        ASSERT_EQ(::mkfifo((folder_ / "model" / "pipe").c_str(), 0600), 0);
    }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
    }

    /// What is read, or the error.
    [[nodiscard]] std::string read(std::string_view uri, std::size_t most = 100) const {
        const auto bytes = SideFiles(folder_ / "model").read(uri, most);
        return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size())
                     : bytes.error().message;
    }

    raks::test::TemporaryFolder folder_;
};

TEST_F(SideFilesTest, inside_the_folder_are_read) {
    EXPECT_EQ(read("a%20b.bin"), "inside");
    EXPECT_EQ(read("parts/deep.bin"), "deeper");
    EXPECT_EQ(read("./parts/deep.bin"), "deeper");
}

TEST_F(SideFilesTest, outside_of_it_are_not) {
    for (const std::string uri : {"../secret.bin",
                                  "%2e%2e/secret.bin",
                                  "%2e%2e%2fsecret.bin",
                                  "parts/../../secret.bin",
                                  "..\\secret.bin",
                                  "/etc/hostname",
                                  "%2Fetc%2Fhostname",
                                  "file:///etc/hostname",
                                  "http://example.org/a.bin",
                                  "out/secret.bin",
                                  "link.bin",
                                  "link.bin%00.png",
                                  "parts//deep.bin",
                                  "%zz",
                                  ""}) {
        const auto bytes = SideFiles(folder_ / "model").read(uri, 100);
        EXPECT_FALSE(bytes) << uri;
    }
}

TEST_F(SideFilesTest, that_are_hidden_are_not_read) {
    fs::create_directories(folder_ / "model" / ".ssh");
    write("model/.ssh/id_rsa", "secret");
    write("model/.picture.png", "secret");
    for (const std::string uri : {".ssh/id_rsa", "./.ssh/id_rsa", "%2Essh/id_rsa"}) {
        EXPECT_EQ(read(uri), "\"" + uri + "\" is a hidden file, which is not read");
    }
    EXPECT_EQ(read(".picture.png"), "\".picture.png\" is a hidden file, which is not read");
}

TEST_F(SideFilesTest, that_are_no_plain_files_are_not_read) {
    EXPECT_EQ(read("pipe"), "\"pipe\" is not a plain file");
    EXPECT_EQ(read("parts"), "\"parts\" is not a plain file");
    EXPECT_EQ(read("."), "\".\" is not a plain file");
    EXPECT_EQ(read("none.bin"), "\"none.bin\" cannot be opened: No such file or directory");
}

TEST_F(SideFilesTest, that_are_too_large_are_not_read) {
    EXPECT_EQ(read("parts/deep.bin", 5), "\"parts/deep.bin\" has 6 bytes, more than 5");
}

TEST_F(SideFilesTest, are_none_without_a_folder) { EXPECT_FALSE(SideFiles().read("a.bin", 100)); }

TEST(DataUri, holds_base64) {
    const auto bytes = read_data_uri("data:application/octet-stream;base64,AAEC/w==", 100);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(bytes->size(), 4U);
    EXPECT_EQ(bytes->back(), std::byte{0xFF});
    for (const char* const uri : {"data:application/octet-stream,abc",
                                  "data:application/octet-stream;base64",
                                  "data:text/plain;base64,AAEC",
                                  "data:image/png;base64,AA?C",
                                  "data:image/png;base64,AAECA"}) {
        EXPECT_FALSE(read_data_uri(uri, 100)) << uri;
    }
    EXPECT_FALSE(read_data_uri("data:image/png;base64,AAECAAECAAEC", 4));
}

}  // namespace
