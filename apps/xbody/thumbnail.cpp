#include "apps/xbody/thumbnail.hpp"

#include <cstddef>

#include "render/import/image_file.hpp"
#include "render/panes/widgets.hpp"

namespace raks::apps {

std::optional<Thumbnail> thumbnail_of(const render::Model& model) {
    const int index = model.character.licence.thumbnail;
    if (index < 0 || model.images[static_cast<std::size_t>(index)].packed.empty()) {
        return std::nullopt;
    }
    const render::ModelImage& packed = model.images[static_cast<std::size_t>(index)];
    render::ModelUnpacker unpacker;
    const auto image = render::decode_image(unpacker, packed.packed, packed.halvings);
    if (!image) {
        return std::nullopt;
    }
    constexpr std::uint32_t kGround = render::pane_colours::kGround.rgb;
    const std::vector<std::uint8_t>& rgba = image->pixels;
    Thumbnail thumbnail{.width = image->width, .height = image->height, .rgb = {}};
    for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) {
        const std::uint32_t alpha = rgba[i + 3];
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const std::uint32_t ground = kGround >> (16 - 8 * channel) & 0xFFU;
            thumbnail.rgb.push_back(static_cast<std::uint8_t>(
                (rgba[i + channel] * alpha + ground * (255 - alpha)) / 255));
        }
    }
    return thumbnail;
}

}  // namespace raks::apps
