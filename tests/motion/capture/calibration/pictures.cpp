#include "tests/motion/capture/calibration/pictures.hpp"

#include <span>
#include <string>

#include "base/file.hpp"
#include "render/import/image_file.hpp"

namespace raks::capture::test {

Picture read_picture(const std::filesystem::path& path) {
    const Expected<std::string> bytes = read_file(path);
    if (!bytes) {
        return {};
    }
    render::ModelUnpacker unpacker;
    const auto image = render::decode_image(unpacker, std::as_bytes(std::span(*bytes)));
    if (!image) {
        return {};
    }
    Picture picture{image->width, image->height, {}};
    for (std::size_t i = 0; i + 3 < image->pixels.size(); i += 4) {
        const double grey =
            0.299 * image->pixels[i] + 0.587 * image->pixels[i + 1] + 0.114 * image->pixels[i + 2];
        picture.pixels.push_back(static_cast<std::uint8_t>(grey + 0.5));
    }
    return picture;
}

}  // namespace raks::capture::test
