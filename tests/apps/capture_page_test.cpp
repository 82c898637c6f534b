#include "apps/raks_capture/capture_page.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "motion/capture/studio/point_studio.hpp"

#include <glm/vec3.hpp>

namespace raks::apps {
namespace {

using capture::PlaceSource;

/// Two markers over four frames: the first always seen, the second filled once and lost once.
capture::Tracks small_tracks() {
    capture::Tracks tracks;
    tracks.markers = {"head", "left_<toe>"};
    tracks.frames_per_second = 60.0;
    tracks.first_time = 1.5;
    tracks.frame_count = 4;
    for (std::size_t frame = 0; frame < 4; ++frame) {
        const double x = 0.1 * static_cast<double>(frame);
        tracks.places.push_back({{x, 1.7, 0.0}, 0.004, 6, PlaceSource::seen});
        tracks.places.push_back({{x, 0.0, 0.2}, 0.008, 3, PlaceSource::seen});
    }
    tracks.at(1, 1).source = PlaceSource::filled;
    tracks.at(2, 1) = {};
    tracks.flags = {{capture::Doubt::lost, 1, 2, 2}};
    return tracks;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++found;
    }
    return found;
}

/// Hips with two legs of one bone each, whose left ball rests and whose right one slides 0.5 m/s.
motion::MotionClip sliding_clip(std::size_t frames) {
    motion::MotionClip clip;
    clip.joints = {{"hips", 0, {0.0, 1.0, 0.0}, {}},
                   {"leftToes", 0, {0.1, -1.0, 0.0}, glm::dvec3(0.0, -0.01, 0.1)},
                   {"rightToes", 0, {-0.1, -1.0, 0.0}, {}},
                   {"leftHand", 0, {0.25, 0.0, 0.0}, {}},
                   {"rightHand", 0, {-0.26, 0.0, 0.0}, {}}};
    clip.frames_per_second = 50.0;
    clip.frame_count = frames;
    for (std::size_t frame = 0; frame < frames; ++frame) {
        for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
            clip.rotations.emplace_back(1.0, 0.0, 0.0, 0.0);
            clip.positions.push_back(clip.joints[joint].offset);
            clip.positions.back().z += joint == 2 ? 0.01 * static_cast<double>(frame) : 0.0;
        }
    }
    return clip;
}

TEST(CapturePage, says_what_is_not_there_yet) {
    CaptureReport report;
    report.name = "my <take>";
    const std::string page = capture_page(report);
    EXPECT_NE(page.find("Capture my &lt;take&gt;"), std::string::npos);
    EXPECT_NE(page.find("raks capture track"), std::string::npos);
    EXPECT_EQ(count(page, "<svg"), 0U);
    EXPECT_EQ(count(page, "<h2"), 0U);
}

TEST(CapturePage, shows_every_part_and_nothing_from_outside) {
    CaptureReport report;
    report.name = "take";
    report.rig = capture::studio_rig(6);
    report.clocks = {{"left", 0.25, -12.5, 0.9}};
    report.markers = capture::default_markers();
    report.tracks = small_tracks();
    report.moves = {{"cam_<2>", 1, 3, 12.0}};
    report.edits = {{capture::EditKind::swap, "head", "c7", "", 2, 2, {}},
                    {capture::EditKind::set, "head", "", "<left>", 1, 1, {3.0, 4.5}}};
    report.body = body_facts(sliding_clip(30), 3);
    const std::string page = capture_page(report);
    for (const char* part : {"The room",
                             "The clocks",
                             "cam_&lt;2&gt;",
                             "disagrees with the others from",
                             "The markers",
                             "To be looked at",
                             "Corrected by hand",
                             "The dance",
                             "0.2500",
                             "-12.5",
                             "exchanged with c7 from here on",
                             "&lt;left&gt;\" at (3.0, 4.5)",
                             "left_&lt;toe&gt;",
                             "75.0 % of the places"}) {
        EXPECT_NE(page.find(part), std::string::npos) << part;
    }
    // The room, the visibility, a curve for each marker, the strip.
    EXPECT_EQ(count(page, "<svg"), 5U);
    EXPECT_EQ(count(page, "<svg"), count(page, "</svg>"));
    EXPECT_EQ(page.find("http"), std::string::npos);
    EXPECT_EQ(page.find("nan"), std::string::npos);
    EXPECT_EQ(page.find("inf"), std::string::npos);
    EXPECT_EQ(page.find("from the truth"), std::string::npos);
}

TEST(CapturePage, counts_what_is_wrong_where_the_truth_is_known) {
    constexpr double kLost = std::numeric_limits<double>::infinity();
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    CaptureReport report;
    report.tracks = small_tracks();
    report.errors = {0.002, 0.01, 0.004, 0.2, 0.006, kLost, kUnknown, kUnknown};
    const std::string page = capture_page(report);
    // (2 + 10 + 4 + 6) / 4 mm; two of six places.
    EXPECT_NE(page.find("5.5 mm from the truth"), std::string::npos);
    EXPECT_NE(page.find("33.33 % of the places"), std::string::npos);
    EXPECT_EQ(page.find("nan"), std::string::npos);
    EXPECT_EQ(page.find("inf"), std::string::npos);
}

TEST(BodyFacts, tell_a_foot_that_rests_from_one_that_slides) {
    const auto facts = body_facts(sliding_clip(100), 4);
    ASSERT_TRUE(facts);
    EXPECT_DOUBLE_EQ(facts->seconds, 2.0);
    EXPECT_EQ(facts->left.ninety, 0.0);
    EXPECT_NEAR(facts->right.median, 0.5, 1e-9);
    EXPECT_EQ(facts->left.planted, 1.0);
    EXPECT_NEAR(facts->left.lowest, -0.01, 1e-9);
    EXPECT_EQ(facts->right.lowest, 0.0);
    ASSERT_EQ(facts->lengths.size(), 2U);  // forearm and foot
    EXPECT_EQ(facts->lengths[0].name, "forearm");
    EXPECT_EQ(facts->lengths[0].left, 0.25);
    EXPECT_EQ(facts->lengths[0].right, 0.26);
    EXPECT_EQ(facts->strip.size(), 4U);
}

TEST(BodyFacts, are_none_of_what_has_no_toes) {
    motion::MotionClip clip = sliding_clip(3);
    clip.joints[1].name = "LeftToeBase";
    EXPECT_FALSE(body_facts(clip));
}

}  // namespace
}  // namespace raks::apps
