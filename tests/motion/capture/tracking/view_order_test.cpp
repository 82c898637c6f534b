// Films that were exchanged or mirrored are told by their points.
#include "motion/capture/tracking/view_order.hpp"

#include <gtest/gtest.h>

#include <string>

#include "motion/capture/tracking/marker_tracker.hpp"
#include "tests/motion/capture/filmed_swing.hpp"

namespace raks::capture {
namespace {

using test::FilmedSwing;

// What a person who named two films the wrong way round has: points, labels and clocks follow.
void exchange(FilmedSwing& scene, std::size_t one, std::size_t other) {
    const std::string first = scene.rig.cameras[one].name;
    const std::string second = scene.rig.cameras[other].name;
    const auto renamed = [&](std::string& name) {
        name = name == first ? second : name == second ? first : name;
    };
    for (SeenFilm& film : scene.take.seen.films) {
        renamed(film.camera);
    }
    for (MarkerLabel& label : scene.take.labels) {
        renamed(label.camera);
    }
    for (Clock& clock : scene.clocks) {
        renamed(clock.camera);
    }
}

void mirror(FilmedSwing& scene, std::size_t camera) {
    const double last = scene.rig.cameras[camera].lens.width - 1.0;
    for (SeenPicture& picture : scene.take.seen.films[camera].pictures) {
        for (Detection& spot : picture.detections) {
            spot.pixel.x = last - spot.pixel.x;
        }
    }
    for (MarkerLabel& label : scene.take.labels) {
        if (label.camera == scene.rig.cameras[camera].name) {
            label.pixel.x = last - label.pixel.x;
        }
    }
}

std::string refusal(const FilmedSwing& scene) {
    const auto stages = scene.track();
    return stages ? std::string() : stages.error().message;
}

const StudioOptions kHard{.noise = 1.5, .drop = 0.3, .clutter = 6, .clock_error = 0.005};

TEST(ViewOrder, films_that_were_exchanged_are_refused_with_the_right_order) {
    for (const StudioOptions& options : {StudioOptions{}, kHard}) {
        for (const auto& [one, other] :
             {std::pair(0U, 1U), std::pair(1U, 3U), std::pair(0U, 3U), std::pair(2U, 5U)}) {
            FilmedSwing scene(3.0, options, MarkerColours::five);
            exchange(scene, one, other);
            const std::string said = refusal(scene);
            const std::string first = scene.rig.cameras[one].name;
            const std::string second = scene.rig.cameras[other].name;
            EXPECT_NE(said.find("camera \"" + first + "\" fits the place of \"" + second + "\""),
                      std::string::npos)
                << said;
            EXPECT_NE(said.find("camera \"" + second + "\" fits the place of \"" + first + "\""),
                      std::string::npos)
                << said;
            EXPECT_NE(said.find("capture.toml"), std::string::npos) << said;
        }
    }
}

TEST(ViewOrder, three_films_in_a_ring_are_told) {
    FilmedSwing scene(3.0, {}, MarkerColours::five);
    exchange(scene, 0, 1);
    exchange(scene, 1, 2);
    const std::string said = refusal(scene);
    EXPECT_NE(said.find("fits the place of"), std::string::npos) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), ';'), 2) << said;
}

TEST(ViewOrder, a_mirrored_film_is_named) {
    for (const StudioOptions& options : {StudioOptions{}, kHard}) {
        for (const std::size_t camera : {0U, 3U, 4U}) {
            FilmedSwing scene(3.0, options, MarkerColours::five);
            mirror(scene, camera);
            const std::string said = refusal(scene);
            EXPECT_NE(said.find("camera \"" + scene.rig.cameras[camera].name +
                                "\" fits its place when it is mirrored"),
                      std::string::npos)
                << said;
        }
    }
}

TEST(ViewOrder, what_is_in_order_is_left_alone) {
    for (const auto colours : {MarkerColours::unique, MarkerColours::five}) {
        for (const StudioOptions& options : {StudioOptions{}, kHard}) {
            EXPECT_EQ(refusal(FilmedSwing(3.0, options, colours)), "");
        }
    }
}

TEST(ViewOrder, labels_that_miss_each_other_are_refused) {
    FilmedSwing scene(2.0, {});
    const std::string camera = scene.take.labels.front().camera;
    for (MarkerLabel& label : scene.take.labels) {
        if (label.camera == camera) {
            label.pixel.y -= 40.0;
        }
    }
    EXPECT_NE(refusal(scene).find("miss each other by"), std::string::npos) << refusal(scene);
}

TEST(ViewOrder, who_knows_better_may_track_all_the_same) {
    FilmedSwing scene(2.0, {}, MarkerColours::five);
    exchange(scene, 0, 1);
    TrackerOptions options;
    options.check_order = false;
    const std::vector<Edit> none;
    EXPECT_TRUE(track_markers(
        {scene.rig, scene.markers, scene.take.seen, scene.clocks, scene.take.labels, none},
        options));
}

}  // namespace
}  // namespace raks::capture
