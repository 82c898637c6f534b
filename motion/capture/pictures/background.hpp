// Background follower: where what stands behind a dancer is in the pictures of a camera, which
// tells whether the camera stood still.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "motion/capture/pictures/chroma.hpp"

#include <glm/vec2.hpp>

namespace raks::capture {

/// The background of a picture beside that of the first one.
struct BackgroundPlace {
    glm::dvec2 move{};  ///< of what is in the middle of the picture; pixels, x right, y down
    double size = 1.0;  ///< how many times as large it is

    friend bool operator==(const BackgroundPlace&, const BackgroundPlace&) = default;
};

/// Part of a picture, pixels.
struct PictureBounds {
    glm::dvec2 least{};
    glm::dvec2 greatest{};
};

/// Follows small pieces of the first picture that have corners through later ones, by least squares
/// on a pyramid of small grey pictures (Lucas and Kanade 1981); what most of them agree on is the
/// background's move, so that people and shadows in it do not count. A move is found to about a
/// tenth of a thousandth of the picture's width, and up to a twentieth of it at once. Threads: one.
/// Real-time: no.
class BackgroundFollower {
 public:
    /// Where the background is now; nothing: it shows too little to tell, as a bare wall does. All
    /// pictures must be of the first one's size. `dancer`: what of the picture is not background.
    [[nodiscard]] std::optional<BackgroundPlace> look(const PictureView& picture,
                                                      const std::optional<PictureBounds>& dancer);

    /// A grey picture. Public for the source's own functions.
    struct Grey {
        int width = 0;
        int height = 0;
        std::vector<float> values;

        /// Between pixels; the place must lie one pixel inside.
        [[nodiscard]] float at(double x, double y) const noexcept;
    };
    static constexpr std::size_t kLevels = 3;
    /// A picture and its halves.
    using Pyramid = std::array<Grey, kLevels>;

 private:
    void choose_pieces(const std::optional<PictureBounds>& dancer);

    Pyramid first_;
    int shrink_ = 1;                  // pixels of the film to one of the small picture
    std::vector<glm::dvec2> pieces_;  // their middles in the first small picture
    BackgroundPlace last_;            // in small pixels
};

}  // namespace raks::capture
