// Whether a camera stood still, told by where its background was.
#include "motion/capture/keypoints/still_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "base/dice.hpp"

namespace raks::capture {
namespace {

// 30 s of a film 1280 pixels wide whose background is told to a third of a pixel, and wrongly now
// and then.
KeypointFilm film_of(const std::function<BackgroundPlace(double)>& background) {
    KeypointFilm film{"left", 1280, 720, "full", {}};
    Dice dice(1, 1);
    for (std::size_t i = 0; i < 60; ++i) {
        KeypointPicture picture;
        picture.number = 15 * i;
        picture.time = 0.5 * static_cast<double>(i);
        BackgroundPlace place = background(picture.time);
        place.move += glm::dvec2(dice.uniform(-0.3, 0.3), dice.uniform(-0.3, 0.3));
        place.size += dice.uniform(-0.005, 0.005);
        if (i % 13 == 7) {
            place.move.x += 40.0;
        }
        picture.background = place;
        film.pictures.push_back(picture);
    }
    return film;
}

TEST(StillCamera, of_one_that_stands_nothing_is_said) {
    EXPECT_EQ(why_not_still(film_of([](double) { return BackgroundPlace{}; })), "");
    // A lens that found its focus.
    EXPECT_EQ(why_not_still(film_of([](double time) {
                  return BackgroundPlace{{}, time < 3.0 ? 1.0 : 1.012};
              })),
              "");
    EXPECT_EQ(why_not_still(KeypointFilm{"left", 1280, 720, "full", {}}), "");
}

TEST(StillCamera, a_bump_is_told_with_its_moment) {
    const std::string line = why_not_still(film_of([](double time) {
        return BackgroundPlace{{time < 12.2 ? 0.0 : 5.0, 0.0}, 1.0};
    }));
    EXPECT_EQ(line,
              "was moved at 12.2 s of its film: its background is 5 pixels elsewhere from there "
              "on; use the films before or after it alone, or film again");
}

TEST(StillCamera, a_hand_a_slow_turn_and_a_zoom_are_told) {
    EXPECT_EQ(why_not_still(film_of([](double time) {
                  return BackgroundPlace{{0.8 * time, 0.0}, 1.0};
              })).rfind("does not stand still: ", 0),
              0U);
    EXPECT_EQ(
        why_not_still(film_of([](double time) {
            return BackgroundPlace{{12.0 * std::sin(1.1 * time), 5.0 * std::sin(0.7 * time)}, 1.0};
        })).rfind("does not stand still: ", 0),
        0U);
    EXPECT_EQ(why_not_still(film_of([](double time) {
                  return BackgroundPlace{{}, 1.0 + 0.005 * time};
              })),
              "zooms: its background is 10 % larger in the end; switch zoom and stabilising off, "
              "and film again");
}

// Each picture from `first` to before `end` shows no background.
KeypointFilm without_background(std::size_t first, std::size_t end) {
    KeypointFilm film = film_of([](double) { return BackgroundPlace{}; });
    for (std::size_t i = first; i < end; ++i) {
        film.pictures[i].background = std::nullopt;
    }
    return film;
}

TEST(StillCamera, a_turn_after_which_nothing_is_as_before_is_told) {
    EXPECT_EQ(why_not_still(without_background(40, 60)),
              "was turned, or is covered, at 19.5 s of its film: nothing of its background is seen "
              "from there on; use the films before it alone, or film again");
    // Somebody comes to end the film; somebody passes; a wall tells next to nothing, or nothing.
    EXPECT_EQ(why_not_still(without_background(50, 60)), "");
    EXPECT_EQ(why_not_still(without_background(20, 45)), "");
    EXPECT_EQ(why_not_still(without_background(4, 60)), "");
    EXPECT_EQ(why_not_still(without_background(0, 60)), "");
}

TEST(StillCamera, it_surely_stood_where_its_background_is_seen_all_the_time) {
    EXPECT_TRUE(surely_stood_still(without_background(0, 0)));
    EXPECT_TRUE(surely_stood_still(without_background(30, 34)));
    EXPECT_FALSE(surely_stood_still(without_background(30, 45)));
    EXPECT_FALSE(surely_stood_still(without_background(40, 60)));
    EXPECT_FALSE(surely_stood_still(without_background(0, 60)));
    EXPECT_FALSE(surely_stood_still(KeypointFilm{"left", 1280, 720, "full", {}}));
    EXPECT_FALSE(surely_stood_still(film_of([](double time) {
        return BackgroundPlace{{time < 12.2 ? 0.0 : 5.0, 0.0}, 1.0};
    })));
}

TEST(StillCamera, an_hour_is_told_as_well) {
    KeypointFilm film{"left", 1280, 720, "full", {}};
    for (std::size_t i = 0; i < 7200; ++i) {
        KeypointPicture picture;
        picture.number = i;
        picture.time = 0.5 * static_cast<double>(i);
        picture.background = BackgroundPlace{{i < 5000 ? 0.0 : 20.0, 0.0}, 1.0};
        film.pictures.push_back(picture);
    }
    EXPECT_EQ(why_not_still(film).rfind("was moved at 2", 0), 0U) << why_not_still(film);
}

}  // namespace
}  // namespace raks::capture
