#include "render/overlay/picture_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace raks::render {
namespace {

constexpr int kLineWidth = 200;
constexpr int kLineHeight = 40;

/// A grey picture with a line on it.
std::vector<std::uint8_t> written(const std::string& line, int x, int y, std::uint32_t rgb) {
    std::vector<std::uint8_t> rgba(4 * kLineWidth * kLineHeight, 100);
    PictureText(16.0F).write({rgba, kLineWidth, kLineHeight}, x, y, rgb, line);
    return rgba;
}

/// Columns from the first to behind the last pixel that was written on.
std::pair<int, int> extent(const std::vector<std::uint8_t>& rgba) {
    int first = kLineWidth;
    int end = 0;
    for (int i = 0; i < kLineWidth * kLineHeight; ++i) {
        if (rgba[4 * static_cast<std::size_t>(i)] != 100) {
            first = std::min(first, i % kLineWidth);
            end = std::max(end, i % kLineWidth + 1);
        }
    }
    return {first, end};
}

TEST(PictureText, lines_begin_where_they_are_asked_to_and_are_as_wide_as_said) {
    const PictureText text(16.0F);
    for (const std::string line : {"basic", "\xc3\xa9t\xc3\xa9 \xe2\x80\x93 8", "HHHH"}) {
        const auto [first, end] = extent(written(line, 30, 8, 0xFFFFFF));
        EXPECT_NEAR(first, 31, 2) << line;
        EXPECT_NEAR(static_cast<float>(end), 30.0F + text.width_of(line), 3.0F) << line;
    }
    EXPECT_EQ(text.width_of(""), 0.0F);
}

TEST(PictureText, the_colour_is_that_which_was_given_and_alpha_stays) {
    const auto rgba = written("HHHH", 10, 10, 0xFF8000);
    const auto brightest = [&](std::size_t channel) {
        int most = 0;
        int least = 255;
        for (std::size_t i = channel; i < rgba.size(); i += 4) {
            most = std::max<int>(most, rgba[i]);
            least = std::min<int>(least, rgba[i]);
        }
        return std::pair{least, most};
    };
    EXPECT_GT(brightest(0).second, 240);
    EXPECT_LT(brightest(2).first, 15);
    EXPECT_EQ(brightest(3), std::pair(100, 100));
}

TEST(PictureText, what_lies_outside_is_left_out_and_odd_bytes_do_no_harm) {
    for (const auto& [x, y] : {std::pair{-50, 10},
                               std::pair{190, 10},
                               std::pair{10, -8},
                               std::pair{10, 36},
                               std::pair{-10'000, -10'000},
                               std::pair{10'000, 10'000}}) {
        (void)written("\xFF\xC3 text \xF0\x9F\x92\x83 \n\t", x, y, 0xFFFFFF);
    }
    EXPECT_EQ(written("", 5, 5, 0), std::vector<std::uint8_t>(4 * kLineWidth * kLineHeight, 100));
}

}  // namespace
}  // namespace raks::render
