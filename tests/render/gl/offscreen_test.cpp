// Contexts and targets without a window or a display server.
#include "tests/render/gl/pictures.hpp"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "render/gl/shader_program.hpp"

namespace raks::render {
namespace {

class Offscreen : public OffscreenTest {};

void clear_to(const FrameTarget& frame, float red, float green, float blue) {
    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    glClearColor(red, green, blue, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
}

TEST_F(Offscreen, context_has_opengl_33_and_says_who_draws) {
    EXPECT_GE(epoxy_gl_version(), 33);
    EXPECT_NE(context().renderer_name().find("llvmpipe"), std::string::npos)
        << context().renderer_name();
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(Offscreen, two_contexts_can_take_turns) {
    Expected<OffscreenContext> other = OffscreenContext::create();
    ASSERT_TRUE(other.has_value());
    for (int turn = 0; turn < 3; ++turn) {
        for (OffscreenContext* current : {&context(), &other.value()}) {
            ASSERT_TRUE(current->make_current().has_value());
            OffscreenTarget target = make_target(4, 4);
            clear_to(target.frame(), 1.0F, 0.0F, 0.0F);
            EXPECT_EQ(read_picture(target).pixel(0, 0)[0], 255);
        }
    }
}

TEST_F(Offscreen, pictures_are_read_with_the_top_row_first) {
    OffscreenTarget target = make_target(8, 6);
    clear_to(target.frame(), 0.0F, 0.0F, 1.0F);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 5, 8, 1);  // OpenGL's uppermost row
    clear_to(target.frame(), 1.0F, 0.0F, 0.0F);
    glDisable(GL_SCISSOR_TEST);
    const Picture picture = read_picture(target);
    EXPECT_EQ(picture.pixel(3, 0)[0], 255);
    EXPECT_EQ(picture.pixel(3, 0)[2], 0);
    EXPECT_EQ(picture.pixel(3, 1)[2], 255);
    EXPECT_EQ(picture.pixel(3, 5)[2], 255);
    EXPECT_EQ(picture.pixel(7, 5)[3], 255);
}

TEST_F(Offscreen, multisampled_targets_read_back_as_well) {
    for (const int samples : {1, 2, 4}) {
        OffscreenTarget target = make_target(33, 17, samples);
        EXPECT_GE(target.samples(), samples > 1 ? 2 : 1);
        clear_to(target.frame(), 0.0F, 1.0F, 0.0F);
        const Picture picture = read_picture(target);
        EXPECT_EQ(picture.pixel(32, 16)[1], 255) << samples;
    }
}

TEST_F(Offscreen, sizes_out_of_range_are_refused_with_the_range) {
    struct Row {
        int width;
        int height;
        int samples;
        const char* says;
    };
    constexpr std::array<Row, 7> kRows = {{
        {0, 720, 1, "picture size 0x720 is out of range, each side must be 1 to 8192"},
        {1280, 0, 1, "picture size 1280x0"},
        {-5, 720, 1, "picture size -5x720"},
        {8193, 10, 1, "picture size 8193x10"},
        {2'147'483'647, 2'147'483'647, 4, "picture size 2147483647x2147483647"},
        {64, 64, 0, "samples a pixel are 0, must be 1 to 4"},
        {64, 64, 99, "samples a pixel are 99, must be 1 to 4"},
    }};
    for (const Row& row : kRows) {
        const Expected<OffscreenTarget> target = OffscreenTarget::create(
            {.width = row.width, .height = row.height, .samples = row.samples});
        ASSERT_FALSE(target.has_value()) << row.says;
        EXPECT_EQ(target.error().message.find(row.says), 0U) << target.error().message;
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    }
}

TEST_F(Offscreen, reading_into_a_buffer_of_the_wrong_size_is_an_error) {
    OffscreenTarget target = make_target(10, 10);
    std::vector<std::uint8_t> bytes(399);
    EXPECT_EQ(target.read_rgba(bytes).error().message,
              "reading back a picture needs 400 bytes, got 399");
    EXPECT_FALSE(read_rgba(FrameTarget{}, bytes).has_value());
}

TEST_F(Offscreen, a_broken_shader_is_named_in_the_error) {
    constexpr std::array<std::string_view, 1> kVertex = {"skin.glsl"};  // has no main()
    constexpr std::array<std::string_view, 1> kFragment = {"depth.frag"};
    const auto broken = gl::Program::build({"half a shader", kVertex, kFragment, {}});
    ASSERT_FALSE(broken.has_value());
    EXPECT_EQ(broken.error().message.find("shader half a shader: "), 0U);
    EXPECT_EQ(broken.error().message.find('\n'), std::string::npos);

    constexpr std::array<std::string_view, 1> kMissing = {"nothing.vert"};
    const auto missing = gl::Program::build({"none", kMissing, kFragment, {}});
    EXPECT_EQ(missing.error().message, "shader none: shader file nothing.vert is not built in");
}

TEST_F(Offscreen, a_picture_that_is_read_while_others_are_drawn_is_the_one_before) {
    for (const int samples : {1, 4}) {
        OffscreenTarget target = make_target(7, 5, samples);
        std::vector<std::uint8_t> rgba(7 * 5 * 4);
        EXPECT_FALSE(target.finish_reading(rgba)) << "nothing was read";
        for (int i = 1; i <= 3; ++i) {
            glBindFramebuffer(GL_FRAMEBUFFER, target.frame().framebuffer);
            glClearColor(static_cast<float>(i) / 255.0F, 0.0F, 1.0F, 0.0F);
            glClear(GL_COLOR_BUFFER_BIT);
            // The upper left pixel is another.
            glEnable(GL_SCISSOR_TEST);
            glScissor(0, 4, 1, 1);
            glClearColor(1.0F, 1.0F, 1.0F, 1.0F);
            glClear(GL_COLOR_BUFFER_BIT);
            glDisable(GL_SCISSOR_TEST);
            target.begin_reading();
            glClearColor(0.5F, 0.5F, 0.5F, 0.5F);
            glClear(GL_COLOR_BUFFER_BIT);
            ASSERT_TRUE(target.finish_reading(rgba));
            EXPECT_EQ(rgba[0], 255);
            EXPECT_EQ(rgba[4], i);
            EXPECT_EQ(rgba[6], 255);
            EXPECT_EQ(rgba[7], 0);
        }
        rgba.pop_back();
        EXPECT_FALSE(target.finish_reading(rgba));
    }
}

TEST_F(Offscreen, a_picture_is_copied_into_a_part_of_another) {
    for (const int samples : {1, 4}) {
        auto from = OffscreenTarget::create({.width = 3, .height = 2, .samples = samples});
        auto to = OffscreenTarget::create({.width = 8, .height = 6});
        ASSERT_TRUE(from && to);
        const auto clear = [](const OffscreenTarget& target, float red) {
            glBindFramebuffer(GL_FRAMEBUFFER, target.frame().framebuffer);
            glClearColor(red, 0.0F, 0.0F, 1.0F);
            glClear(GL_COLOR_BUFFER_BIT);
        };
        clear(*from, 1.0F);
        clear(*to, 0.0F);
        from->copy_to({to->frame().framebuffer, 4, 1, 3, 2});
        std::vector<std::uint8_t> rgba(8 * 6 * 4);
        ASSERT_TRUE(to->read_rgba(rgba));
        for (std::size_t y = 0; y < 6; ++y) {
            for (std::size_t x = 0; x < 8; ++x) {
                // Rows are counted from the top, and the part from the lower edge.
                const bool is_copied = x >= 4 && x < 7 && y >= 3 && y < 5;
                EXPECT_EQ(rgba[(y * 8 + x) * 4], is_copied ? 255 : 0) << x << " " << y;
            }
        }
    }
}

}  // namespace
}  // namespace raks::render
