// Counts flashes in pictures, as WCAG 2.2 (2.3.1, "general flash and red flash thresholds") defines
// them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/render/gl/pictures.hpp"

namespace raks::render {

/// Takes the pictures of a film of one size, in order.
class FlashMeter {
 public:
    /// Pictures a second.
    explicit FlashMeter(int rate) : rate_(rate) {}

    void add(const Picture& picture) {
        const std::size_t pixels = picture.rgba.size() / 4;
        light_.resize(pixels);
        red_.resize(pixels);
        for (std::size_t i = 0; i < pixels; ++i) {
            const std::array<float, 3> c = {linear(picture.rgba[4 * i]),
                                            linear(picture.rgba[4 * i + 1]),
                                            linear(picture.rgba[4 * i + 2])};
            const float luminance = 0.2126F * c[0] + 0.7152F * c[1] + 0.0722F * c[2];
            light_[i].add(luminance, 0.1F, true, number_);
            const float sum = c[0] + c[1] + c[2];
            const bool is_red = sum > 0.0F && c[0] / sum >= 0.8F;
            red_[i].add(std::max(0.0F, 320.0F * (c[0] - c[1] - c[2])), 20.0F, is_red, number_);
        }
        ++number_;
    }

    /// Largest share of the picture that flashes more than `flashes` times in the same second.
    [[nodiscard]] double area_above(int flashes) const {
        return std::max(area_above(light_, flashes), area_above(red_, flashes));
    }

 private:
    // One pixel: the picture numbers at which its value had changed by `least` against its last
    // extreme. Two such changes in opposite directions are a flash.
    struct Pixel {
        float extreme = -1.0F;
        int direction = 0;
        bool was_red = false;
        std::vector<int> turns;

        void add(float value, float least, bool counts, int at) {
            if (extreme < 0.0F) {
                extreme = value;
                was_red = counts;
                return;
            }
            const float change = value - extreme;
            if (direction != 0 && change * static_cast<float>(direction) > 0.0F) {
                extreme = value;  // further the same way
                was_red = counts;
                return;
            }
            // General flashes have a dark state; that of a red one may be of any colour.
            const bool is_dark = std::min(value, extreme) < 0.8F || least > 1.0F;
            if (std::abs(change) >= least && is_dark && (counts || was_red)) {
                direction = change > 0.0F ? 1 : -1;
                extreme = value;
                was_red = counts;
                turns.push_back(at);
            }
        }
    };

    static float linear(std::uint8_t byte) {
        const float c = static_cast<float>(byte) / 255.0F;
        return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
    }

    [[nodiscard]] double area_above(const std::vector<Pixel>& pixels, int flashes) const {
        std::size_t most = 0;
        for (int begin = 0; begin < number_; ++begin) {
            const auto flashing =
                std::count_if(pixels.begin(), pixels.end(), [&](const Pixel& pixel) {
                    const auto turns =
                        std::count_if(pixel.turns.begin(), pixel.turns.end(), [&](int turn) {
                            return turn >= begin && turn < begin + rate_;
                        });
                    return turns / 2 > flashes;
                });
            most = std::max(most, static_cast<std::size_t>(flashing));
        }
        return pixels.empty() ? 0.0
                              : static_cast<double>(most) / static_cast<double>(pixels.size());
    }

    int rate_;
    int number_ = 0;
    std::vector<Pixel> light_;
    std::vector<Pixel> red_;
};

}  // namespace raks::render
