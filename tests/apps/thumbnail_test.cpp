#include "apps/xbody/thumbnail.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "render/import/model_reader.hpp"

namespace raks::apps {
namespace {

std::optional<Thumbnail> thumbnail_in(const char* name) {
    const auto model = render::load_model(std::filesystem::path(RAKS_SOURCE_DIR) / "tests" /
                                          "data" / "avatars" / name);
    EXPECT_TRUE(model) << name;
    return model ? thumbnail_of(*model) : std::nullopt;
}

TEST(Thumbnail, shows_the_ground_of_the_pane_where_it_is_transparent) {
    const auto found = thumbnail_in("Godette_vrm_v4.vrm");
    ASSERT_TRUE(found);
    ASSERT_EQ(found->rgb.size(), 3U * static_cast<std::size_t>(found->width * found->height));
    constexpr std::array<std::uint8_t, 3> kGround = {0x12, 0x14, 0x1F};
    // The last row is empty beside her feet, but not between them.
    EXPECT_TRUE(std::equal(kGround.begin(), kGround.end(), found->rgb.end() - 3));
    const auto lit = std::count_if(
        found->rgb.begin(), found->rgb.end(), [](std::uint8_t value) { return value > 128; });
    EXPECT_GT(lit, 1000);
}

TEST(Thumbnail, is_none_where_the_file_has_none) {
    EXPECT_FALSE(thumbnail_in("kenney_character.glb"));
}

}  // namespace
}  // namespace raks::apps
