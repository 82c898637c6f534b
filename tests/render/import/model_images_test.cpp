#include "render/import/model_images.hpp"

#include <gtest/gtest.h>

namespace raks::render {
namespace {

constexpr std::size_t kMegabyte = std::size_t{1} << 20U;

/// A model of which each image is the colour of a material.
Model model_with(const std::vector<int>& sides) {
    Model model;
    for (const int side : sides) {
        ModelImage& image = model.images.emplace_back();
        image.packed.resize(1);
        image.width = image.height = side;
        model.textures.emplace_back().image = static_cast<int>(model.images.size()) - 1;
        model.materials.emplace_back().base_texture.texture =
            static_cast<int>(model.textures.size()) - 1;
    }
    return model;
}

std::vector<int> halvings(const Model& model) {
    std::vector<int> all;
    for (const ModelImage& image : model.images) {
        all.push_back(image.halvings);
    }
    return all;
}

TEST(FitImages, leaves_as_they_are_those_that_fit) {
    // With their smaller copies 5 1/3 bytes a pixel: 1024 x 1024 takes 5 1/3 MB.
    Model model = model_with({1024, 1024, 1024});
    fit_images(16 * kMegabyte, model);
    EXPECT_EQ(halvings(model), (std::vector<int>{0, 0, 0}));
    EXPECT_TRUE(model.warnings.empty());
}

TEST(FitImages, halves_the_largest_until_all_fit_and_says_so_once) {
    Model model = model_with({512, 2048, 1024});
    fit_images(12 * kMegabyte, model);
    EXPECT_EQ(halvings(model), (std::vector<int>{0, 1, 0}));
    EXPECT_EQ(model.warnings,
              std::vector<std::string>{"its pictures would take 28 MB of memory, and 12 are the "
                                       "most (avatar_pictures_mb): 1 of them are halved"});
    Model many = model_with(std::vector<int>(23, 2048));
    fit_images(kUsualImageBytes, many);
    EXPECT_EQ(halvings(many), std::vector<int>(23, 1));
    EXPECT_EQ(many.warnings.size(), 1U);
}

TEST(FitImages, does_not_count_what_no_material_uses) {
    Model model = model_with({1024, 4096});
    model.materials.pop_back();
    fit_images(8 * kMegabyte, model);
    EXPECT_EQ(halvings(model), (std::vector<int>{0, 0}));
}

TEST(FitImages, ends_where_nothing_can_be_halved_any_more) {
    Model model = model_with({1, 4});
    fit_images(0, model);
    EXPECT_EQ(halvings(model), (std::vector<int>{0, 2}));
}

}  // namespace
}  // namespace raks::render
