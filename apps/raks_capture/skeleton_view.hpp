// Skeleton view: what a network saw of a dancer, drawn over the picture that it saw it in.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "motion/capture/keypoints/keypoints.hpp"
#include "render/panes/picture_view.hpp"

namespace raks::apps {

/// A joint of the skeleton in a view.
struct ViewJoint {
    glm::dvec2 pixel{};
    double visibility = 0.0;  ///< [0, 1]; 0: it is not seen
    bool is_hidden = false;   ///< by an edit: it does not count

    friend bool operator==(const ViewJoint&, const ViewJoint&) = default;
};
/// All joints, by BodyPoint.
using ViewSkeleton = std::array<ViewJoint, capture::kBodyPoints>;

/// Colours of the dancer's own left and right, and of the middle of the body: blue and orange are
/// told apart by colour-blind people, too (Okabe and Ito, 2008).
namespace side_colours {
inline constexpr render::Colour kLeft{0x56B4E9};
inline constexpr render::Colour kRight{0xE69F00};
inline constexpr render::Colour kMiddle{0xF2EEE6};
inline constexpr render::Colour kPlaced{0xFFFFFF, 0.75F};  ///< where all views have the joints
inline constexpr render::Colour kHidden{0xB9A7D6};         ///< what does not count
}  // namespace side_colours

/// The colour of a joint by its name: of its side.
[[nodiscard]] render::Colour colour_of_side(std::string_view joint) noexcept;

/// Draws what a camera's network saw: bones and joints of each side in its colour, on a dark
/// outline; joints of low likelihood faint, hidden ones as dashes.
void draw_skeleton(const render::PaneFrame& frame,
                   const render::PicturePlace& place,
                   const ViewSkeleton& joints);

/// Draws where all views together have the joints as thin white lines. `places`: by BodyPoint, none
/// where it is lost.
void draw_placed(const render::PaneFrame& frame,
                 const render::PicturePlace& place,
                 const std::array<std::optional<glm::dvec2>, capture::kBodyPoints>& places);

/// Draws what the colours mean from `box` on to the right, one line high.
void draw_legend(const render::PaneFrame& frame, const render::Box& box);

}  // namespace raks::apps
