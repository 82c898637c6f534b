#include "engine/show/stage_drop.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/pending_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

class StageDropTest : public ::testing::Test {
 protected:
    std::string made(const std::string& name) {
        EXPECT_TRUE(write_file(folder_ / name, ""));
        return (folder_ / name).string();
    }
    test::TemporaryFolder folder_;
};

TEST_F(StageDropTest, each_file_goes_where_it_belongs) {
    fs::create_directories(folder_ / "songs");
    fs::create_directories(folder_ / "tango");
    made("tango/dances.toml");
    const StageDrop drop = sort_drop({made("a.MP3"),
                                      (folder_ / "songs").string(),
                                      made("list.m3u8"),
                                      made("me.vrm"),
                                      made("other.FBX"),
                                      made("walk.bvh"),
                                      made("wave.vrma"),
                                      (folder_ / "tango").string(),
                                      made("waltz.toml")});
    EXPECT_EQ(drop.music,
              (std::vector<fs::path>{folder_ / "a.MP3", folder_ / "songs", folder_ / "list.m3u8"}));
    EXPECT_EQ(drop.models,
              (std::vector<std::string>{(folder_ / "me.vrm").string(),
                                        (folder_ / "other.FBX").string()}));
    EXPECT_EQ(drop.clips, (std::vector<fs::path>{folder_ / "walk.bvh", folder_ / "wave.vrma"}));
    EXPECT_EQ(drop.dances, (std::vector<fs::path>{folder_ / "tango", folder_ / "waltz.toml"}));
    EXPECT_TRUE(drop.lines.empty());
}

TEST_F(StageDropTest, what_is_of_no_use_is_named_up_to_three_and_counted) {
    std::vector<std::string> paths = {made("letter.odt"), (folder_ / "gone.mp3").string()};
    EXPECT_EQ(sort_drop(paths).lines,
              (std::vector<std::string>{
                  paths[0] + ": is no music, model, dance or motion that Raks reads",
                  paths[1] + ": is not there"}));
    for (int i = 0; i < 1000; ++i) {
        paths.push_back((folder_ / std::to_string(i)).string());
    }
    const StageDrop drop = sort_drop(paths);
    ASSERT_EQ(drop.lines.size(), 4U);
    EXPECT_EQ(drop.lines.back(), "and 999 more of no use");
    EXPECT_TRUE(sort_drop({}).lines.empty());
}

TEST_F(StageDropTest, nothing_is_opened_so_that_nothing_can_hang) {
    const std::string pipe = (folder_ / "pipe.mp3").string();
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_EQ(sort_drop({pipe}).music.size(), 1U);
}

}  // namespace
}  // namespace raks::engine
