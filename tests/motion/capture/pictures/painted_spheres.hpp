#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/dice.hpp"
#include "motion/capture/pictures/chroma.hpp"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace raks::capture::test {

/// Green, blue, yellow, magenta and cyan paint: what it throws back, linear.
inline const std::array<glm::dvec3, 5> kPaints{{{0.04, 0.45, 0.10},
                                                {0.04, 0.10, 0.55},
                                                {0.75, 0.60, 0.04},
                                                {0.60, 0.05, 0.35},
                                                {0.04, 0.45, 0.60}}};
/// Skin, wood, dark cloth, jeans, a grey wall, a red skirt.
inline const std::array<glm::dvec3, 6> kBackgrounds{{{0.55, 0.33, 0.24},
                                                     {0.36, 0.20, 0.09},
                                                     {0.02, 0.02, 0.03},
                                                     {0.07, 0.12, 0.26},
                                                     {0.40, 0.40, 0.40},
                                                     {0.45, 0.03, 0.04}}};

/// The light of a picture.
struct Light {
    glm::dvec3 towards{0.0, 0.0, 1.0};  ///< of length 1; z towards the camera
    double gain = 1.0;
    double ambient = 0.25;  ///< share of the light from everywhere
    double noise = 2.0;     ///< grey levels, sd
};

/// From anywhere before the things.
inline Light drawn_light(Dice& dice, double least_gain, double most_gain) {
    Light light;
    do {
        light.towards = {dice.normal(1.0), dice.normal(1.0), std::abs(dice.normal(1.0))};
    } while (glm::length(light.towards) < 0.1);
    light.towards = glm::normalize(light.towards);
    light.gain = dice.log_uniform(least_gain, most_gain);
    return light;
}

/// A picture in linear light, to be filmed.
class Canvas {
 public:
    Canvas(int width, int height, const glm::dvec3& colour = {})
        : width_(width),
          height_(height),
          light_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), colour) {}

    [[nodiscard]] glm::dvec3& at(int x, int y) {
        return light_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                      static_cast<std::size_t>(x)];
    }

    /// What a surface of this colour throws back at random slants.
    void fill(const glm::dvec3& paint, const Light& light, Dice& dice) {
        for (glm::dvec3& pixel : light_) {
            pixel = light.gain * paint *
                    (light.ambient + (1.0 - light.ambient) * dice.uniform(0.0, 1.0));
        }
    }

    /// Lambert, ambient light and 15 % of highlight, over what is there; 16 samples a pixel.
    void paint_sphere(const glm::dvec2& centre,
                      double radius,
                      const glm::dvec3& paint,
                      const Light& light) {
        constexpr int kSamples = 4;
        const auto low = glm::ivec2(centre - radius - 1.0);
        const auto high = glm::ivec2(centre + radius + 2.0);
        for (int y = std::max(low.y, 0); y <= std::min(high.y, height_ - 1); ++y) {
            for (int x = std::max(low.x, 0); x <= std::min(high.x, width_ - 1); ++x) {
                const glm::dvec3 before = at(x, y);
                glm::dvec3 sum{};
                for (int i = 0; i < kSamples * kSamples; ++i) {
                    const glm::dvec2 place(x + (i % kSamples + 0.5) / kSamples - 0.5,
                                           y + (i / kSamples + 0.5) / kSamples - 0.5);
                    const glm::dvec2 off = (place - centre) / radius;
                    const double depth2 = 1.0 - glm::dot(off, off);
                    sum += depth2 <= 0.0 ? before
                                         : lit({off.x, -off.y, std::sqrt(depth2)}, paint, light);
                }
                at(x, y) = sum / double(kSamples * kSamples);
            }
        }
    }

    /// sRGB of 8 bits with noise.
    [[nodiscard]] std::vector<std::uint8_t> filmed(const Light& light, Dice& dice) const {
        std::vector<std::uint8_t> rgb;
        rgb.reserve(light_.size() * 3);
        for (const glm::dvec3& pixel : light_) {
            for (int c = 0; c < 3; ++c) {
                const double linear = std::max(pixel[c], 0.0);
                const double level = linear <= 0.0031308
                                         ? 12.92 * linear
                                         : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
                rgb.push_back(static_cast<std::uint8_t>(
                    std::lround(std::clamp(255.0 * level + dice.normal(light.noise), 0.0, 255.0))));
            }
        }
        return rgb;
    }

    [[nodiscard]] PictureView view(const std::vector<std::uint8_t>& rgb) const {
        return {width_, height_, rgb};
    }

 private:
    static glm::dvec3 lit(const glm::dvec3& normal, const glm::dvec3& paint, const Light& light) {
        const double facing = std::max(glm::dot(normal, light.towards), 0.0);
        const glm::dvec3 half = glm::normalize(light.towards + glm::dvec3(0.0, 0.0, 1.0));
        const double highlight = std::pow(std::max(glm::dot(normal, half), 0.0), 30.0);
        return light.gain * (paint * (light.ambient + (1.0 - light.ambient) * facing) +
                             0.15 * (facing > 0.0 ? highlight : 0.0));
    }

    int width_;
    int height_;
    std::vector<glm::dvec3> light_;
};

/// The five paints, each learnt from one sphere 41 pixels wide under one light.
inline std::vector<ColourModel> learnt_paints(ChromaForm form, double ambient) {
    Dice dice(1, 0);
    const Light light{.towards = glm::normalize(glm::dvec3(0.4, 0.6, 0.7)), .ambient = ambient};
    std::vector<ColourModel> models;
    for (const glm::dvec3& paint : kPaints) {
        Canvas canvas(64, 64, glm::dvec3(0.2));
        canvas.paint_sphere({32.0, 32.0}, 20.5, paint, light);
        const auto rgb = canvas.filmed(light, dice);
        const PictureView view = canvas.view(rgb);
        const ColourPoint point{.picture = 0, .pixel = {32.0, 30.0}};
        models.push_back(learn_colour(std::span(&view, 1), std::span(&point, 1), form).value());
    }
    return models;
}

}  // namespace raks::capture::test
