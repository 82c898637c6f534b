// Images of a model as it is read: looked at, not unpacked.
#pragma once

#include "base/expected.hpp"
#include "render/import/image_file.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Writes the size of what `image.packed` holds into `image`. Errors: as look_at_image; the bytes
/// are then dropped. Threads: any. Real-time: no.
[[nodiscard]] Expected<ImageFormat> take_size(ModelImage& image);

/// Leaves out the last images where all together would take too long to unpack (256 megapixels),
/// and halves the largest until the rest fits into memory (64 megapixels); both with a warning.
void keep_images_within_memory(Model& model);

}  // namespace raks::render
