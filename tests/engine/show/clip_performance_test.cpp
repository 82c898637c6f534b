#include "engine/show/clip_performance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "base/pending_file.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "tests/motion/skeleton/formats/vmd_maker.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

const std::string kPerformed =
    (std::filesystem::path(RAKS_SOURCE_DIR) / "tests/data/bvh/dance/own_dance.bvh").string();

class ClipPerformanceTest : public ::testing::Test {
 protected:
    void SetUp() override {
        auto clip = AvatarClip::load(kPerformed, motion::mannequin_skeleton().offsets[0]);
        ASSERT_TRUE(clip) << clip.error().message;
        clip_ = std::make_unique<AvatarClip>(std::move(*clip));
        begin({.sync = ClipSync::song, .loop = ClipLoop::always});
    }
    void begin(const ClipTiming& timing) {
        performance_ =
            std::make_unique<ClipPerformance>(ClipPerformer(*clip_, timing), "own_dance.bvh");
    }
    /// The hips of both dancers at a moment of the stream.
    std::array<glm::vec3, 2> hips_at(double seconds) {
        const StreamTime moment = stream_time_from_seconds(seconds);
        const ShownMoment shown{
            music_, status_, {.tracks = tracks_, .places = places_, .moment = moment}};
        const ShownMoment performed = performance_->at(shown);
        EXPECT_EQ(performed.danced.tracks.size(), 2U);
        return {performed.danced.tracks[0].at(moment).hips_position,
                performed.danced.tracks[1].at(moment).hips_position};
    }
    void expect_at(double in_stream, double in_clip) {
        const auto hips = hips_at(in_stream);
        const glm::vec3 right = clip_->pose_at(in_clip).hips_position;
        for (std::size_t i = 0; i < hips.size(); ++i) {
            const glm::vec3 place(places_[i].x, 0.0F, places_[i].y);
            EXPECT_LT(glm::length(hips[i] - right - place), 1e-3F) << in_stream << " dancer " << i;
        }
    }

    std::unique_ptr<AvatarClip> clip_;
    std::unique_ptr<ClipPerformance> performance_;
    MusicState music_{};
    motion::DancerStatus status_{};
    std::array<motion::PoseTrack, 2> tracks_{};
    std::array<glm::vec2, 2> places_ = {glm::vec2(-1.0F, 0.0F), glm::vec2(1.0F, 0.5F)};
};

TEST_F(ClipPerformanceTest, goes_by_the_song_that_it_was_made_for) {
    performance_->follow_song(-10.0);
    expect_at(10.0, 0.0);
    expect_at(10.02, 0.02);
    expect_at(10.5, 0.5);
    expect_at(10.4, 0.4);  // others draw an earlier moment
    expect_at(10.5, 0.5);
    performance_->follow_song(-10.1);  // what a buffer makes of it
    expect_at(10.52, 0.52);
}

TEST_F(ClipPerformanceTest, stands_still_with_the_stream_and_begins_anew_with_another) {
    performance_->follow_song(-5.0);
    expect_at(5.0, 0.0);
    expect_at(5.3, 0.3);
    expect_at(5.3, 0.3);
    performance_->begin_anew();
    performance_->follow_song(0.0);
    expect_at(0.0, 0.0);
    expect_at(0.7, 0.7);
}

TEST_F(ClipPerformanceTest, stands_where_the_clip_begins_before_and_after_it_and_never_jumps) {
    begin({.sync = ClipSync::song, .loop = ClipLoop::never, .offset = 1.0});
    performance_->follow_song(0.0);
    const double end = clip_->duration() + 4.0;
    glm::vec3 before = hips_at(0.0)[0];
    float most = 0.0F;
    for (double time = 0.01; time < end; time += 0.01) {
        const glm::vec3 now = hips_at(time)[0];
        most = std::max(most, glm::length(now - before));
        before = now;
    }
    // As fast as anybody moves the hips.
    EXPECT_LT(most, 0.03F);
    const glm::vec3 first = clip_->pose_at(0.0).hips_position;
    EXPECT_LT(std::hypot(before.x - first.x + 1.0F, before.z - first.z), 0.06F);
}

TEST_F(ClipPerformanceTest, its_camera_goes_by_the_clip_and_stops_with_it) {
    const test::TemporaryFolder folder;
    test::VmdMaker maker;
    maker.count(0).count(0).count(2).camera(0, -45, {0, 10, 0}, {0, 0, 0}, 30);
    maker.camera(30, -25, {0, 10, 0}, {0, 0, 0}, 30);
    ASSERT_TRUE(write_file(folder / "x.vmd", maker.bytes()));
    auto camera = CameraMotion::load(folder / "x.vmd");
    ASSERT_TRUE(camera) << camera.error().message;
    const CameraMotion file = *camera;
    begin({.sync = ClipSync::song, .loop = ClipLoop::never, .offset = 1.0});
    performance_->set_camera(std::move(*camera));
    performance_->follow_song(0.0);
    (void)hips_at(0.5);
    EXPECT_FALSE(performance_->camera(1.0F));
    for (const double in_clip : {0.2, 0.6}) {
        (void)hips_at(1.0 + in_clip);
        const auto seen = performance_->camera(1.0F);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->distance, file.at(in_clip).distance, 1e-3F);
    }
    (void)hips_at(1.0 + clip_->duration() + 1.0);
    EXPECT_FALSE(performance_->camera(1.0F));
}

TEST_F(ClipPerformanceTest, has_poses_behind_it_for_what_swings) {
    (void)hips_at(20.0);
    (void)hips_at(20.3);
    const StreamTime moment = stream_time_from_seconds(20.3);
    const ShownMoment shown{
        music_, status_, {.tracks = tracks_, .places = places_, .moment = moment}};
    const motion::PoseTrack& track = performance_->at(shown).danced.tracks[0];
    EXPECT_LE(track.oldest_final(), 2000);
    EXPECT_GE(track.newest(), 2030);
}

}  // namespace
}  // namespace raks::engine
