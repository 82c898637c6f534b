#pragma once

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "render/gl/offscreen.hpp"
#include "render/overlay/overlay.hpp"

/// Pictures of overlays.
namespace raks::render::test {

inline constexpr int kPictureWidth = 640;
inline constexpr int kPictureHeight = 360;
inline constexpr std::array<std::uint8_t, 3> kBehind = {40, 60, 120};

inline OverlayState locked_state() {
    OverlayState state;
    state.bpm = 184.2;
    state.confidence = 0.92F;
    state.bar_position = 2.05;
    state.genre = "salsa";
    state.genre_posterior = 0.87F;
    state.figure = "basic step";
    state.figure_count = 3;
    state.source = "song.flac";
    state.level_dbfs = -14.0F;
    state.loudness_lufs = -13.0F;
    state.position = 83.0;
    state.duration = 272.0;
    state.latency_ms = 42.0;
    state.fps = 60.0;
    state.volume = 1.0F;
    state.has_keys = true;
    return state;
}

/// As many as the program has.
inline std::vector<HelpRow> many_keys() {
    std::vector<HelpRow> rows;
    for (const auto& [group, count] : {std::pair{"PLAYING", 7},
                                       std::pair{"TEMPO", 8},
                                       std::pair{"DANCE", 5},
                                       std::pair{"VIEW", 5},
                                       std::pair{"WINDOW", 4}}) {
        for (int i = 0; i < count; ++i) {
            rows.push_back({group, {"Shift+Left", "Shift+Right"}, "hide, show this overlay"});
        }
    }
    return rows;
}

struct Pixels {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;

    [[nodiscard]] bool is_behind(int x, int y) const {
        const std::size_t i = (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x)) *
                              4;
        return rgba[i] == kBehind[0] && rgba[i + 1] == kBehind[1] && rgba[i + 2] == kBehind[2];
    }
    /// Share of the pixels of a rectangle (fractions of the picture) that were drawn on.
    [[nodiscard]] double drawn(double left, double top, double right, double bottom) const {
        int drawn = 0;
        int all = 0;
        for (int y = static_cast<int>(top * height); y < static_cast<int>(bottom * height); ++y) {
            for (int x = static_cast<int>(left * width); x < static_cast<int>(right * width); ++x) {
                drawn += is_behind(x, y) ? 0 : 1;
                ++all;
            }
        }
        return static_cast<double>(drawn) / all;
    }
    friend bool operator==(const Pixels&, const Pixels&) = default;
};

/// An overlay over a plain colour, off screen.
class OverlayFixture : public testing::Test {
 protected:
    void SetUp() override {
        setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);  // NOLINT(concurrency-mt-unsafe): one thread yet
        auto context = OffscreenContext::create();
        ASSERT_TRUE(context) << context.error().message;
        context_.emplace(std::move(*context));
        auto overlay = Overlay::create();
        ASSERT_TRUE(overlay) << overlay.error().message;
        overlay_.emplace(std::move(*overlay));
    }

    Pixels draw(const OverlayState& state,
                OverlayView view = OverlayView::shown,
                int width = kPictureWidth,
                int height = kPictureHeight,
                float content_scale = 1.0F) {
        auto target = OffscreenTarget::create({.width = width, .height = height});
        EXPECT_TRUE(target) << target.error().message;
        clear(*target);
        overlay_->draw(state, view, target->frame(), content_scale);
        EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
        return read(*target);
    }

    /// Where a pointer can use what is drawn.
    OverlayControls controls_of(const OverlayState& state, int width, int height) {
        auto target = OffscreenTarget::create({.width = width, .height = height});
        EXPECT_TRUE(target) << target.error().message;
        OverlayControls controls = overlay_->draw(state, OverlayView::hidden, target->frame());
        EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
        return controls;
    }

    static void clear(const OffscreenTarget& target) {
        glBindFramebuffer(GL_FRAMEBUFFER, target.frame().framebuffer);
        glClearColor(40.0F / 255.0F, 60.0F / 255.0F, 120.0F / 255.0F, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
    }

    static Pixels read(OffscreenTarget& target) {
        Pixels pixels{target.width(), target.height(), {}};
        pixels.rgba.resize(static_cast<std::size_t>(target.width()) *
                           static_cast<std::size_t>(target.height()) * 4);
        EXPECT_TRUE(target.read_rgba(pixels.rgba));
        return pixels;
    }

    std::optional<OffscreenContext> context_;
    std::optional<Overlay> overlay_;  // goes before its context
};

}  // namespace raks::render::test
