#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/dice.hpp"
#include "motion/capture/camera/calibrated_camera.hpp"
#include "render/scene/placed_camera.hpp"

#include <glm/vec3.hpp>

namespace raks::apps {

/// What a camera makes of the light that falls on it.
struct Sensor {
    glm::dvec3 gain{1.0};  ///< of red, green and blue; of linear light
    double noise = 2.0;    ///< grey levels, standard deviation
};

/// A part of a drawing: left and upper edge, width and height, pixels.
struct DrawnPart {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// Rows of a picture, from `first` up to `end`, which is beyond them.
struct PictureRows {
    int first = 0;
    int end = 0;
};

/// Makes a camera's pictures of drawn ones, which know neither its lens' distortion nor a sensor:
/// drawings at `scale` times the size are bent, reduced and summed up as light, several for one
/// picture where things move while the shutter is open. Pure computation. Threads: one.
class FilmedPicture {
 public:
    /// `scale`: 1 or 2; of a drawing against the picture.
    FilmedPicture(const capture::Camera& camera, int scale);

    /// What is to be drawn: larger than the picture where the lens shows more than a pinhole would.
    [[nodiscard]] const render::PinholeView& drawing() const noexcept { return drawing_; }

    /// Adds a drawing to the light so far: drawing().width x height x 4 bytes RGBA, gamma 2.2.
    void add(std::span<const std::uint8_t> rgba);
    /// Sets a drawing of which others differ in a part only.
    void set_still(std::span<const std::uint8_t> rgba);
    /// The same as add(rgba) where the drawing is the still one beyond `part`, and quicker.
    /// Adds to these rows alone: those of a picture come from the first to the last, each once.
    /// Precondition: set_still.
    void add(std::span<const std::uint8_t> rgba, const DrawnPart& part, const PictureRows& rows);
    /// The picture of what was added since the last one, as sRGB with alpha 255. At least one.
    [[nodiscard]] const std::vector<std::uint8_t>& develop(const Sensor& sensor, Dice& dice);

 private:
    static constexpr std::size_t kTaps = 4;
    struct Taps {
        std::uint32_t pixel[kTaps]{};  // of the drawing
        float share[kTaps]{};
    };

    void find_drawing(const capture::Camera& camera, int scale);
    void find_taps(const capture::Lens& lens, int scale);
    [[nodiscard]] Taps taps_between(double x, double y) const;
    [[nodiscard]] std::uint32_t nearest(double x, double y) const;

    // A part of the picture; ends are beyond it.
    struct Region {
        int left, top, right, bottom;
    };
    [[nodiscard]] Region region_of(const DrawnPart& part) const;
    void add_row(std::span<const std::uint8_t> rgba, int row, int left, int right);

    capture::Lens lens_;
    render::PinholeView drawing_;
    double left_ = 0.0;  // the drawing's edges in the undistorted picture, pixels of the lens
    double top_ = 0.0;
    std::vector<Taps> taps_;    // by pixel
    std::vector<float> light_;  // by pixel: red, green, blue
    std::vector<float> still_;  // light of the still drawing
    int added_ = 0;
    std::vector<std::uint8_t> picture_;
    std::vector<float> noise_;  // normal numbers, of which each picture takes others
};

}  // namespace raks::apps
