// Clocks from what moves: dances that repeat themselves, films that mirror or are in slow motion.
#include "motion/capture/markerless/rough_clocks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/motion/capture/markerless/keypoint_scene.hpp"

namespace raks::capture {
namespace {

constexpr double kLater = 1.3;  // seconds that the second camera was started later

std::vector<KeypointFilm> two_films(const std::string& dance, double seconds) {
    const Rig rig = test::ring({0.0, 90.0});
    auto clocks = test::true_clocks(rig);
    clocks[1].offset = kLater;
    return test::filmed(test::written_dance(dance, 0, seconds), rig, clocks, {});
}

// The first `seconds` of a film so many times.
KeypointFilm repeated(const KeypointFilm& film, double seconds, int times) {
    KeypointFilm all = film;
    all.pictures.clear();
    for (int i = 0; i < times; ++i) {
        for (KeypointPicture picture : film.pictures) {
            if (picture.time - film.pictures.front().time < seconds - 1e-6) {
                picture.time += i * seconds;
                picture.number = all.pictures.size();
                all.pictures.push_back(picture);
            }
        }
    }
    return all;
}

// What a selfie camera that mirrors makes of a film, and the network of that.
void mirror(KeypointFilm& film) {
    for (KeypointPicture& picture : film.pictures) {
        const auto seen = picture.points;
        for (std::size_t i = 0; i < kBodyPoints; ++i) {
            std::string name(body_point_names()[i]);
            for (const auto& [side, other] :
                 {std::pair("left", "right"), std::pair("right", "left")}) {
                if (const auto at = name.find(side); at != std::string::npos) {
                    name.replace(at, std::string(side).size(), other);
                    break;
                }
            }
            Keypoint& point = picture.points[i];
            point = seen[static_cast<std::size_t>(*body_point_named(name))];
            point.pixel.x = point.visibility > 0.0 ? film.width - 1.0 - point.pixel.x : 0.0;
        }
    }
}

std::vector<Clock> known_clocks(const std::vector<KeypointFilm>& films) {
    return {{films[0].camera, 0.0, 0.0, 1.0}, {films[1].camera, kLater, 0.0, 1.0}};
}

TEST(RoughClocks, name_the_offsets_between_which_a_repeating_dance_cannot_tell) {
    constexpr double kPeriod = 6.0;
    const auto once = two_films("hiphop", 10.0);
    std::vector<KeypointFilm> films = {repeated(once[0], kPeriod, 3),
                                       repeated(once[1], kPeriod, 3)};
    const auto alone = rough_clocks(films);
    ASSERT_TRUE(alone) << alone.error().message;
    ASSERT_EQ(alone->doubts.size(), 1U);
    EXPECT_NE(alone->doubts[0].find("camera2: the dance repeats itself"), std::string::npos);
    EXPECT_NE(alone->doubts[0].find("+1.3"), std::string::npos) << alone->doubts[0];
    EXPECT_NE(alone->doubts[0].find("-4.7"), std::string::npos) << alone->doubts[0];
    // Dates of whole seconds tell which it is.
    for (const double truth : {kLater, kLater - kPeriod}) {
        const auto dated = rough_clocks(films, {100.0, {1000.0, 1000.0 + std::floor(truth)}});
        ASSERT_TRUE(dated) << dated.error().message;
        EXPECT_TRUE(dated->doubts.empty());
        EXPECT_NEAR(dated->clocks[1].offset, truth, 0.06);
    }
    // A film that is longer at its end: is the date that of the begin, or of the end?
    films[1].pictures.back().time += kPeriod;
    const auto unclear = rough_clocks(films, {100.0, {1000.0, 1001.0}});
    ASSERT_TRUE(unclear) << unclear.error().message;
    EXPECT_EQ(unclear->doubts.size(), 1U);
}

TEST(RoughClocks, refuse_a_film_that_mirrors) {
    auto films = two_films("hiphop", 12.0);
    EXPECT_EQ(why_mirrored(films, known_clocks(films)), "");
    mirror(films[1]);
    const std::string said = "camera1 or camera2 mirrors what the other one shows";
    EXPECT_EQ(why_mirrored(films, known_clocks(films)).substr(0, said.size()), said);
    const auto clocks = rough_clocks(films);
    ASSERT_FALSE(clocks);
    EXPECT_EQ(clocks.error().message.substr(0, said.size()), said);
    films.push_back(films[1]);
    films[2].camera = "camera3";
    mirror(films[2]);
    auto three = known_clocks(films);
    three.push_back({"camera3", kLater, 0.0, 1.0});
    EXPECT_EQ(why_mirrored(films, three).rfind("camera2: mirrors what camera1 shows", 0), 0U);
}

TEST(RoughClocks, say_which_film_is_in_slow_motion) {
    for (const std::size_t which : {0U, 1U}) {
        auto films = two_films("hiphop", 14.0);
        for (KeypointPicture& picture : films[which].pictures) {
            picture.time *= 4.0;
        }
        const auto clocks = rough_clocks(films);
        ASSERT_FALSE(clocks) << which;
        EXPECT_NE(clocks.error().message.find(films[which].camera +
                                              " is in slow motion, 4 times as slow"),
                  std::string::npos)
            << clocks.error().message;
    }
}

TEST(RoughClocks, refuse_films_of_two_dances) {
    auto films = two_films("hiphop", 12.0);
    films[1] = two_films("waltz", 12.0)[1];
    const auto clocks = rough_clocks(films);
    ASSERT_FALSE(clocks) << clocks->clocks[1].offset << " " << clocks->clocks[1].confidence;
    EXPECT_NE(clocks.error().message.find("nothing in it moves as in camera1: are they films of"),
              std::string::npos)
        << clocks.error().message;
}

}  // namespace
}  // namespace raks::capture
