// Thumbnail: the picture of itself that a model's file has.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/model/model.hpp"

namespace raks::apps {

/// Rows from the top.
struct Thumbnail {
    int width = 0;                  ///< pixels
    int height = 0;                 ///< pixels
    std::vector<std::uint8_t> rgb;  ///< what is transparent shows the ground of the panes
};

/// None: the file has none, or one that cannot be read, which is said among what was left out.
[[nodiscard]] std::optional<Thumbnail> thumbnail_of(const render::Model& model);

}  // namespace raks::apps
