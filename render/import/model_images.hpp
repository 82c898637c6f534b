// Images of a model as it is read: looked at, not unpacked.
#pragma once

#include <cstddef>

#include "base/expected.hpp"
#include "render/import/image_file.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Writes the size of what `image.packed` holds into `image`. Errors: as look_at_image; the bytes
/// are then dropped. Threads: any. Real-time: no.
[[nodiscard]] Expected<ImageFormat> take_size(ModelImage& image);

/// Leaves out the last images, with a warning, where all together would take too long to unpack
/// (256 megapixels).
void leave_out_images_beyond_reason(Model& model);

/// What the images that materials use may take in a driver's memory, by default.
inline constexpr std::size_t kUsualImageBytes = std::size_t{128} << 20U;

/// Halves the largest of the images that materials use, until all of them, each with its smaller
/// copies, take so many bytes of a driver's memory at most; with one warning.
void fit_images(std::size_t most_bytes, Model& model);

}  // namespace raks::render
