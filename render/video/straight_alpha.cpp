#include "render/video/straight_alpha.hpp"

#include <algorithm>

namespace raks::render {
namespace {

constexpr unsigned kOpaque = 255;
// From this alpha on a pixel's own colour is exact enough to be kept.
constexpr unsigned kHardlyCovered = 32;

/// Rounded; premultiplied colours do not exceed alpha, but for rounding.
std::uint8_t divided(unsigned colour, unsigned alpha) {
    return static_cast<std::uint8_t>(std::min(kOpaque, (colour * kOpaque + alpha / 2) / alpha));
}

std::uint8_t shown(float sum, float alpha) {
    constexpr float kMost = 255.0F;
    return static_cast<std::uint8_t>(std::min(kMost, kMost * sum / alpha + 0.5F));
}

}  // namespace

void make_straight(std::span<std::uint8_t> rgba) noexcept {
    for (std::size_t i = 0; i + 4 <= rgba.size(); i += 4) {
        const unsigned alpha = rgba[i + 3];
        if (alpha != kOpaque) {
            for (std::size_t c = i; c < i + 3; ++c) {
                rgba[c] = alpha == 0 ? std::uint8_t{0} : divided(rgba[c], alpha);
            }
        }
    }
}

EdgeColours::EdgeColours(int width, int height)
    : width_(static_cast<std::size_t>(width)), height_(static_cast<std::size_t>(height)) {
    std::size_t across = width_;
    std::size_t down = height_;
    do {
        across = (across + 1) / 2;
        down = (down + 1) / 2;
        levels_.push_back({across, down, std::vector<Square>(across * down)});
    } while (across > 1 || down > 1);
}

// Each square is the sum of the four that it holds.
void EdgeColours::sum_up(std::span<const std::uint8_t> rgba) {
    for (Level& level : levels_) {
        std::fill(level.squares.begin(), level.squares.end(), Square());
    }
    Level& finest = levels_.front();
    for (std::size_t y = 0; y < height_; ++y) {
        for (std::size_t x = 0; x < width_; ++x) {
            const std::uint8_t* const pixel = &rgba[(y * width_ + x) * 4];
            Square& square = finest.squares[y / 2 * finest.width + x / 2];
            square.red += static_cast<float>(pixel[0]);
            square.green += static_cast<float>(pixel[1]);
            square.blue += static_cast<float>(pixel[2]);
            square.alpha += static_cast<float>(pixel[3]);
        }
    }
    for (std::size_t i = 1; i < levels_.size(); ++i) {
        const Level& fine = levels_[i - 1];
        Level& coarse = levels_[i];
        for (std::size_t y = 0; y < fine.height; ++y) {
            for (std::size_t x = 0; x < fine.width; ++x) {
                const Square& from = fine.squares[y * fine.width + x];
                Square& to = coarse.squares[y / 2 * coarse.width + x / 2];
                to.red += from.red;
                to.green += from.green;
                to.blue += from.blue;
                to.alpha += from.alpha;
            }
        }
    }
}

// A square without any colour takes that of the one around it.
void EdgeColours::hand_down() {
    for (std::size_t i = levels_.size() - 1; i-- > 0;) {
        Level& fine = levels_[i];
        const Level& coarse = levels_[i + 1];
        for (std::size_t y = 0; y < fine.height; ++y) {
            for (std::size_t x = 0; x < fine.width; ++x) {
                Square& square = fine.squares[y * fine.width + x];
                if (square.alpha < 1.0F) {
                    square = coarse.squares[y / 2 * coarse.width + x / 2];
                }
            }
        }
    }
}

void EdgeColours::make_straight(std::span<std::uint8_t> rgba) {
    sum_up(rgba);
    hand_down();
    const Level& finest = levels_.front();
    for (std::size_t y = 0; y < height_; ++y) {
        for (std::size_t x = 0; x < width_; ++x) {
            std::uint8_t* const pixel = &rgba[(y * width_ + x) * 4];
            const unsigned alpha = pixel[3];
            const Square& square = finest.squares[y / 2 * finest.width + x / 2];
            if (alpha >= kHardlyCovered) {
                render::make_straight({pixel, 4});
            } else if (square.alpha >= 1.0F) {
                pixel[0] = shown(square.red, square.alpha);
                pixel[1] = shown(square.green, square.alpha);
                pixel[2] = shown(square.blue, square.alpha);
            }
        }
    }
}

}  // namespace raks::render
