#include "engine/setup/user_folders.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/mangled.hpp"

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

}  // namespace
}  // namespace raks::engine
