// What is said of tracks as a whole.
#include "apps/raks_capture/track_doubts.hpp"

#include <gtest/gtest.h>

#include <string>

#include <glm/mat3x3.hpp>

namespace raks::apps {
namespace {

/// A body that stands still for a second; `turn` is the world's.
capture::Tracks standing(const glm::dmat3& turn) {
    const capture::MarkerSet markers = capture::default_markers();
    capture::Tracks tracks;
    tracks.frames_per_second = 30.0;
    tracks.frame_count = 30;
    for (const capture::Marker& marker : markers.markers) {
        tracks.markers.push_back(marker.name);
    }
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        for (const std::string& name : tracks.markers) {
            const double height = name == "head" ? 1.8 : name.ends_with("toe") ? 0.1 : 1.0;
            tracks.places.push_back(
                {turn * glm::dvec3(0.1, height, 0.0), 0.005, 4, capture::PlaceSource::seen});
        }
    }
    return tracks;
}

const glm::dmat3 kUpright(1.0);
const glm::dmat3 kOnTheHead({1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0});
const glm::dmat3 kOnTheSide({1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, -1.0, 0.0});

TEST(TrackDoubts, are_none_for_a_body_that_stands_and_is_seen) {
    EXPECT_TRUE(track_doubts(standing(kUpright), capture::default_markers()).empty());
}

TEST(TrackDoubts, name_markers_that_are_lost) {
    capture::Tracks tracks = standing(kUpright);
    for (std::size_t frame = 0; frame < 20; ++frame) {
        tracks.at(frame, 1) = {};
        tracks.at(frame / 4, 2) = {};
    }
    const auto doubts = track_doubts(tracks, capture::default_markers());
    ASSERT_EQ(doubts.size(), 1U);
    EXPECT_TRUE(doubts[0].starts_with("lost most of the time: " + tracks.markers[1] + ":"))
        << doubts[0];
}

TEST(TrackDoubts, tell_a_world_that_is_upside_down_or_on_its_side) {
    const auto said = [](const glm::dmat3& turn) {
        const auto doubts = track_doubts(standing(turn), capture::default_markers());
        return doubts.size() == 1 ? doubts[0] : std::string();
    };
    EXPECT_NE(said(kOnTheHead).find("stands on the head"), std::string::npos);
    EXPECT_NE(said(kOnTheSide).find("lies all the time"), std::string::npos);
    EXPECT_NE(said(kOnTheSide).find("--floor"), std::string::npos);
}

}  // namespace
}  // namespace raks::apps
