#include "render/panes/pane_host.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "render/gl/offscreen.hpp"
#include "render/panes/pane_picture.hpp"
#include "render/panes/picture_view.hpp"
#include "render/panes/widgets.hpp"

#include <epoxy/gl.h>

namespace raks::render {
namespace {

constexpr int kPaneWidth = 320;
constexpr int kPaneHeight = 200;

class PanesOffscreen : public testing::Test {
 protected:
    void SetUp() override {
        setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);  // NOLINT(concurrency-mt-unsafe): one thread yet
        auto context = OffscreenContext::create();
        ASSERT_TRUE(context) << context.error().message;
        context_.emplace(std::move(*context));
        auto target = OffscreenTarget::create({.width = kPaneWidth, .height = kPaneHeight});
        ASSERT_TRUE(target) << target.error().message;
        target_.emplace(std::move(*target));
    }

    std::vector<std::uint8_t> drawn(PaneHost& host,
                                    const std::function<void(const PaneFrame&)>& panes) {
        const FrameTarget frame = target_->frame();
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, frame.framebuffer);
        glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
        host.draw(frame, 1.0F, {}, panes);
        std::vector<std::uint8_t> rgba(std::size_t{4} * kPaneWidth * kPaneHeight);
        EXPECT_TRUE(target_->read_rgba(rgba));
        return rgba;
    }

    static std::vector<int> pixel(const std::vector<std::uint8_t>& rgba, int x, int y) {
        const auto at = static_cast<std::size_t>(4 * (y * kPaneWidth + x));
        return {rgba[at], rgba[at + 1], rgba[at + 2]};
    }

    std::optional<OffscreenContext> context_;
    std::optional<OffscreenTarget> target_;
};

TEST_F(PanesOffscreen, a_button_is_drawn_where_it_stands_and_alike_each_time) {
    auto host = PaneHost::create();
    ASSERT_TRUE(host);
    const auto panes = [](const PaneFrame& frame) {
        EXPECT_FALSE(pane_button(frame, {40.0F, 30.0F, 120.0F, 40.0F}, "Accept"));
    };
    const auto first = drawn(*host, panes);
    EXPECT_EQ(pixel(first, 20, 50), (std::vector<int>{0, 0, 0}));
    EXPECT_NE(pixel(first, 50, 50), (std::vector<int>{0, 0, 0}));
    EXPECT_EQ(drawn(*host, panes), first);
}

TEST_F(PanesOffscreen, a_picture_has_its_pixels_where_its_place_says) {
    auto host = PaneHost::create();
    ASSERT_TRUE(host);
    // Four pixels: red, green; blue, white.
    const std::vector<std::uint8_t> rgb = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
    const PanePicture picture(2, 2, rgb);
    const PicturePlace place({10.0F, 10.0F, 200.0F, 150.0F}, 2, 2, {});
    const auto image = drawn(*host, [&](const PaneFrame& frame) {
        EXPECT_EQ(picture_view(frame, "picture", place, &picture).kind, PictureGesture::Kind::none);
    });
    const auto colour_at = [&](double u, double v) {
        const glm::vec2 at = place.in_box({u, v});
        return pixel(image, static_cast<int>(at.x), static_cast<int>(at.y));
    };
    EXPECT_EQ(colour_at(0.0, 0.0), (std::vector<int>{255, 0, 0}));
    EXPECT_EQ(colour_at(1.0, 0.0), (std::vector<int>{0, 255, 0}));
    EXPECT_EQ(colour_at(0.0, 1.0), (std::vector<int>{0, 0, 255}));
    EXPECT_EQ(colour_at(1.0, 1.0), (std::vector<int>{255, 255, 255}));
}

}  // namespace
}  // namespace raks::render
