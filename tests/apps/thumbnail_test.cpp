#include "apps/xbody/thumbnail.hpp"

#include <gtest/gtest.h>

#include "render/import/png_packer.hpp"

namespace raks::apps {
namespace {

/// A model whose picture is two pixels: one half transparent, one that is not seen at all.
render::Model pictured() {
    render::Model model;
    const render::Image two{
        .width = 2, .height = 1, .pixels = {200, 100, 0, 128, 255, 255, 255, 0}};
    model.images.emplace_back().packed = render::pack_png(two).value();
    model.character.licence.thumbnail = 0;
    return model;
}

TEST(Thumbnail, shows_the_ground_of_the_pane_where_it_is_transparent) {
    const auto found = thumbnail_of(pictured());
    ASSERT_TRUE(found);
    EXPECT_EQ(found->width, 2);
    EXPECT_EQ(found->height, 1);
    const std::vector<std::uint8_t> expected = {109, 60, 15, 0x12, 0x14, 0x1F};
    EXPECT_EQ(found->rgb, expected);
}

TEST(Thumbnail, is_none_where_the_file_has_none_or_one_that_cannot_be_read) {
    render::Model model = pictured();
    model.images[0].packed.resize(20);
    EXPECT_FALSE(thumbnail_of(model));
    model.images[0].packed.clear();
    EXPECT_FALSE(thumbnail_of(model));
    model.character.licence.thumbnail = -1;
    EXPECT_FALSE(thumbnail_of(model));
}

}  // namespace
}  // namespace raks::apps
