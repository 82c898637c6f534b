// Marker labels: what a person clicked in pictures.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

#include <glm/vec2.hpp>

namespace raks::capture {

/// A marker that a person sees in a picture.
struct MarkerLabel {
    std::string camera;
    std::size_t picture = 0;  ///< from 0
    std::string marker;       ///< its name in the marker set
    glm::dvec2 pixel{};

    friend bool operator==(const MarkerLabel&, const MarkerLabel&) = default;
};

/// Labels as a table (`labels.tsv`): camera, picture, marker, u, v. Numbers read back to the same
/// bits.
[[nodiscard]] std::string labels_text(const std::vector<MarkerLabel>& labels);
/// Reads it. Errors, one line with its number: no such head, words that are no numbers, pixels that
/// are none, one marker twice in a picture. Whether cameras and markers exist, and pixels lie in
/// the picture, is for those to say who know them.
[[nodiscard]] Expected<std::vector<MarkerLabel>> read_labels(std::string_view text,
                                                             const std::string& file);

}  // namespace raks::capture
