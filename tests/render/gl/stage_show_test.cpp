// What is seen of a drop: the stage before and after it, in every theme.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <string>

#include "render/mannequin/mannequin.hpp"
#include "render/renderer.hpp"
#include "render/scene/light_show.hpp"
#include "render/scene/stage_show.hpp"
#include "tests/render/gl/pictures.hpp"
#include "tests/render/scene/shipped_themes.hpp"
#include "tests/render/scene/staged_music.hpp"

namespace raks::render {
namespace {

constexpr double kRadian = 3.14159265358979 / 180.0;

struct Lab {
    double l, a, b;
};

/// The mean of a picture, in sRGB's linear light.
std::array<double, 3> mean_of(const Picture& picture) {
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
        if (i % 4 != 3) {
            const double value = picture.rgba[i] / 255.0;
            sum[i % 4] += value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
        }
    }
    for (double& channel : sum) {
        channel /= static_cast<double>(picture.rgba.size()) / 4.0;
    }
    return sum;
}

/// CIE 1976, of D65.
Lab lab_of(const std::array<double, 3>& rgb) {
    const auto f = [](double t) {
        return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    };
    const double x = f((0.4124 * rgb[0] + 0.3576 * rgb[1] + 0.1805 * rgb[2]) / 0.95047);
    const double y = f(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]);
    const double z = f((0.0193 * rgb[0] + 0.1192 * rgb[1] + 0.9505 * rgb[2]) / 1.08883);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

/// CIEDE2000 (Sharma, Wu, Dalal 2005).
double difference_of(const Lab& one, const Lab& two) {
    const double mean_c = 0.5 * (std::hypot(one.a, one.b) + std::hypot(two.a, two.b));
    const double c7 = std::pow(mean_c, 7.0);
    const double g = 0.5 * (1.0 - std::sqrt(c7 / (c7 + std::pow(25.0, 7.0))));
    const double a1 = (1.0 + g) * one.a;
    const double a2 = (1.0 + g) * two.a;
    const double c_1 = std::hypot(a1, one.b);
    const double c_2 = std::hypot(a2, two.b);
    const auto hue = [](double b, double a) {
        const double h = std::atan2(b, a) / kRadian;
        return h < 0.0 ? h + 360.0 : h;
    };
    const double h1 = c_1 == 0.0 ? 0.0 : hue(one.b, a1);
    const double h2 = c_2 == 0.0 ? 0.0 : hue(two.b, a2);
    double dh = h2 - h1;
    dh = c_1 * c_2 == 0.0 ? 0.0 : dh > 180.0 ? dh - 360.0 : dh < -180.0 ? dh + 360.0 : dh;
    double h = 0.5 * (h1 + h2);
    h = c_1 * c_2 == 0.0             ? h1 + h2
        : std::abs(h1 - h2) <= 180.0 ? h
        : h1 + h2 < 360.0            ? h + 180.0
                                     : h - 180.0;
    const double l = 0.5 * (one.l + two.l) - 50.0;
    const double c = 0.5 * (c_1 + c_2);
    const double t =
        1.0 - 0.17 * std::cos((h - 30.0) * kRadian) + 0.24 * std::cos(2.0 * h * kRadian) +
        0.32 * std::cos((3.0 * h + 6.0) * kRadian) - 0.20 * std::cos((4.0 * h - 63.0) * kRadian);
    const double cp7 = std::pow(c, 7.0);
    const double rc = 2.0 * std::sqrt(cp7 / (cp7 + std::pow(25.0, 7.0)));
    const double turn = 30.0 * std::exp(-std::pow((h - 275.0) / 25.0, 2.0));
    const double sl = (two.l - one.l) / (1.0 + 0.015 * l * l / std::sqrt(20.0 + l * l));
    const double sc = (c_2 - c_1) / (1.0 + 0.045 * c);
    const double sh =
        2.0 * std::sqrt(c_1 * c_2) * std::sin(0.5 * dh * kRadian) / (1.0 + 0.015 * c * t);
    return std::sqrt(sl * sl + sc * sc + sh * sh - std::sin(2.0 * turn * kRadian) * rc * sc * sh);
}

TEST(ColourDifference, is_as_in_the_tables_of_its_authors) {
    EXPECT_NEAR(difference_of({50.0, 2.6772, -79.7751}, {50.0, 0.0, -82.7485}), 2.0425, 1e-4);
    EXPECT_NEAR(
        difference_of({60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}), 1.2644, 1e-4);
    EXPECT_NEAR(
        difference_of({22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}), 2.0373, 1e-4);
}

/// Breakdown of 8 s, build-up of 8 s, drop; a dancer who stands before a camera that does, too.
class StageShow : public OffscreenTest {
 protected:
    struct Means {
        double luma = 0.0;  ///< of 255
        std::array<double, 3> light{};
    };

    /// The means of what is seen in the last 4 s of the breakdown and in 8 s from the drop on.
    static std::array<Means, 2> seen(Renderer& renderer,
                                     const Theme& theme,
                                     Liveliness liveliness) {
        LightShow light(liveliness);
        StagedMusic music{Bpm(124.0)};
        OffscreenTarget target = make_target(160, 90);
        Scene scene;
        scene.theme = &theme;
        std::array<Means, 2> means;
        std::array<int, 2> counts{};
        for (int hop = 0; hop < 2400; ++hop) {
            music.next.part = hop < 800    ? MusicPart::breakdown
                              : hop < 1600 ? MusicPart::build_up
                                           : MusicPart::playing;
            music.next.energy.now = music.next.energy.lately = hop < 1600 ? 0.4F : 0.8F;
            if (hop == 1600) {
                music.next.event.kind = MusicEvent::Kind::drop;
            }
            const MusicState state = music.state();
            scene.light = light.advance(state);
            const bool is_drop = hop >= 1600;
            if (hop % 20 != 0 || (!is_drop && (hop < 400 || hop >= 800))) {
                continue;
            }
            scene.rings = beat_rings(state.grid, state.time);
            scene.beat = stage_beat(state.grid, state.time);
            scene.seconds = to_seconds(state.time);
            renderer.draw(scene, standing_pose(), target.frame());
            const Picture picture = read_picture(target);
            const std::size_t part = is_drop ? 1 : 0;
            means[part].luma += picture.brightness();
            const auto mean = mean_of(picture);
            for (std::size_t i = 0; i < 3; ++i) {
                means[part].light[i] += mean[i];
            }
            ++counts[part];
        }
        for (std::size_t part = 0; part < 2; ++part) {
            means[part].luma /= counts[part];
            for (double& channel : means[part].light) {
                channel /= counts[part];
            }
        }
        return means;
    }
};

TEST_F(StageShow, a_drop_is_seen_in_light_or_colour) {
    Expected<Renderer> renderer = Renderer::create(build_mannequin(), {.quality = Quality::fast});
    ASSERT_TRUE(renderer);
    for (const auto& [name, theme] : shipped_themes()) {
        if (!theme.is_listed) {
            continue;
        }
        const auto [breakdown, drop] = seen(*renderer, theme, Liveliness::usual);
        const double ratio = drop.luma / breakdown.luma;
        const double difference = difference_of(lab_of(breakdown.light), lab_of(drop.light));
        EXPECT_TRUE(ratio >= 1.5 || difference >= 12.0) << name;
        const auto [calm_breakdown, calm_drop] = seen(*renderer, theme, Liveliness::calm);
        EXPECT_LT(calm_drop.luma / calm_breakdown.luma, ratio) << name;
        std::cout << name << ": drop / breakdown " << ratio << ", CIEDE2000 " << difference
                  << "; calm " << calm_drop.luma / calm_breakdown.luma << "\n";
    }
}

TEST_F(StageShow, each_kind_of_tile_swells_once_in_four_beats) {
    Scene scene;
    scene.theme = &shipped_theme("dance_floor");
    scene.beat.confidence = 1.0F;
    for (std::size_t kind = 0; kind < 4; ++kind) {
        int swells = 0;
        float last = 1.0F;
        bool is_rising = false;
        for (int i = 0; i < 1600; ++i) {
            scene.beat.position = 0.01F * static_cast<float>(i);
            const float level = tile_levels(scene)[kind];
            EXPECT_GE(level, scene.theme->tiles.glow);
            EXPECT_LE(level, 1.0F);
            if (level > last + 1e-4F && !is_rising) {
                ++swells;
                is_rising = true;
            } else if (level < last) {
                is_rising = false;
            }
            last = level;
        }
        EXPECT_LE(swells, 5) << "in 16 beats";
        EXPECT_GE(swells, 3) << kind;
    }
}

TEST_F(StageShow, beams_end_on_the_floor_near_the_dancers) {
    Scene scene;
    scene.theme = &shipped_theme("club");
    for (int lamp = 0; lamp < scene.theme->beams.count; ++lamp) {
        for (float beat = 0.0F; beat < 16.0F; beat += 0.5F) {
            scene.beat.position = beat;
            const Beam beam = beam_at(scene, lamp);
            EXPECT_EQ(beam.end.y, 0.0F);
            EXPECT_LT(std::hypot(beam.end.x, beam.end.z), 4.6F);
            EXPECT_GT(beam.lamp.y, 3.0F);
            EXPECT_GE(beam.brightness, 0.0F);
            EXPECT_LE(beam.brightness, 1.0F);
        }
    }
}

}  // namespace
}  // namespace raks::render
