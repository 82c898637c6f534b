// Clocks from what moves: dances that repeat themselves, films that mirror or are in slow motion.
#include "motion/capture/markerless/rough_clocks.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/dice.hpp"
#include "tests/motion/capture/markerless/keypoint_scene.hpp"

namespace raks::capture {
namespace {

constexpr double kLater = 1.3;  // seconds that the second camera was started later

/// A dancer of joints that each swing in a way of their own, and begin anew after a while.
class SwingingJoints {
 public:
    SwingingJoints(double period, std::uint64_t seed) : period_(period) {
        Dice dice(seed, 0);
        for (auto& joint : swings_) {
            for (Swing& swing : joint) {
                swing = {dice.uniform(0.3, 2.0), dice.uniform(0.0, 6.28), dice.uniform(0.02, 0.08)};
            }
        }
    }

    [[nodiscard]] glm::dvec3 place(std::size_t joint, double time) const {
        const double since = std::fmod(time + 10.0 * period_, period_);
        double up = 0.0;
        for (const Swing& swing : swings_[joint]) {
            up += swing.reach * std::sin(6.2831853 * swing.rate * since + swing.phase);
        }
        return {0.1 * static_cast<double>(joint % 5) - 0.2,
                0.05 * static_cast<double>(joint) + up,
                0.1 * static_cast<double>(joint % 3)};
    }

 private:
    struct Swing {
        double rate = 0.0;  // Hz
        double phase = 0.0;
        double reach = 0.0;  // metres
    };
    std::array<std::array<Swing, 3>, kBodyPoints> swings_{};
    double period_;
};

// Two films of so many seconds, by cameras 90 degrees apart.
std::vector<KeypointFilm> two_films(double seconds,
                                    double period = 1000.0,
                                    std::uint64_t seed = 1) {
    constexpr double kRate = 30.0;
    const SwingingJoints dancer(period, seed);
    const Rig rig = test::ring({0.0, 90.0});
    std::vector<KeypointFilm> films;
    for (const Camera& camera : rig.cameras) {
        KeypointFilm& film = films.emplace_back(KeypointFilm{camera.name, 720, 720, "full", {}});
        const double later = films.size() > 1 ? kLater : 0.0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(seconds * kRate); ++i) {
            KeypointPicture& picture = film.pictures.emplace_back();
            picture.number = i;
            picture.time = static_cast<double>(i) / kRate;
            picture.score = 1.0;
            for (std::size_t joint = 0; joint < kBodyPoints; ++joint) {
                picture.points[joint] = {
                    *project(camera, dancer.place(joint, picture.time + later)), 1.0};
            }
        }
    }
    return films;
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
    auto films = two_films(18.0, kPeriod);
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
        ASSERT_EQ(dated->notes.size(), 1U);
        EXPECT_NE(dated->notes[0].find("by the films' dates it is "), std::string::npos);
        EXPECT_NEAR(dated->clocks[1].offset, truth, 0.06);
    }
    // A film that is longer at its end: is the date that of the begin, or of the end?
    films[1].pictures.back().time += kPeriod;
    const auto unclear = rough_clocks(films, {100.0, {1000.0, 1001.0}});
    ASSERT_TRUE(unclear) << unclear.error().message;
    EXPECT_EQ(unclear->doubts.size(), 1U);
}

TEST(RoughClocks, refuse_a_film_that_mirrors) {
    auto films = two_films(12.0);
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
        auto films = two_films(14.0);
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
    auto films = two_films(12.0);
    films[1] = two_films(12.0, 1000.0, 2)[1];
    const auto clocks = rough_clocks(films);
    ASSERT_FALSE(clocks) << clocks->clocks[1].offset << " " << clocks->clocks[1].confidence;
    EXPECT_NE(clocks.error().message.find("nothing in it moves as in camera1: are they films of"),
              std::string::npos)
        << clocks.error().message;
}

}  // namespace
}  // namespace raks::capture
