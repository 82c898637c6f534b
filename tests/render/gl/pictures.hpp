#pragma once

#include <gtest/gtest.h>

#include "motion/skeleton/skeleton.hpp"
#include "render/gl/offscreen.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

namespace raks::render {

/// RGBA, top row first.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;

    [[nodiscard]] const std::uint8_t* pixel(int x, int y) const {
        return &rgba[4U * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(x))];
    }
    /// The same as a value.
    [[nodiscard]] std::array<std::uint8_t, 4> at(int x, int y) const {
        const std::uint8_t* const p = pixel(x, y);
        return {p[0], p[1], p[2], p[3]};
    }
    /// Mean of all colour bytes, without alpha.
    [[nodiscard]] double brightness() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < rgba.size(); i += 4) {
            sum += rgba[i] + rgba[i + 1] + rgba[i + 2];
        }
        return sum / (0.75 * static_cast<double>(rgba.size()));
    }
};

inline Picture read_picture(OffscreenTarget& target) {
    Picture picture{target.width(), target.height(), {}};
    picture.rgba.resize(static_cast<std::size_t>(target.width()) *
                        static_cast<std::size_t>(target.height()) * 4U);
    const Expected<void> read = target.read_rgba(picture.rgba);
    EXPECT_TRUE(read.has_value()) << (read ? "" : read.error().message);
    return picture;
}

inline OffscreenTarget make_target(int width, int height, int samples = 1) {
    Expected<OffscreenTarget> target =
        OffscreenTarget::create({.width = width, .height = height, .samples = samples});
    EXPECT_TRUE(target.has_value()) << (target ? "" : target.error().message);
    return std::move(target).value();
}

/// The T-pose with both soles on the floor.
inline motion::Pose standing_pose() {
    motion::Pose pose;
    pose.hips_position.y = motion::mannequin_skeleton().hips_height();
    return pose;
}

/// A fixture with an off-screen context on Mesa's software driver, the same on every machine.
class OffscreenTest : public ::testing::Test {
 protected:
    void SetUp() override {
        setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);  // NOLINT(concurrency-mt-unsafe): one thread yet
        Expected<OffscreenContext> context = OffscreenContext::create();
        ASSERT_TRUE(context.has_value()) << context.error().message;
        context_.emplace(std::move(*context));
    }

    OffscreenContext& context() { return *context_; }

 private:
    std::optional<OffscreenContext> context_;
};

}  // namespace raks::render
