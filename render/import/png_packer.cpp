#include "render/import/png_packer.hpp"

#include <png.h>

#include <string>

namespace raks::render {

Expected<std::vector<std::byte>> pack_png(const Image& image) {
    png_image head{};
    head.version = PNG_IMAGE_VERSION;
    head.width = static_cast<png_uint_32>(image.width);
    head.height = static_cast<png_uint_32>(image.height);
    head.format = PNG_FORMAT_RGBA;
    head.flags = PNG_IMAGE_FLAG_FAST;
    // As libpng counts: whatever the pixels are, they have room.
    std::vector<std::byte> packed(PNG_IMAGE_PNG_SIZE_MAX(head));
    png_alloc_size_t size = packed.size();
    if (png_image_write_to_memory(
            &head, packed.data(), &size, 0, image.pixels.data(), 0, nullptr) == 0) {
        return fail(std::string("cannot be packed as PNG: ") + head.message);
    }
    packed.resize(size);
    return packed;
}

}  // namespace raks::render
