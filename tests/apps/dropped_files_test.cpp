#include "apps/xbody/dropped_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "base/pending_file.hpp"
#include "tests/render/import/tiny_tds.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

const fs::path kData = fs::path(RAKS_SOURCE_DIR) / "tests" / "data";
const std::string kClip = (kData / "bvh" / "dance" / "own_dance.bvh").string();

/// A figure is shown, and files are dropped on it.
class DroppedFilesTest : public ::testing::Test {
 protected:
    DroppedFilesTest() {
        for (const char* const name : {"me.3ds", "a.3ds", "b.3ds"}) {
            EXPECT_TRUE(write_file(folder_ / name, test::tds::figure()));
        }
    }
    [[nodiscard]] std::string path(const std::string& name) const {
        return (folder_ / name).string();
    }
    [[nodiscard]] DroppedFiles drop(const std::vector<std::string>& paths) const {
        const auto shown = load_shown_model(
            {.file = folder_ / "me.3ds", .options = {}, .motion = {}, .joints = {}});
        EXPECT_TRUE(shown) << shown.error().message;
        std::vector<DroppedFile> files;
        std::transform(paths.begin(), paths.end(), std::back_inserter(files), dropped_file);
        return read_dropped(files, wearer_of(*shown));
    }

    test::TemporaryFolder folder_;
};

TEST_F(DroppedFilesTest, a_motion_is_for_the_model_that_is_shown) {
    const DroppedFiles files = drop({kClip});
    EXPECT_FALSE(files.model);
    ASSERT_TRUE(files.clip);
    EXPECT_GT(files.clip->duration(), 0.0);
    EXPECT_EQ(files.motion, kClip);
    EXPECT_EQ(message_of(files), "It is moved by own_dance.bvh");
}

TEST_F(DroppedFilesTest, a_motion_moves_the_model_that_comes_with_it_in_any_order) {
    for (const auto& paths :
         {std::vector{kClip, path("a.3ds")}, std::vector{path("a.3ds"), kClip}}) {
        const DroppedFiles files = drop(paths);
        ASSERT_TRUE(files.model);
        EXPECT_GT(files.model->frame_count(), 1U);
        EXPECT_EQ(files.model->plan.motion, kClip) << "other labels read it anew";
        EXPECT_FALSE(files.clip);
        EXPECT_EQ(message_of(files).rfind("This is a.3ds. It is moved by own_dance.bvh", 0), 0U)
            << message_of(files);
    }
}

TEST_F(DroppedFilesTest, of_several_of_a_kind_the_first_counts_and_the_others_are_named) {
    const DroppedFiles files = drop({path("b.3ds"), kClip, path("a.3ds"), "other.bvh", "song.wav"});
    ASSERT_TRUE(files.model);
    EXPECT_EQ(files.model->file(), folder_ / "b.3ds");
    EXPECT_EQ(files.motion, kClip);
    EXPECT_FALSE(files.music) << "it is moved already";
    EXPECT_EQ(files.sound, "song.wav") << "to which it is moved";
    EXPECT_EQ(files.left_out, (std::vector<std::string>{"a.3ds", "other.bvh"}));
    EXPECT_NE(
        message_of(files).find("own_dance.bvh, with its music. Left out, as one is shown at a "
                               "time: a.3ds, other.bvh"),
        std::string::npos)
        << message_of(files);
}

TEST_F(DroppedFilesTest, what_cannot_be_read_is_said_and_the_rest_is_taken) {
    const DroppedFiles files = drop({path("none.3ds"), path("a.3ds"), path("none.bvh")});
    ASSERT_TRUE(files.model);
    EXPECT_EQ(files.model->file(), folder_ / "a.3ds");
    ASSERT_EQ(files.faults.size(), 2U);
    EXPECT_NE(files.faults[0].find("none.3ds"), std::string::npos);
    EXPECT_NE(files.faults[1].find("none.bvh"), std::string::npos);
    EXPECT_TRUE(drop({path("none.bvh"), "song.wav"}).music) << "nothing moves it yet";
    const DroppedFiles bad = drop({path("none.bvh")});
    EXPECT_EQ(message_of(bad), bad.faults.front());
}

TEST_F(DroppedFilesTest, a_model_file_without_a_surface_is_a_motion) {
    fs::copy_file(kData / "avatars" / "six_poses.vrma", folder_ / "clip.glb");
    const DroppedFiles files = drop({path("clip.glb")});
    EXPECT_FALSE(files.model);
    EXPECT_TRUE(files.clip) << message_of(files);
}

TEST_F(DroppedFilesTest, music_is_danced_to_by_the_model_that_comes_with_it) {
    const DroppedFiles files = drop({"/music/one.wav", path("a.3ds"), "/music/two.MP3"});
    ASSERT_TRUE(files.model && files.music);
    EXPECT_EQ(files.music->path, "/music/one.wav");
    EXPECT_EQ(files.left_out, std::vector<std::string>{"two.MP3"});
    EXPECT_NE(message_of(files).find(". Making a dance to one.wav"), std::string::npos);
}

TEST_F(DroppedFilesTest, a_written_dance_is_a_motion) {
    const DroppedFiles files =
        drop({(fs::path(RAKS_SOURCE_DIR) / "config" / "choreographies" / "waltz.toml").string()});
    ASSERT_TRUE(files.clip) << message_of(files);
    EXPECT_EQ(message_of(files), "It is moved by waltz.toml");
}

TEST(LoadingMessage, names_the_first_and_counts_the_others) {
    EXPECT_EQ(loading_message({dropped_file("/x/a.vrm")}), "Loading a.vrm");
    EXPECT_EQ(loading_message({dropped_file("/x/a.vrm"), dropped_file("b"), dropped_file("c")}),
              "Loading a.vrm and 2 more");
}

}  // namespace
}  // namespace raks::apps
