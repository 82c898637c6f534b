// Picture view: a picture that a person zooms, moves and points into.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "render/panes/pane_context.hpp"
#include "render/panes/pane_picture.hpp"

#include <glm/vec2.hpp>

namespace raks::render {

/// Which part of a picture is seen.
struct PictureZoom {
    double times = 1.0;           ///< 1: all of it fills the box; up to kMostTimes
    glm::dvec2 middle{0.5, 0.5};  ///< what is in the box's middle; shares of the picture

    static constexpr double kMostTimes = 40.0;  ///< pixels are as large as a nail then

    friend bool operator==(const PictureZoom&, const PictureZoom&) = default;
};

/// Where the pixels of a picture are in a box. Pixels as capture has them: whole numbers are their
/// centres, (0, 0) is the top left one. Pure arithmetic.
class PicturePlace {
 public:
    /// A picture of width x height pixels, > 0, in a box of units.
    PicturePlace(const Box& box, int width, int height, const PictureZoom& zoom) noexcept;

    /// Where a pixel is; units.
    [[nodiscard]] glm::vec2 in_box(const glm::dvec2& pixel) const noexcept;
    /// The pixel at a place of the frame.
    [[nodiscard]] glm::dvec2 pixel_at(const glm::vec2& place) const noexcept;
    /// Units that a pixel takes.
    [[nodiscard]] double unit() const noexcept { return unit_; }
    /// The box that was given.
    [[nodiscard]] const Box& box() const noexcept { return box_; }
    /// All of the picture, which may reach beyond the box.
    [[nodiscard]] Box whole() const noexcept;

    /// The zoom after `factor` times nearer, by which the pixel at `place` stays where it is.
    [[nodiscard]] PictureZoom zoomed(const glm::vec2& place, double factor) const noexcept;
    /// The zoom after the picture was pulled by so many units. A part of it stays in the box.
    [[nodiscard]] PictureZoom moved(const glm::vec2& by) const noexcept;

 private:
    Box box_;
    glm::dvec2 size_;  // pixels
    PictureZoom zoom_;
    double unit_;
    glm::dvec2 corner_;  // of the picture in the frame
};

/// What a person does with a picture.
struct PictureGesture {
    /// The left button: nothing, went down, moves while down, was let go.
    enum class Kind : std::uint8_t { none, press, drag, release };
    Kind kind = Kind::none;
    glm::dvec2 pixel{};                 ///< where; of none: under the pointer
    bool is_hovered = false;            ///< the pointer lies over it
    std::optional<PictureZoom> zoom{};  ///< wheel, or right or middle drag: the new one
};

/// Draws a picture in its box, cut at its edge, and tells what is done with it: the wheel zooms at
/// the pointer, the right or middle button moves. `picture` null: a dark ground. What lies over it
/// is drawn by the caller under a PaneClip.
[[nodiscard]] PictureGesture picture_view(const PaneFrame& frame,
                                          std::string_view name,
                                          const PicturePlace& place,
                                          const PanePicture* picture);

/// While one lives, all that is drawn is cut at the edge of a box.
class PaneClip {
 public:
    PaneClip(const PaneFrame& frame, const Box& box);  ///< from here on
    ~PaneClip();                                       ///< as before
    PaneClip(const PaneClip&) = delete;                ///< it counts
    PaneClip& operator=(const PaneClip&) = delete;     ///< likewise
};

}  // namespace raks::render
