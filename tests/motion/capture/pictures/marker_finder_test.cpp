// Spots of the markers' colours are found where the markers are.
#include "motion/capture/pictures/marker_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "motion/capture/pictures/waist.hpp"
#include "tests/motion/capture/pictures/painted_spheres.hpp"

namespace raks::capture {
namespace {

using test::Canvas;
using test::kBackgrounds;
using test::kPaints;
using test::Light;

constexpr double kMissed = 100.0;  // pixels: the error of a marker that was not found

// Distance of a found spot of this colour that lies nearest.
double error_of(const std::vector<Spot>& spots, std::size_t colour, const glm::dvec2& centre) {
    double nearest = kMissed;
    for (const Spot& spot : spots) {
        if (spot.detection.colour == colour) {
            nearest = std::min(nearest, glm::distance(spot.detection.pixel, centre));
        }
    }
    return nearest;
}

struct Errors {
    double mean = 0.0;
    double p95 = 0.0;
};

// Spheres 13 pixels wide before every background, in side light too.
Errors centre_errors(ChromaForm form, double ambient) {
    MarkerFinder finder = MarkerFinder::create(test::learnt_paints(form, ambient)).value();
    Dice dice(5, 0);
    std::vector<double> errors;
    for (int round = 0; round < 60; ++round) {
        for (std::size_t c = 0; c < kPaints.size(); ++c) {
            Light light = test::drawn_light(dice, 0.25, 2.0);
            light.ambient = ambient;
            light.noise = 3.0;
            Canvas canvas(40, 40);
            canvas.fill(kBackgrounds[(static_cast<std::size_t>(round) + c) % kBackgrounds.size()],
                        light,
                        dice);
            const glm::dvec2 centre(dice.uniform(15.0, 25.0), dice.uniform(15.0, 25.0));
            canvas.paint_sphere(centre, 6.5, kPaints[c], light);
            const auto rgb = canvas.filmed(light, dice);
            errors.push_back(error_of(finder.find(canvas.view(rgb)), c, centre));
        }
    }
    std::sort(errors.begin(), errors.end());
    Errors result{.p95 = errors[errors.size() * 95 / 100]};
    for (const double error : errors) {
        result.mean += error / static_cast<double>(errors.size());
    }
    return result;
}

TEST(MarkerFinder, finds_centres_within_six_tenths_of_a_pixel_in_side_light) {
    const Errors side = centre_errors(ChromaForm::normalised, 0.08);
    const Errors even = centre_errors(ChromaForm::normalised, 0.25);
    const Errors plain = centre_errors(ChromaForm::crcb, 0.08);
    std::printf(
        "centre, mean / p95 px: normalised %.2f / %.2f (8 %% ambient), %.2f / %.2f (25 %%); "
        "crcb %.2f / %.2f\n",
        side.mean,
        side.p95,
        even.mean,
        even.p95,
        plain.mean,
        plain.p95);
    EXPECT_LE(side.p95, 0.6);
    EXPECT_LE(even.p95, 0.35);
    EXPECT_GT(plain.p95, side.p95);
}

class Spots : public ::testing::Test {
 protected:
    // Spheres of the first colour (green) before grey, with highlights.
    std::vector<Spot> find(const std::vector<glm::dvec2>& centres,
                           double radius,
                           std::span<const SearchWindow> windows = {}) {
        Dice dice(6, 0);
        const Light light{.towards = {0.0, 0.0, 1.0}};
        Canvas canvas(160, 120, glm::dvec3(0.3));
        for (const glm::dvec2& centre : centres) {
            canvas.paint_sphere(centre, radius, kPaints[0], light);
        }
        const auto rgb = canvas.filmed(light, dice);
        return windows.empty() ? finder_.find(canvas.view(rgb))
                               : finder_.find(canvas.view(rgb), windows);
    }

    MarkerFinder finder_ =
        MarkerFinder::create(test::learnt_paints(ChromaForm::normalised, 0.25)).value();
};

TEST_F(Spots, have_a_centre_an_area_and_the_chroma_of_their_colour) {
    for (const double radius : {2.0, 3.5, 8.0, 20.0}) {
        const glm::dvec2 centre(71.3, 52.8);
        const auto spots = find({centre}, radius);
        ASSERT_EQ(spots.size(), 1U) << radius;
        EXPECT_LT(glm::distance(spots.front().detection.pixel, centre), 0.25) << radius;
        EXPECT_NEAR(spots.front().detection.area, 3.14159 * radius * radius, 4.0 + 5.0 * radius);
        EXPECT_EQ(spots.front().detection.colour, 0U);
        EXPECT_LT(finder_.models()[0].distance2(spots.front().mean_chroma), 2.0);
    }
    EXPECT_TRUE(find({}, 3.0).empty());
}

TEST_F(Spots, of_touching_discs_are_two) {
    for (const double radius : {4.0, 6.0, 9.0}) {
        for (const double angle : {0.0, 0.4, 0.8, 1.6, 2.5}) {
            for (const double apart : {1.7, 2.0}) {
                const glm::dvec2 half =
                    0.5 * apart * radius * glm::dvec2(std::cos(angle), std::sin(angle));
                const glm::dvec2 middle(80.2, 60.4);
                const auto spots = find({middle - half, middle + half}, radius);
                ASSERT_EQ(spots.size(), 2U) << radius << " " << angle << " " << apart;
                EXPECT_LT(error_of(spots, 0, middle - half), 0.15 * radius);
                EXPECT_LT(error_of(spots, 0, middle + half), 0.15 * radius);
            }
        }
    }
}

TEST_F(Spots, of_a_disc_that_moved_are_one) {
    std::vector<glm::ivec2> pixels;
    for (int y = -20; y <= 20; ++y) {
        for (int x = -40; x <= 40; ++x) {
            const double along = std::clamp(0.8 * x + 0.6 * y, -12.0, 12.0);
            if (std::hypot(x - 0.8 * along, y - 0.6 * along) < 5.0) {
                pixels.emplace_back(x, y);
            }
        }
    }
    EXPECT_FALSE(waist_of(pixels));
    EXPECT_FALSE(waist_of(std::span(pixels).first(10)));
}

TEST_F(Spots, that_are_too_small_are_left_out) { EXPECT_TRUE(find({{60.0, 60.0}}, 0.9).empty()); }

TEST_F(Spots, are_found_in_the_windows_alone_and_once) {
    const std::vector<glm::dvec2> centres{{30.0, 30.0}, {100.0, 80.0}};
    const std::vector<SearchWindow> first{{{-50, -50}, {60, 60}}};
    ASSERT_EQ(find(centres, 5.0, first).size(), 1U);
    const std::vector<SearchWindow> overlapping{{{80, 60}, {120, 100}}, {{90, 70}, {1000, 1000}}};
    const auto spots = find(centres, 5.0, overlapping);
    ASSERT_EQ(spots.size(), 1U);
    EXPECT_LT(glm::distance(spots.front().detection.pixel, centres[1]), 0.3);
    const std::vector<SearchWindow> outside{{{500, 500}, {600, 600}}, {{20, 20}, {10, 10}}};
    EXPECT_TRUE(find(centres, 5.0, outside).empty());
}

TEST_F(Spots, follow_a_model_that_adapts) {
    ASSERT_EQ(find({{60.0, 60.0}}, 5.0).size(), 1U);
    const glm::dvec2 far = finder_.models()[0].mean + glm::dvec2(2000.0, 0.0);
    finder_.adapt_colour(0, far, 0.02);
    EXPECT_TRUE(find({{60.0, 60.0}}, 5.0).empty());
}

TEST(MarkerFinderColours, are_one_to_sixty_four) {
    EXPECT_FALSE(MarkerFinder::create({}));
    EXPECT_FALSE(MarkerFinder::create(std::vector<ColourModel>(65)));
    EXPECT_TRUE(MarkerFinder::create(std::vector<ColourModel>(64)));
}

}  // namespace
}  // namespace raks::capture
