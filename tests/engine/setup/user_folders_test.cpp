#include "engine/setup/user_folders.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr std::string_view kDirs =
    "# This file is written by xdg-user-dirs-update\n"
    "XDG_DESKTOP_DIR=\"$HOME/Desktop\"\n"
    "XDG_MUSIC_DIR=\"/srv/music\"\n"
    "XDG_PICTURES_DIR=\"$HOME/Bilder \\\"neu\\\"\"\n";

TEST(UserFolders, are_those_of_user_dirs) {
    EXPECT_EQ(user_folder_in(kDirs, "XDG_DESKTOP_DIR", "/home/a"), "/home/a/Desktop");
    EXPECT_EQ(user_folder_in(kDirs, "XDG_MUSIC_DIR", "/home/a"), "/srv/music");
    EXPECT_EQ(user_folder_in(kDirs, "XDG_PICTURES_DIR", "/home/a"), "/home/a/Bilder \"neu\"");
    EXPECT_EQ(user_folder_in(kDirs, "XDG_VIDEOS_DIR", "/home/a"), "");
    EXPECT_EQ(user_folder_in(kDirs, "XDG_DESKTOP_DIR", ""), "") << "no home";
    EXPECT_EQ(user_folder_in("XDG_A_DIR=\"rel\"\n", "XDG_A_DIR", "/h"), "");
    EXPECT_EQ(user_folder_in("XDG_A_DIR=\"$HOME\"\n", "XDG_A_DIR", "/h"), "/h/");
    EXPECT_EQ(user_folder_in("XDG_A_DIR=\"/a\"\nXDG_A_DIR=\"/b\"", "XDG_A_DIR", "/h"), "/b");
}

TEST(UserFolders, a_dated_file_has_a_name_that_nobody_has_yet) {
    const test::TemporaryFolder folder;
    std::set<std::filesystem::path> names;
    for (int i = 0; i < 5; ++i) {
        const auto path = dated_file(folder.path(), ".mp4");
        EXPECT_TRUE(names.insert(path).second) << path;
        EXPECT_EQ(path.parent_path(), folder.path());
        EXPECT_EQ(path.extension(), ".mp4");
        EXPECT_EQ(path.filename().string().substr(0, 5), "raks-");
        ASSERT_TRUE(write_file(path, "film"));
    }
}

TEST(UserFolders, damaged_files_give_an_absolute_path_or_none) {
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
        const auto text = test::mangled(kDirs, {.seed = seed, .bytes = 5});
        const auto folder = user_folder_in(text, "XDG_PICTURES_DIR", "/h");
        EXPECT_TRUE(folder.empty() || folder.is_absolute());
    }
    for (std::size_t length = 0; length <= kDirs.size(); ++length) {
        const auto folder = user_folder_in(kDirs.substr(0, length), "XDG_PICTURES_DIR", "/h");
        EXPECT_TRUE(folder.empty() || folder.is_absolute());
    }
}

/// With a folder for temporary files of its own, and none that the user has.
class WithoutHome : public testing::Test {
 protected:
    void SetUp() override {
        for (const char* name : {"TMPDIR", "HOME", "XDG_CACHE_HOME"}) {
            const char* const value = std::getenv(name);
            before_.emplace_back(
                name, value != nullptr ? std::optional<std::string>(value) : std::nullopt);
            ::unsetenv(name);
        }
        ::setenv("TMPDIR", temporary_.path().c_str(), 1);
    }
    void TearDown() override {
        for (const auto& [name, value] : before_) {
            value ? ::setenv(name.c_str(), value->c_str(), 1) : ::unsetenv(name.c_str());
        }
    }
    test::TemporaryFolder temporary_;
    std::filesystem::path folder_ = temporary_ / fmt::format("raks-{}", ::geteuid());

 private:
    std::vector<std::pair<std::string, std::optional<std::string>>> before_;
};

TEST_F(WithoutHome, a_temporary_folder_of_this_user_alone_takes_what_is_kept) {
    EXPECT_EQ(kept_folder("a").value(), folder_ / "a");
    EXPECT_EQ(kept_folder("b").value(), folder_ / "b") << "it is found again";
    struct stat status {};
    ASSERT_EQ(::stat(folder_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0700U);
}

TEST_F(WithoutHome, what_others_may_have_made_is_not_used) {
    const auto expect_refused = [&](const char* what) {
        const auto kept = kept_folder("a");
        EXPECT_FALSE(kept) << what;
        EXPECT_EQ(kept ? "" : kept.error().message.substr(0, folder_.string().size() + 13),
                  folder_.string() + ": is not used");
        EXPECT_FALSE(is_there(folder_ / "a")) << what;
        std::filesystem::remove(folder_);
    };
    ASSERT_TRUE(write_file(folder_, ""));
    expect_refused("a file");
    std::filesystem::create_directory(temporary_ / "other");
    ::chmod((temporary_ / "other").c_str(), 0700);
    std::filesystem::create_directory_symlink(temporary_ / "other", folder_);
    expect_refused("a link");
    std::filesystem::create_directory(folder_);
    ::chmod(folder_.c_str(), 0777);
    expect_refused("a folder that all may write");
    if (::geteuid() == 0) {  // nobody else may give folders away
        std::filesystem::create_directory(folder_);
        ::chmod(folder_.c_str(), 0700);
        ASSERT_EQ(::chown(folder_.c_str(), 12'345, 12'345), 0);
        expect_refused("a stranger's");
    }
}

}  // namespace
}  // namespace raks::engine
