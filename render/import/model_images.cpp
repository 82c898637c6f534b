#include "render/import/model_images.hpp"

#include <algorithm>
#include <cstdint>

#include "render/import/model_warnings.hpp"

namespace raks::render {
namespace {

constexpr std::int64_t kMostPixels = 64'000'000;  // unpacked, of all images of a model
constexpr std::int64_t kMostPackedPixels =
    4 * kMostPixels;  // so many are unpacked and made smaller

std::int64_t pixels_of(const ModelImage& image) {
    return std::int64_t{image.width >> image.halvings} * (image.height >> image.halvings);
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

void keep_images_within_memory(Model& model) {
    std::int64_t packed = 0;
    for (ModelImage& image : model.images) {
        packed += std::int64_t{image.width} * image.height;
        if (packed > kMostPackedPixels) {
            image.packed.clear();
            image.width = image.height = 0;
            warn(model,
                 "its images have more than 256 megapixels in all: the last ones are left out");
        }
    }
    const auto total = [&model] {
        std::int64_t sum = 0;
        for (const ModelImage& image : model.images) {
            sum += pixels_of(image);
        }
        return sum;
    };
    while (total() > kMostPixels) {
        warn(model,
             "its images have more than 64 megapixels in all: the largest are drawn smaller");
        ++std::max_element(
              model.images.begin(),
              model.images.end(),
              [](const ModelImage& a, const ModelImage& b) { return pixels_of(a) < pixels_of(b); })
              ->halvings;
    }
}

}  // namespace raks::render
