#include "render/overlay/overlay.hpp"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "tests/render/overlay/overlay_fixture.hpp"

namespace raks::render {
namespace {

using test::kPictureHeight;
using test::kPictureWidth;
using test::locked_state;
using test::many_keys;
using test::Pixels;

class OverlayTest : public test::OverlayFixture {};

TEST_F(OverlayTest, cards_stand_in_the_corners_and_leave_the_dancer_free) {
    for (const auto& [width, height] : {std::pair{640, 360}, std::pair{1280, 720}}) {
        const Pixels pixels = draw(locked_state(), OverlayView::shown, width, height);
        EXPECT_GT(pixels.drawn(0.03, 0.06, 0.15, 0.21), 0.99) << width;  // tempo
        EXPECT_GT(pixels.drawn(0.85, 0.06, 0.97, 0.21), 0.99) << width;  // dance
        EXPECT_GT(pixels.drawn(0.03, 0.88, 0.30, 0.94), 0.99) << width;  // source
        EXPECT_GT(pixels.drawn(0.85, 0.88, 0.97, 0.94), 0.99) << width;  // level
        EXPECT_EQ(pixels.drawn(0.38, 0.00, 0.70, 1.00), 0.0) << width;   // head to feet
    }
}

TEST_F(OverlayTest, the_same_state_draws_the_same_picture) {
    const Pixels first = draw(locked_state());
    OverlayState other = locked_state();
    other.bpm = 90.0;
    EXPECT_NE(draw(other), first);
    EXPECT_EQ(draw(locked_state()), first);
    (void)draw(locked_state(), OverlayView::shown, 1280, 720);  // makes the fonts anew
    EXPECT_EQ(draw(locked_state()), first);
}

TEST_F(OverlayTest, hidden_shows_nothing_but_the_message) {
    OverlayState state = locked_state();
    EXPECT_EQ(draw(state, OverlayView::hidden).drawn(0, 0, 1, 1), 0.0);
    state.message = "screenshot saved";
    EXPECT_GT(draw(state, OverlayView::hidden).drawn(0, 0, 1, 1), 0.0);
}

TEST_F(OverlayTest, every_field_is_seen) {
    const Pixels usual = draw(locked_state());
    const auto differs = [&](const char* what, auto change) {
        OverlayState state = locked_state();
        change(state);
        EXPECT_NE(draw(state), usual) << what;
    };
    differs("bpm", [](auto& s) { s.bpm = 183.9; });
    differs("confidence", [](auto& s) { s.confidence = 0.5F; });
    differs("lock", [](auto& s) { s.confidence = 0.1F; });
    differs("beat", [](auto& s) { s.bar_position = 3.05; });
    differs("phase", [](auto& s) { s.bar_position = 2.3; });
    differs("meter", [](auto& s) { s.beats_per_bar = 3; });
    differs("bar unknown", [](auto& s) { s.is_bar_known = false; });
    differs("silence", [](auto& s) { s.is_silent = true; });
    differs("genre", [](auto& s) { s.genre = "waltz"; });
    differs("posterior", [](auto& s) { s.genre_posterior = 0.5F; });
    differs("figure", [](auto& s) { s.figure = "turn"; });
    differs("count", [](auto& s) { s.figure_count = 4; });
    differs("source", [](auto& s) { s.source = "other.flac"; });
    static const std::vector<OverlayTarget> kTold{{"--osc studio:9000   41 sent", false}};
    static const std::vector<OverlayTarget> kLost{{"--osc studio:9000   41 sent", true}};
    differs("song of a player", [](auto& s) { s.song = "Quimbara (Celia Cruz)"; });
    differs("target", [](auto& s) { s.targets = kTold; });
    differs("target in trouble", [](auto& s) { s.targets = kLost; });
    differs("level", [](auto& s) { s.level_dbfs = -30.0F; });
    differs("loudness", [](auto& s) { s.loudness_lufs = -20.0F; });
    differs("volume", [](auto& s) { s.volume = 0.5F; });
    differs("no volume", [](auto& s) { s.volume.reset(); });
    differs("no keys", [](auto& s) { s.has_keys = false; });
    differs("position", [](auto& s) { s.position = 120.0; });
    differs("duration", [](auto& s) { s.duration = 300.0; });
    differs("live", [](auto& s) { s.position.reset(); });
    differs("pause", [](auto& s) { s.is_paused = true; });
    differs("latency", [](auto& s) { s.latency_ms = 99.0; });
    differs("fps", [](auto& s) { s.fps = 24.0; });
    differs("drops", [](auto& s) { s.drops = 1; });
    differs("xruns", [](auto& s) { s.xruns = 1; });
    differs("late", [](auto& s) { s.late = 1; });
    differs("message", [](auto& s) { s.message = "hello"; });
}

TEST_F(OverlayTest, silence_takes_the_dance_of_the_music_off) {
    OverlayState silent = locked_state();
    silent.is_silent = true;
    const Pixels picture = draw(silent);
    silent.genre = "waltz";
    silent.genre_posterior = 0.1F;
    EXPECT_EQ(draw(silent), picture);
}

TEST_F(OverlayTest, a_small_picture_has_the_tempo_alone_and_its_dancer_free) {
    for (const auto& [width, height] : {std::pair{320, 180}, std::pair{200, 200}}) {
        const Pixels pixels = draw(locked_state(), OverlayView::shown, width, height);
        EXPECT_EQ(pixels.drawn(0.35, 0.15, 1.0, 1.0), 0.0) << width;
        EXPECT_GT(pixels.drawn(0.04, 0.05, 0.15, 0.10), 0.9) << width;
    }
}

TEST_F(OverlayTest, says_where_its_controls_are) {
    auto target = OffscreenTarget::create({.width = 1280, .height = 720});
    ASSERT_TRUE(target);
    const OverlayControls controls =
        overlay_->draw(locked_state(), OverlayView::shown, target->frame());
    EXPECT_EQ(controls.at(48.0F, 658.0F), OverlayControl::play_sign);
    EXPECT_EQ(controls.at(200.0F, 660.0F), OverlayControl::position);
    EXPECT_EQ(controls.at(640.0F, 300.0F), std::nullopt);
    EXPECT_EQ(controls.share_at(controls.from), 0.0);
    EXPECT_EQ(controls.share_at(controls.to), 1.0);
    EXPECT_EQ(controls.share_at(-1e9F), 0.0);
    EXPECT_NEAR(controls.share_at((controls.from + controls.to) / 2.0F), 0.5, 1e-6);
    OverlayState live = locked_state();
    live.position.reset();
    live.duration.reset();
    const OverlayControls none = overlay_->draw(live, OverlayView::shown, target->frame());
    EXPECT_EQ(none.at(48.0F, 658.0F), std::nullopt);
    EXPECT_EQ(none.at(200.0F, 660.0F), std::nullopt);
    EXPECT_EQ(none.share_at(300.0F), 0.0);
    const OverlayControls hidden =
        overlay_->draw(locked_state(), OverlayView::hidden, target->frame());
    EXPECT_EQ(hidden.at(48.0F, 658.0F), std::nullopt);
}

TEST_F(OverlayTest, the_bar_of_a_clip_can_be_clicked) {
    auto target = OffscreenTarget::create({.width = 1280, .height = 720});
    ASSERT_TRUE(target);
    OverlayState state;
    const std::vector<float> curve(101, 0.5F);
    OverlayTransport transport;
    transport.frame = 50;
    transport.frame_count = 101;
    transport.curve = curve;
    transport.mark = 25;
    transport.mark_name = "worst";
    state.transport = transport;
    // It stays where the cards are hidden.
    const OverlayControls controls = overlay_->draw(state, OverlayView::hidden, target->frame());
    const auto middle_of = [](const OverlayControls::Area& area) {
        return std::pair{(area.left + area.right) / 2.0F, (area.top + area.bottom) / 2.0F};
    };
    for (const auto& [area, control] : {std::pair{controls.play_sign, OverlayControl::play_sign},
                                        std::pair{controls.position, OverlayControl::position},
                                        std::pair{controls.mark, OverlayControl::mark},
                                        std::pair{controls.help, OverlayControl::help}}) {
        const auto [x, y] = middle_of(area);
        EXPECT_EQ(controls.at(x, y), control);
    }
    EXPECT_EQ(controls.share_at(controls.to), 1.0);
    EXPECT_EQ(controls.at(640.0F, 300.0F), std::nullopt);
    state.transport->mark.reset();
    const OverlayControls plain = overlay_->draw(state, OverlayView::hidden, target->frame());
    const auto [x, y] = middle_of(controls.mark);
    EXPECT_EQ(plain.at(x, y), std::nullopt);
}

TEST_F(OverlayTest, names_that_would_cover_each_other_are_left_out) {
    OverlayState state;
    const std::vector<OverlayLabel> one = {{200.0F, 200.0F, "knee"}};
    state.labels = one;
    const Pixels alone = draw(state, OverlayView::hidden);
    const std::vector<OverlayLabel> two = {{200.0F, 200.0F, "knee"}, {203.0F, 201.0F, "ankle"}};
    state.labels = two;
    EXPECT_EQ(draw(state, OverlayView::hidden), alone);
    const std::vector<OverlayLabel> apart = {{200.0F, 200.0F, "knee"}, {203.0F, 240.0F, "ankle"}};
    state.labels = apart;
    EXPECT_NE(draw(state, OverlayView::hidden), alone);
    const std::vector<OverlayLine> lines = {{10.0F, 10.0F, 90.0F, 90.0F, 0xFFFFFF, 1.0F}};
    state.labels = {};
    state.lines = lines;
    EXPECT_GT(draw(state, OverlayView::hidden).drawn(0.0, 0.0, 0.1, 0.15), 0.0);
}

TEST_F(OverlayTest, a_beat_is_brightest_when_it_sounds) {
    const auto light = [&](double bar_position) {
        OverlayState state = locked_state();
        state.bar_position = bar_position;
        const Pixels pixels = draw(state);
        long sum = 0;
        for (std::size_t i = 0; i < pixels.rgba.size(); i += 4) {
            sum += pixels.rgba[i + 1];
        }
        return sum;
    };
    EXPECT_GT(light(1.0), light(1.2));
    EXPECT_GT(light(1.2), light(1.5));
    EXPECT_GT(light(1.5), light(1.9));
}

TEST_F(OverlayTest, the_sign_shows_what_a_click_does) {
    OverlayState state = locked_state();
    const auto sign_of = [&](bool is_paused) {
        state.is_paused = is_paused;
        return draw(state, OverlayView::shown, 1280, 720);
    };
    // Between the two bars of the pause the card lies open; the triangle covers that place.
    constexpr double kMiddle = 48.0 / 1280.0;
    constexpr double kHeightOfSign = 658.0 / 720.0;
    const auto brightness = [&](const Pixels& pixels) {
        const auto x = static_cast<std::size_t>(kMiddle * pixels.width);
        const auto y = static_cast<std::size_t>(kHeightOfSign * pixels.height);
        return int{pixels.rgba[(y * static_cast<std::size_t>(pixels.width) + x) * 4]};
    };
    EXPECT_LT(brightness(sign_of(false)), 100) << "bars while it plays";
    EXPECT_GT(brightness(sign_of(true)), 200) << "a triangle while it stands";
}

TEST_F(OverlayTest, odd_values_draw_without_harm) {
    const std::string long_name(10'000, 'x');
    const double nan = std::nan("");
    const float nanf = std::nanf("");
    OverlayState state;
    state.bpm = nan;
    state.confidence = nanf;
    state.bar_position = nan;
    state.beats_per_bar = -3;
    state.genre = long_name;
    state.genre_posterior = nanf;
    state.figure = "\xFF\xFE\x80 broken";
    state.figure_count = 1000;
    state.figure_counts = 0;
    state.source = long_name;
    state.level_dbfs = nanf;
    state.loudness_lufs = std::numeric_limits<float>::infinity();
    state.volume = nanf;
    state.position = nan;
    state.duration = nan;
    state.latency_ms = 1e30;
    state.fps = 1e30;
    state.drops = state.xruns = state.late = ~std::uint64_t{0};
    state.message = long_name;
    const std::vector<HelpRow> rows(100, {"", {long_name, ""}, long_name});
    for (const auto& [width, height] : {std::pair{1, 1},
                                        std::pair{16, 900},
                                        std::pair{900, 16},
                                        std::pair{720, 1280},
                                        std::pair{4000, 200}}) {
        for (const float content_scale : {1.0F, 2.0F, 100.0F}) {
            (void)draw(state, OverlayView::shown, width, height, content_scale);
            state.help = rows;
            (void)draw(state, OverlayView::shown, width, height, content_scale);
            state.help = {};
        }
    }
    state.help = rows;
    overlay_->draw(state, OverlayView::shown, FrameTarget{});  // a minimised window
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

TEST_F(OverlayTest, state_of_opengl_is_put_back) {
    auto target = OffscreenTarget::create({.width = kPictureWidth, .height = kPictureHeight});
    auto other = OffscreenTarget::create({.width = 8, .height = 8});
    ASSERT_TRUE(target && other);
    glBindFramebuffer(GL_FRAMEBUFFER, other->frame().framebuffer);
    glViewport(1, 2, 3, 4);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glEnable(GL_CULL_FACE);
    overlay_->draw(locked_state(), OverlayView::shown, target->frame());
    GLint bound = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    EXPECT_EQ(static_cast<std::uint32_t>(bound), other->frame().framebuffer);
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    EXPECT_EQ(viewport, (std::array<GLint, 4>{1, 2, 3, 4}));
    EXPECT_EQ(glIsEnabled(GL_DEPTH_TEST), GL_TRUE);
    EXPECT_EQ(glIsEnabled(GL_BLEND), GL_FALSE);
    EXPECT_EQ(glIsEnabled(GL_CULL_FACE), GL_TRUE);
}

TEST_F(OverlayTest, a_part_of_a_target_gets_the_same_picture_and_nothing_lies_outside) {
    const Pixels whole = draw(locked_state());
    auto target =
        OffscreenTarget::create({.width = kPictureWidth + 30, .height = kPictureHeight + 20});
    ASSERT_TRUE(target);
    clear(*target);
    FrameTarget part = target->frame();
    part.x = 10;
    part.y = 15;  // from below: 5 rows are left above
    part.width = kPictureWidth;
    part.height = kPictureHeight;
    overlay_->draw(locked_state(), OverlayView::shown, part);
    const Pixels pixels = read(*target);
    for (int y = 0; y < kPictureHeight + 20; ++y) {
        for (int x = 0; x < kPictureWidth + 30; ++x) {
            const bool is_inside =
                x >= 10 && x < 10 + kPictureWidth && y >= 5 && y < 5 + kPictureHeight;
            const bool expected = is_inside ? whole.is_behind(x - 10, y - 5) : true;
            ASSERT_EQ(pixels.is_behind(x, y), expected) << x << " " << y;
        }
    }
}

TEST_F(OverlayTest, two_overlays_do_not_disturb_each_other) {
    const Pixels first = draw(locked_state());
    auto second = Overlay::create();
    ASSERT_TRUE(second);
    auto target = OffscreenTarget::create({.width = 320, .height = 200});
    const std::vector<HelpRow> rows = many_keys();
    OverlayState state = locked_state();
    state.help = rows;
    second->draw(state, OverlayView::shown, target->frame());
    EXPECT_EQ(draw(locked_state()), first);
    *second = std::move(*overlay_);  // the moved one still draws
    overlay_.emplace(std::move(*second));
    EXPECT_EQ(draw(locked_state()), first);
}

TEST_F(OverlayTest, no_settings_file_is_written) {
    (void)draw(locked_state());
    overlay_.reset();
    EXPECT_FALSE(std::filesystem::exists("imgui.ini"));
}

}  // namespace
}  // namespace raks::render
