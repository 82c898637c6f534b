#include "apps/raks_capture/filmed_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace raks::apps {
namespace {

constexpr double kMostBeyond = 0.4;  // of the picture's size, that a drawing reaches further
constexpr std::size_t kNoiseNumbers = std::size_t{1} << 16U;
constexpr int kLightSteps = 4095;  // of the table from light to grey levels

std::array<float, 256> light_table() {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        table[i] = static_cast<float>(std::pow(static_cast<double>(i) / 255.0, 2.2));
    }
    return table;
}

// Grey levels of sRGB by the square root of the light, in which dark ones lie apart.
std::array<float, kLightSteps + 1> level_table() {
    std::array<float, kLightSteps + 1> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double root = static_cast<double>(i) / kLightSteps;
        const double linear = root * root;
        const double level =
            linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
        table[i] = static_cast<float>(255.0 * level);
    }
    return table;
}

// A pixel without the lens' distortion: of the same lens as a pinhole.
glm::dvec2 undistorted(const capture::Lens& lens, const glm::dvec2& pixel) {
    const glm::dvec2 direction = capture::direction_of(lens, pixel);
    return {lens.fx * direction.x + lens.cx, lens.fy * direction.y + lens.cy};
}

}  // namespace

FilmedPicture::FilmedPicture(const capture::Camera& camera, int scale) : lens_(camera.lens) {
    find_drawing(camera, scale);
    find_taps(camera.lens, scale);
    const std::size_t pixels = taps_.size();
    light_.assign(3 * pixels, 0.0F);
    picture_.assign(4 * pixels, 255);
    Dice dice(1, 0);
    noise_.reserve(kNoiseNumbers);
    for (std::size_t i = 0; i < kNoiseNumbers; ++i) {
        noise_.push_back(static_cast<float>(dice.normal(1.0)));
    }
}

// The box around the undistorted border of the picture.
void FilmedPicture::find_drawing(const capture::Camera& camera, int scale) {
    const capture::Lens& lens = camera.lens;
    glm::dvec2 low(0.0);
    glm::dvec2 high(lens.width - 1.0, lens.height - 1.0);
    const glm::dvec2 beyond(kMostBeyond * lens.width, kMostBeyond * lens.height);
    const auto reach = [&](double x, double y) {
        const glm::dvec2 place = undistorted(lens, {x, y});
        low = glm::max(glm::min(low, place), -beyond);
        high = glm::min(glm::max(high, place), glm::dvec2(lens.width, lens.height) + beyond);
    };
    for (int x = 0; x < lens.width; ++x) {
        reach(x, 0.0);
        reach(x, lens.height - 1.0);
    }
    for (int y = 0; y < lens.height; ++y) {
        reach(0.0, y);
        reach(lens.width - 1.0, y);
    }
    left_ = std::floor(low.x) - 0.5;
    top_ = std::floor(low.y) - 0.5;
    drawing_ = {.width = scale * (std::ceil(high.x) + 0.5 - left_),
                .height = scale * (std::ceil(high.y) + 0.5 - top_),
                .fx = scale * lens.fx,
                .fy = scale * lens.fy,
                .cx = scale * (lens.cx - left_) - 0.5,
                .cy = scale * (lens.cy - top_) - 0.5,
                .rotation = camera.rotation,
                .translation = camera.translation};
}

std::uint32_t FilmedPicture::nearest(double x, double y) const {
    const double column = std::clamp(std::round(x), 0.0, drawing_.width - 1.0);
    const double row = std::clamp(std::round(y), 0.0, drawing_.height - 1.0);
    return static_cast<std::uint32_t>(row * drawing_.width + column);
}

FilmedPicture::Taps FilmedPicture::taps_between(double x, double y) const {
    const double column = std::floor(x);
    const double row = std::floor(y);
    const auto right = static_cast<float>(x - column);
    const auto lower = static_cast<float>(y - row);
    Taps taps;
    for (std::size_t i = 0; i < kTaps; ++i) {
        const bool is_right = i % 2 == 1;
        const bool is_lower = i / 2 == 1;
        taps.pixel[i] = nearest(column + (is_right ? 1.0 : 0.0), row + (is_lower ? 1.0 : 0.0));
        taps.share[i] = (is_right ? right : 1.0F - right) * (is_lower ? lower : 1.0F - lower);
    }
    return taps;
}

// At twice the size four points of each pixel; at single size what lies between four.
void FilmedPicture::find_taps(const capture::Lens& lens, int scale) {
    const auto in_drawing = [&](double x, double y) {
        const glm::dvec2 place = undistorted(lens, {x, y});
        return glm::dvec2(scale * (place.x - left_) - 0.5, scale * (place.y - top_) - 0.5);
    };
    taps_.reserve(static_cast<std::size_t>(lens.width) * static_cast<std::size_t>(lens.height));
    for (int y = 0; y < lens.height; ++y) {
        for (int x = 0; x < lens.width; ++x) {
            if (scale == 1) {
                const glm::dvec2 at = in_drawing(x, y);
                taps_.push_back(taps_between(at.x, at.y));
                continue;
            }
            Taps taps;
            for (std::size_t i = 0; i < kTaps; ++i) {
                const glm::dvec2 at =
                    in_drawing(x + (i % 2 == 0 ? -0.25 : 0.25), y + (i / 2 == 0 ? -0.25 : 0.25));
                taps.pixel[i] = nearest(at.x, at.y);
                taps.share[i] = 1.0F / kTaps;
            }
            taps_.push_back(taps);
        }
    }
}

void FilmedPicture::add_row(std::span<const std::uint8_t> rgba, int row, int left, int right) {
    static const std::array<float, 256> kLight = light_table();
    const auto first = static_cast<std::size_t>(row) * static_cast<std::size_t>(lens_.width) +
                       static_cast<std::size_t>(left);
    const std::span<const Taps> pixels(&taps_[first], static_cast<std::size_t>(right - left));
    float* to = &light_[3 * first];
    for (const Taps& taps : pixels) {
        for (std::size_t i = 0; i < kTaps; ++i) {
            const std::uint8_t* const from = rgba.data() + std::size_t{4} * taps.pixel[i];
            for (std::size_t c = 0; c < 3; ++c) {
                to[c] += taps.share[i] * kLight[from[c]];
            }
        }
        to += 3;
    }
}

void FilmedPicture::add(std::span<const std::uint8_t> rgba) {
    for (int row = 0; row < lens_.height; ++row) {
        add_row(rgba, row, 0, lens_.width);
    }
    ++added_;
}

void FilmedPicture::set_still(std::span<const std::uint8_t> rgba) {
    add(rgba);
    still_ = light_;
    std::fill(light_.begin(), light_.end(), 0.0F);
    added_ = 0;
}

// What the lens makes of the part's border, and some pixels more.
FilmedPicture::Region FilmedPicture::region_of(const DrawnPart& part) const {
    constexpr int kSteps = 64;
    constexpr double kMore = 2.0;
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    const auto reach = [&](double along, double down) {
        const glm::dvec2 drawn(part.x + along * part.width, part.y + down * part.height);
        const glm::dvec2 place = capture::distorted_pixel(
            lens_, {(drawn.x - drawing_.cx) / drawing_.fx, (drawn.y - drawing_.cy) / drawing_.fy});
        low = glm::min(low, place);
        high = glm::max(high, place);
    };
    for (int i = 0; i <= kSteps; ++i) {
        const double share = static_cast<double>(i) / kSteps;
        reach(share, 0.0);
        reach(share, 1.0);
        reach(0.0, share);
        reach(1.0, share);
    }
    const glm::dvec2 size(lens_.width, lens_.height);
    low = glm::clamp(glm::floor(low - kMore), glm::dvec2(0.0), size);
    high = glm::clamp(glm::ceil(high + kMore), low, size);
    return {static_cast<int>(low.x),
            static_cast<int>(low.y),
            static_cast<int>(high.x),
            static_cast<int>(high.y)};
}

void FilmedPicture::add(std::span<const std::uint8_t> rgba,
                        const DrawnPart& part,
                        const PictureRows& rows) {
    const Region region = part.width > 0 && part.height > 0 ? region_of(part) : Region{0, 0, 0, 0};
    const auto add_still = [&](int row, int left, int right) {
        const int first = 3 * row * lens_.width;
        for (int i = first + 3 * left; i < first + 3 * right; ++i) {
            light_[static_cast<std::size_t>(i)] += still_[static_cast<std::size_t>(i)];
        }
    };
    for (int row = rows.first; row < rows.end; ++row) {
        if (row < region.top || row >= region.bottom) {
            add_still(row, 0, lens_.width);
            continue;
        }
        add_still(row, 0, region.left);
        add_row(rgba, row, region.left, region.right);
        add_still(row, region.right, lens_.width);
    }
    added_ += rows.end == lens_.height ? 1 : 0;
}

const std::vector<std::uint8_t>& FilmedPicture::develop(const Sensor& sensor, Dice& dice) {
    static const std::array<float, kLightSteps + 1> kLevel = level_table();
    std::array<float, 3> factor{};
    for (int c = 0; c < 3; ++c) {
        factor[static_cast<std::size_t>(c)] = static_cast<float>(sensor.gain[c] / added_);
    }
    const auto noise = static_cast<float>(sensor.noise);
    auto at = static_cast<std::size_t>(dice.whole(0, static_cast<int>(kNoiseNumbers) - 1));
    // An odd step through the numbers, so that rows of a picture are not alike.
    const std::size_t step = 2 * static_cast<std::size_t>(dice.whole(1, 2000)) + 1;
    for (std::size_t i = 0; i < light_.size(); ++i) {
        const float light = std::clamp(light_[i] * factor[i % 3], 0.0F, 1.0F);
        const float level = kLevel[static_cast<std::size_t>(std::sqrt(light) * kLightSteps)];
        at = (at + step) % kNoiseNumbers;
        const float noisy = std::clamp(level + noise * noise_[at] + 0.5F, 0.0F, 255.0F);
        picture_[i / 3 * 4 + i % 3] = static_cast<std::uint8_t>(noisy);
    }
    std::fill(light_.begin(), light_.end(), 0.0F);
    added_ = 0;
    return picture_;
}

}  // namespace raks::apps
