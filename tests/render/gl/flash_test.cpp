// What the music does to whole pictures: it must not flash.
#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "base/random.hpp"
#include "render/mannequin/mannequin.hpp"
#include "render/renderer.hpp"
#include "render/scene/director.hpp"
#include "render/scene/light_show.hpp"
#include "tests/render/gl/flash_meter.hpp"
#include "tests/render/scene/shipped_themes.hpp"
#include "tests/render/scene/staged_music.hpp"

namespace raks::render {
namespace {

constexpr int kFlashRate = 25;
constexpr int kFlashSide = 48;

TEST(FlashMeter, counts_flashes_and_the_area_that_they_take) {
    FlashMeter fast(kFlashRate);
    FlashMeter slow(kFlashRate);
    FlashMeter red(kFlashRate);
    for (int i = 0; i < 50; ++i) {
        Picture picture{10, 10, std::vector<std::uint8_t>(400, 40)};
        const bool is_on = i / 2 % 2 == 0;  // 6.25 times a second
        for (std::size_t pixel = 0; pixel < 30; ++pixel) {
            picture.rgba[4 * pixel + 1] = is_on ? 200 : 40;
        }
        fast.add(picture);
        for (std::size_t pixel = 0; pixel < 30; ++pixel) {
            picture.rgba[4 * pixel + 1] = i / 5 % 2 == 0 ? 200 : 40;  // 2.5 times
        }
        slow.add(picture);
        Picture plain{10, 10, std::vector<std::uint8_t>(400, 0)};
        for (std::size_t pixel = 0; pixel < 20; ++pixel) {
            plain.rgba[4 * pixel] = is_on ? 140 : 40;  // 6 % of full brightness: not light, but red
        }
        red.add(plain);
    }
    EXPECT_DOUBLE_EQ(fast.area_above(3), 0.3);
    EXPECT_DOUBLE_EQ(slow.area_above(3), 0.0);
    EXPECT_DOUBLE_EQ(slow.area_above(1), 0.3);
    EXPECT_DOUBLE_EQ(red.area_above(3), 0.2);
}

/// 8 s of music with strong onsets in every hop, drops and changes, fast beats, and a dancer who
/// stands: whatever changes is light and camera.
class Flashes : public OffscreenTest {
 protected:
    static FlashMeter filmed(Renderer& renderer, const Theme& theme, Liveliness liveliness) {
        Director director(1, liveliness);
        director.set_picture(1.0F, 1.0F);
        LightShow light(liveliness);
        StagedMusic music{Bpm(200.0)};
        const CounterRandom random(11);
        OffscreenTarget target = make_target(kFlashSide, kFlashSide);
        FlashMeter meter(kFlashRate);
        Scene scene;
        scene.theme = &theme;
        const motion::Pose pose = standing_pose();
        const std::vector<motion::WorldPose> people = people_at({{0, 0, 0}});
        for (int hop = 0; hop < 800; ++hop) {
            const auto i = static_cast<std::uint64_t>(hop);
            music.next.accent = {.strength = 1.0F,
                                 .band = static_cast<MusicAccent::Band>(random.below(2 * i, 3))};
            music.next.energy.now = music.next.energy.lately = hop / 30 % 2 == 0 ? 1.0F : 0.0F;
            if (random.below(2 * i + 1, 40) == 0) {
                music.next.event.kind = MusicEvent::Kind::drop;
            }
            if (hop % 90 == 0) {
                music.next.part = static_cast<MusicPart>(hop / 90 % 4);
            }
            const MusicState state = music.state();
            scene.light = light.advance(state);
            scene.camera = director.advance(state, people).camera;
            if (hop % (100 / kFlashRate) == 0) {
                scene.rings = beat_rings(state.grid, state.time);
                scene.beat = stage_beat(state.grid, state.time);
                scene.seconds = to_seconds(state.time);
                renderer.draw(scene, pose, target.frame());
                meter.add(read_picture(target));
            }
        }
        return meter;
    }
};

TEST_F(Flashes, no_theme_flashes_on_a_tenth_of_the_picture_more_than_three_times_a_second) {
    Expected<Renderer> renderer = Renderer::create(build_mannequin(), {.quality = Quality::fast});
    ASSERT_TRUE(renderer);
    for (const auto& [name, theme] : shipped_themes()) {
        if (!theme.is_listed) {
            continue;  // its light hardly moves
        }
        const FlashMeter usual = filmed(*renderer, theme, Liveliness::usual);
        EXPECT_LT(usual.area_above(3), 0.1) << name;
        const FlashMeter calm = filmed(*renderer, theme, Liveliness::calm);
        EXPECT_LT(calm.area_above(2), 0.02) << name;
        EXPECT_LT(calm.area_above(1), usual.area_above(1)) << name;
        std::cout << name << ": usual above 3, 2, 1, 0 a second " << usual.area_above(3) << " "
                  << usual.area_above(2) << " " << usual.area_above(1) << " " << usual.area_above(0)
                  << ", calm " << calm.area_above(1) << " " << calm.area_above(0) << "\n";
    }
}

}  // namespace
}  // namespace raks::render
