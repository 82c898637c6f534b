// Markers are followed through points of a studio in which everything is known.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "base/dice.hpp"
#include "motion/capture/markers/edits.hpp"
#include "motion/capture/studio/point_studio.hpp"
#include "motion/capture/tracking/distance_limits.hpp"
#include "motion/capture/tracking/marker_filter.hpp"
#include "motion/capture/tracking/marker_tracker.hpp"
#include "motion/capture/tracking/track_errors.hpp"
#include "tests/motion/capture/filmed_swing.hpp"
#include "tests/support/mangled.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::capture {
namespace {

/// A take of four seconds.
struct Scene : test::FilmedSwing {
    explicit Scene(const StudioOptions& options, MarkerColours colours = MarkerColours::unique)
        : FilmedSwing(4.0, options, colours) {}

    [[nodiscard]] TrackErrors errors(const Tracks& tracks) const {
        return *track_errors(tracks, take.truth);
    }
};

TEST(TrackErrors, are_told_without_what_a_turned_and_moved_world_adds) {
    const Scene scene(StudioOptions{});
    Tracks moved = scene.take.truth;
    const glm::dquat turn = glm::angleAxis(0.01, glm::normalize(glm::dvec3(1.0, 2.0, -1.0)));
    for (MarkerPlace& place : moved.places) {
        place.place = turn * place.place + glm::dvec3(0.01, -0.02, 0.005);
    }
    const TrackErrors errors = scene.errors(moved);
    EXPECT_GT(errors.mean, 0.01);
    EXPECT_LT(errors.aligned_mean, 1e-9);
}

TEST(PointStudio, films_with_unlike_cameras) {
    StudioOptions options{.noise = 0.0};
    options.rates = {30.0, 30.0, 24.0, 30.0, 30.0, 60.0};
    options.bumps = {std::nullopt, 2.0};
    const Scene plain(StudioOptions{.noise = 0.0});
    const Scene scene(options);
    const auto& films = scene.take.seen.films;
    EXPECT_EQ(films[0].pictures.size(), plain.take.seen.films[0].pictures.size());
    EXPECT_NEAR(static_cast<double>(films[2].pictures.size()), 4.0 * 24.0, 2.0);
    EXPECT_NEAR(static_cast<double>(films[5].pictures.size()), 4.0 * 60.0, 2.0);
    // Two degrees aside and one down, in a picture of f 600.
    const auto shift = [&](std::size_t picture) {
        return glm::distance(films[1].pictures[picture].detections.front().pixel,
                             plain.take.seen.films[1].pictures[picture].detections.front().pixel);
    };
    EXPECT_EQ(shift(50), 0.0);
    EXPECT_NEAR(shift(70), 600.0 * std::sqrt(5.0) * 0.01745, 3.0);
}

TEST(PointStudio, reads_rows_one_after_the_other) {
    StudioOptions options{.noise = 0.0};
    options.rolling_shutter = 0.02;
    const Scene plain(StudioOptions{.noise = 0.0});
    const Scene scene(options);
    double most = 0.0;
    for (std::size_t i = 0; i < 100; ++i) {
        const auto& one = scene.take.seen.films[0].pictures[i].detections;
        const auto& other = plain.take.seen.films[0].pictures[i].detections;
        ASSERT_EQ(one.size(), other.size());
        for (std::size_t k = 0; k < one.size(); ++k) {
            // A place moves within 10 ms by 3 cm at most, which is 6 pixels.
            EXPECT_LT(glm::distance(one[k].pixel, other[k].pixel), 6.0);
            most = std::max(most, glm::distance(one[k].pixel, other[k].pixel));
        }
    }
    EXPECT_GT(most, 1.0);
}

TEST(MarkerFilter, is_that_of_textbooks_on_a_line) {
    // A point at constant speed, seen exactly: after a few frames place and speed are known.
    MeasuredPlace seen{{0.0, 1.0, 0.0}, glm::dmat3(1e-6)};
    MarkerBelief belief = first_belief(seen);
    for (int i = 1; i <= 10; ++i) {
        belief = predicted(belief, 0.1, 0.1);
        seen.place.x = 0.05 * i;
        belief = updated(belief, seen);
    }
    EXPECT_NEAR(belief.place.x, 0.5, 1e-3);
    EXPECT_NEAR(belief.velocity.x, 0.5, 1e-2);
    EXPECT_LT(belief.deviation(), 0.002);
}

TEST(MarkerFilter, the_smoother_halves_the_error_and_stays_bounded) {
    Dice dice(1, 1);
    std::vector<std::optional<MeasuredPlace>> seen;
    std::vector<glm::dvec3> truth;
    for (int i = 0; i < 2000; ++i) {
        truth.emplace_back(std::sin(0.03 * i), std::cos(0.02 * i), 0.0);
        const glm::dvec3 noise(dice.normal(0.01), dice.normal(0.01), dice.normal(0.01));
        seen.push_back(MeasuredPlace{truth.back() + noise, glm::dmat3(1e-4)});
    }
    double raw = 0.0;
    double smooth = 0.0;
    const auto beliefs = smoothed(seen, 1.0 / 60.0, 5.0);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        raw += glm::distance(seen[i]->place, truth[i]);
        smooth += glm::distance(beliefs[i].place, truth[i]);
    }
    EXPECT_LT(smooth, 0.5 * raw);
}

TEST(DistanceLimits, hold_for_any_pose_of_the_body) {
    const MarkerSet markers = default_markers();
    const auto limits = distance_limits(markers, 0.0);
    EXPECT_GT(limits.size(), 25U);
    for (const motion::Pose& pose : test::swinging(3.0)) {
        const auto places = marker_places(markers,
                                          motion::mannequin_skeleton(),
                                          motion::world_pose(motion::mannequin_skeleton(), pose));
        for (const DistanceLimit& limit : limits) {
            const double apart = glm::distance(places[limit.one], places[limit.other]);
            EXPECT_GE(apart, limit.least) << markers.markers[limit.one].name;
            EXPECT_LE(apart, limit.most) << markers.markers[limit.one].name;
        }
    }
}

TEST(DistanceLimits, tell_how_large_the_body_is) {
    const MarkerSet markers = default_markers();
    const auto limits = distance_limits(markers, 0.0);
    for (const motion::Pose& pose : test::swinging(0.5)) {
        auto places = marker_places(markers,
                                    motion::mannequin_skeleton(),
                                    motion::world_pose(motion::mannequin_skeleton(), pose));
        EXPECT_NEAR(*scale_of(places, limits), 1.0, 0.12);
        for (glm::dvec3& place : places) {
            place *= 1000.0;
        }
        EXPECT_NEAR(*scale_of(places, limits), 1000.0, 120.0);
        for (std::size_t i = 3; i < places.size(); ++i) {
            places[i] = glm::dvec3(std::nan(""));
        }
        EXPECT_FALSE(scale_of(places, limits));
    }
}

TEST(MarkerTracker, a_board_of_another_size_than_said_is_told_by_the_dancer) {
    for (const double factor : {2.0, 0.5}) {
        Scene scene({});
        for (Camera& camera : scene.rig.cameras) {
            camera.translation *= factor;
        }
        const auto stages = scene.track();
        ASSERT_FALSE(stages);
        const std::string said = stages.error().message;
        const std::size_t at = said.find("in metres; ");
        ASSERT_NE(at, std::string::npos) << said;
        EXPECT_NEAR(std::stod(said.substr(at + 11)), 1.0 / factor, 0.12 / factor) << said;
    }
}

TEST(MarkerTracker, a_rig_in_millimetres_is_told) {
    Scene scene({});
    for (Camera& camera : scene.rig.cameras) {
        camera.translation *= 1000.0;
    }
    const auto stages = scene.track();
    ASSERT_FALSE(stages);
    EXPECT_NE(stages.error().message.find("millimetres"), std::string::npos);
    // One line, though every camera is far from every other.
    EXPECT_EQ(rig_doubts(scene.rig).size(), 1U);
}

TEST(MarkerTracker, follows_every_marker_in_a_clean_scene) {
    const Scene scene({});
    const auto stages = scene.track();
    ASSERT_TRUE(stages) << stages.error().message;
    EXPECT_LT(scene.errors(stages->triangulated).mean, 0.0075);
    EXPECT_LT(scene.errors(stages->smoothed).mean, 0.0055);
    EXPECT_LE(scene.errors(stages->smoothed).wrong_share(), 0.005);
    EXPECT_LT(scene.errors(stages->smoothed).mean, scene.errors(stages->filtered).mean);
}

TEST(MarkerTracker, tells_markers_of_one_colour_apart) {
    const Scene scene({}, MarkerColours::five);
    const auto stages = scene.track();
    ASSERT_TRUE(stages) << stages.error().message;
    EXPECT_LE(scene.errors(stages->smoothed).wrong_share(), 0.05);
}

TEST(MarkerTracker, goes_on_through_drops_clutter_and_clocks_that_are_off) {
    const Scene scene({.noise = 1.5, .drop = 0.3, .clutter = 6, .clock_error = 0.005, .seed = 4});
    const auto stages = scene.track();
    ASSERT_TRUE(stages) << stages.error().message;
    EXPECT_LE(scene.errors(stages->smoothed).wrong_share(), 0.03);
}

TEST(MarkerTracker, is_the_same_for_the_same_input) {
    const Scene scene({.drop = 0.2, .clutter = 3});
    EXPECT_EQ(tracks_text(scene.track()->smoothed), tracks_text(scene.track()->smoothed));
}

TEST(MarkerTracker, a_hidden_stretch_is_filled_and_flagged) {
    const Scene scene({});
    const auto stages = scene.track({{EditKind::hide, "head", "", "", 40, 52, {}}});
    ASSERT_TRUE(stages);
    const std::size_t head = *scene.markers.index_of("head");
    EXPECT_EQ(stages->smoothed.at(45, head).source, PlaceSource::filled);
    EXPECT_EQ(stages->smoothed.at(39, head).source, PlaceSource::seen);
    EXPECT_TRUE(std::any_of(
        stages->smoothed.flags.begin(), stages->smoothed.flags.end(), [&](const Flag& flag) {
            return flag.doubt == Doubt::filled && flag.marker == head && flag.first == 40;
        }));
}

TEST(MarkerTracker, a_swap_exchanges_two_markers_from_there_on) {
    const Scene scene({}, MarkerColours::five);
    // Both wrists are of one colour. Swapped, they break the body's limits, so that the tracker
    // itself puts them right; without neighbours nothing contradicts.
    const auto plain = scene.track();
    const auto swapped =
        scene.track({{EditKind::swap, "left_wrist", "right_wrist", "", 30, 30, {}}});
    ASSERT_TRUE(plain && swapped);
    const std::size_t left = *scene.markers.index_of("left_wrist");
    EXPECT_EQ(plain->triangulated.at(29, left).place, swapped->triangulated.at(29, left).place);
    EXPECT_NE(tracks_text(plain->smoothed), tracks_text(swapped->smoothed));
}

TEST(MarkerTracker, a_person_can_set_a_marker_that_was_lost) {
    Scene scene({});
    // The head is not labelled, so nobody knows where it is until it is set in two views.
    std::erase_if(scene.take.labels, [](const auto& label) { return label.marker == "head"; });
    const std::size_t head = *scene.markers.index_of("head");
    const glm::dvec3 place = scene.take.truth.at(50, head).place;
    std::vector<Edit> edits;
    for (const std::size_t camera : {0U, 2U}) {
        edits.push_back({EditKind::set,
                         "head",
                         "",
                         scene.rig.cameras[camera].name,
                         50,
                         50,
                         *project(scene.rig.cameras[camera], place)});
    }
    const auto stages = scene.track(edits);
    ASSERT_TRUE(stages) << stages.error().message;
    EXPECT_EQ(stages->smoothed.at(20, head).source, PlaceSource::lost);
    EXPECT_LT(
        glm::distance(stages->smoothed.at(80, head).place, scene.take.truth.at(80, head).place),
        0.03);
}

TEST(MarkerTracker, says_what_is_missing_or_wrong) {
    Scene scene({});
    const auto message = [&] {
        const auto stages = scene.track();
        return stages ? std::string() : stages.error().message;
    };
    scene.take.labels[0].pixel = {-50.0, 10.0};
    EXPECT_NE(message().find("outside"), std::string::npos);
    scene.take.labels[0].marker = "tail";
    EXPECT_NE(message().find("\"tail\""), std::string::npos);
    scene.take.labels.clear();
    EXPECT_NE(message().find("labelled"), std::string::npos);
    scene.clocks.pop_back();
    EXPECT_NE(message().find("clock"), std::string::npos);
    scene.take.seen.films[0].camera = "other";
    EXPECT_NE(message().find("not in the rig"), std::string::npos);
    scene.rig.cameras.resize(1);
    EXPECT_NE(message().find("two or more"), std::string::npos);
}

TEST(Edits, read_back_and_say_what_is_wrong) {
    const std::vector<Edit> edits = {{EditKind::set, "head", "", "left", 12, 12, {0.1, 2.0}},
                                     {EditKind::hide, "c7", "", "", 3, 9, {}},
                                     {EditKind::swap, "a", "b", "", 7, 7, {}},
                                     {EditKind::fill, "c7", "", "", 3, 3, {}},
                                     {EditKind::hide, "", "", "left", 3, 9, {}},
                                     {EditKind::hide, "c7", "", "left", 3, 9, {}},
                                     {EditKind::exchange, "", "", "left", 3, 9, {}},
                                     {EditKind::exchange, "", "", "left", 3, 9, {}, "legs"}};
    const auto read = read_edits(edits_text(edits), "e.jsonl");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, edits);
    const auto why = [](const std::string& text) { return read_edits(text, "e").error().message; };
    EXPECT_NE(why("{").find("line 1"), std::string::npos);
    EXPECT_NE(why("\n{\"edit\":\"sett\"}").find("line 2"), std::string::npos);
    EXPECT_NE(why("{\"edit\":\"hide\",\"marker\":\"a\",\"first\":4,\"last\":2}").find("before"),
              std::string::npos);
    EXPECT_NE(
        why("{\"edit\":\"swap\",\"marker\":\"a\",\"other\":\"a\",\"frame\":1}").find("itself"),
        std::string::npos);
    EXPECT_NE(why("{\"edit\":\"hide\",\"first\":1,\"last\":2}").find("needs \"marker\""),
              std::string::npos);
    EXPECT_NE(why("{\"edit\":\"exchange\",\"first\":1,\"last\":2}").find("needs \"camera\""),
              std::string::npos);
    EXPECT_NE(why("{\"edit\":\"exchange\",\"camera\":\"a\",\"limbs\":\"hands\",\"first\":1,"
                  "\"last\":2}")
                  .find("arms or legs"),
              std::string::npos);
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        (void)read_edits(test::mangled(edits_text(edits), {.seed = seed}), "e");
    }
}

}  // namespace
}  // namespace raks::capture
