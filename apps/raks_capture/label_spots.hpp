// Label spots: what the marker finder sees in a picture, by the labels so far.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "motion/capture/markers/observations.hpp"
#include "motion/capture/pictures/colour_model.hpp"

#include <glm/vec2.hpp>

namespace raks::apps {

/// A label as an example of a colour.
struct ColourExample {
    std::size_t colour = 0;  ///< index in MarkerSet::colours()
    glm::dvec2 pixel{};
};

/// Finds spots while somebody labels. Colours are learnt from the labels of the picture itself;
/// those that it has none of yet, from the picture that was last seen with one: another camera's,
/// mostly, which is near enough for a proposal. Threads: one.
class LabelSpots {
 public:
    /// `colours`: how many there are.
    explicit LabelSpots(std::size_t colours) : models_(colours) {}

    /// The spots of a picture, colours as of MarkerSet::colours(). Examples that show no colour, as
    /// of a label that lies beside its marker, are passed over.
    [[nodiscard]] std::vector<capture::Detection> find(const capture::PictureView& picture,
                                                       const std::vector<ColourExample>& examples);

 private:
    std::vector<std::optional<capture::ColourModel>> models_;  // by colour; none: not learnt yet
};

}  // namespace raks::apps
