// What is said of tracks as a whole.
#include "apps/raks_capture/track_doubts.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "motion/capture/studio/point_studio.hpp"

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

TEST(TrackDoubts, tell_when_too_much_is_lost_to_learn_from) {
    capture::Tracks tracks = standing(kUpright);
    EXPECT_EQ(lost_share(tracks), 0.0);
    EXPECT_TRUE(too_much_lost(tracks).empty());
    for (std::size_t i = 0; i < tracks.places.size(); i += 4) {
        tracks.places[i] = {};
    }
    EXPECT_NEAR(lost_share(tracks), 0.25, 0.01);
    EXPECT_TRUE(too_much_lost(tracks).starts_with("25 % of the places are lost"))
        << too_much_lost(tracks);
    for (capture::MarkerPlace& place : tracks.places) {
        place.source = capture::PlaceSource::filled;
    }
    EXPECT_EQ(lost_share(tracks), 0.0);
    EXPECT_TRUE(too_much_lost(tracks).starts_with("100 % of the places are lost or filled in"))
        << too_much_lost(tracks);
}

TEST(TrackDoubts, name_a_film_that_ends_long_before_the_others) {
    capture::Observations seen;
    std::vector<capture::Clock> clocks;
    for (const auto& [name, seconds] :
         {std::pair("a", 60), std::pair("b", 21), std::pair("c", 60)}) {
        capture::SeenFilm film{name, {}};
        for (int i = 0; i <= seconds; ++i) {
            film.pictures.push_back({static_cast<double>(i), {}});
        }
        seen.films.push_back(film);
        clocks.push_back({name, 0.5, 0.0, 1.0});
    }
    capture::Rig rig = capture::studio_rig(3);
    const auto doubts = film_doubts(rig, seen, clocks);
    ASSERT_EQ(doubts.size(), 1U);
    EXPECT_TRUE(doubts[0].starts_with("the film of camera \"b\" ends 39.0 s before")) << doubts[0];
    clocks[1].offset = 39.2;  // it began later, and ends with the others
    EXPECT_TRUE(film_doubts(rig, seen, clocks).empty());
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
