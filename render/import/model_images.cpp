#include "render/import/model_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "render/import/model_warnings.hpp"
#include "render/model/sub_meshes.hpp"

namespace raks::render {
namespace {

constexpr std::int64_t kMostPixels = 256'000'000;  // of all images of a model

/// Of what is drawn, in the driver: four bytes a pixel, and its smaller copies a third more.
std::size_t drawn_bytes(const ModelImage& image) {
    const auto side = [&](int full) { return std::size_t(std::max(full >> image.halvings, 1)); };
    return side(image.width) * side(image.height) * 16 / 3;
}

}  // namespace

Expected<ImageFormat> take_size(ModelImage& image) {
    const auto head = look_at_image(image.packed);
    if (!head) {
        image.packed.clear();
        return fail(head.error());
    }
    image.width = head->width;
    image.height = head->height;
    return head->format;
}

void leave_out_images_beyond_reason(Model& model) {
    std::int64_t pixels = 0;
    for (ModelImage& image : model.images) {
        pixels += std::int64_t{image.width} * image.height;
        if (pixels > kMostPixels) {
            image.packed.clear();
            image.width = image.height = 0;
            warn(model,
                 "its images have more than 256 megapixels in all: the last ones are left out");
        }
    }
}

void fit_images(std::size_t most_bytes, Model& model) {
    const std::vector<bool> is_used = used_images(model);
    std::vector<ModelImage*> drawn;
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < model.images.size(); ++i) {
        if (is_used[i] && !model.images[i].packed.empty()) {
            drawn.push_back(&model.images[i]);
            bytes += drawn_bytes(model.images[i]);
        }
    }
    const std::size_t before = bytes;
    const auto is_smaller = [](const ModelImage* a, const ModelImage* b) {
        return drawn_bytes(*a) < drawn_bytes(*b);
    };
    while (bytes > most_bytes) {
        ModelImage& largest = **std::max_element(drawn.begin(), drawn.end(), is_smaller);
        if (largest.width >> largest.halvings <= 1 && largest.height >> largest.halvings <= 1) {
            break;
        }
        bytes -= drawn_bytes(largest);
        ++largest.halvings;
        bytes += drawn_bytes(largest);
    }
    const auto halved = std::count_if(
        drawn.begin(), drawn.end(), [](const ModelImage* image) { return image->halvings > 0; });
    if (halved > 0) {
        warn(model,
             fmt::format("its pictures would take {} MB of memory, and {} are the most "
                         "(avatar_pictures_mb): {} of them are halved",
                         (before + (std::size_t{1} << 19U)) >> 20U,  // rounded
                         most_bytes >> 20U,
                         halved));
    }
}

}  // namespace raks::render
