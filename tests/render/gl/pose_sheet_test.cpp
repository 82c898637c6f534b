#include "render/pose_sheet.hpp"

#include "render/mannequin/mannequin.hpp"
#include "tests/render/gl/pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace raks::render {
namespace {

class PoseSheetTest : public OffscreenTest {
 protected:
    void SetUp() override {
        OffscreenTest::SetUp();
        static const Avatar avatar = build_mannequin();
        Expected<Renderer> renderer = Renderer::create(avatar, {.quality = Quality::fast});
        ASSERT_TRUE(renderer.has_value()) << renderer.error().message;
        renderer_.emplace(std::move(*renderer));
    }
    Renderer& renderer() { return *renderer_; }

 private:
    std::optional<Renderer> renderer_;
};

Picture tile(const PoseSheet& sheet, int column, int row, int width, int height) {
    Picture tile{width, height, {}};
    const auto row_bytes = 4 * static_cast<std::ptrdiff_t>(width);
    const auto sheet_bytes = 4 * static_cast<std::ptrdiff_t>(sheet.width);
    for (int y = 0; y < height; ++y) {
        const std::ptrdiff_t line = static_cast<std::ptrdiff_t>(row) * height + y;
        const auto start = sheet.rgba.begin() + line * sheet_bytes + column * row_bytes;
        tile.rgba.insert(tile.rgba.end(), start, start + row_bytes);
    }
    return tile;
}

double mean_difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += std::abs(a[i] - b[i]);
    }
    return sum / static_cast<double>(a.size());
}
// Of 255. Another place in the target moves the rasterizer's rounding: single steps of a byte.
constexpr double kSame = 0.2;
constexpr double kOther = 1.0;

TEST_F(PoseSheetTest, shows_every_pose_from_every_camera_in_order) {
    motion::Pose sitting = standing_pose();
    sitting.hips_position.y -= 0.4F;
    const std::vector<motion::Pose> poses = {standing_pose(), sitting, standing_pose()};
    const PoseSheetConfig config{.columns = 2, .tile_width = 60, .tile_height = 80};
    const PoseSheet sheet = draw_pose_sheet(renderer(), Scene{}, poses, config).value();
    EXPECT_EQ(sheet.width, 120);
    EXPECT_EQ(sheet.height, 4 * 80);  // two bands of front and side
    const auto at = [&](int column, int row) { return tile(sheet, column, row, 60, 80).rgba; };
    EXPECT_LT(mean_difference(at(0, 0), at(0, 2)), kSame) << "the same pose and camera";
    EXPECT_LT(mean_difference(at(0, 1), at(0, 3)), kSame);
    EXPECT_GT(mean_difference(at(0, 0), at(1, 0)), kOther) << "another pose";
    EXPECT_GT(mean_difference(at(0, 0), at(0, 1)), kOther) << "another camera";
    EXPECT_TRUE(std::ranges::all_of(at(1, 2), [](std::uint8_t byte) { return byte == 0; }))
        << "no fourth pose: its tile stays empty";
}

TEST_F(PoseSheetTest, follows_a_dancer_that_has_walked_away) {
    motion::Pose away = standing_pose();
    away.hips_position.x = 1.5F;
    Scene scene;
    scene.backdrop = Backdrop::transparent;
    const PoseSheetConfig config{.columns = 1, .tile_width = 90, .tile_height = 120};
    const PoseSheet sheet =
        draw_pose_sheet(renderer(), scene, std::vector<motion::Pose>{away}, config).value();
    const Picture front = tile(sheet, 0, 0, 90, 120);
    int middle = 0;
    for (int y = 0; y < 120; ++y) {
        middle += front.pixel(45, y)[3] == 255 ? 1 : 0;
    }
    EXPECT_GT(middle, 40);
}

TEST_F(PoseSheetTest, faults_of_the_configuration_are_named) {
    const std::vector<motion::Pose> one = {standing_pose()};
    const auto message = [&](std::span<const motion::Pose> poses, const PoseSheetConfig& config) {
        return draw_pose_sheet(renderer(), Scene{}, poses, config).error().message;
    };
    EXPECT_EQ(message({}, {}), "a pose sheet needs at least one pose");
    EXPECT_EQ(message(one, {.cameras = {}}), "a pose sheet needs at least one camera");
    EXPECT_EQ(message(one, {.columns = 0}), "a pose sheet of 0 columns, must be at least 1");
    EXPECT_EQ(message(one, {.tile_width = 0}),
              "a pose sheet with tiles of 0x320 pixels, each side must be at least 1");
    EXPECT_EQ(message(one, {.tile_height = 2'000'000'000}),
              "a pose sheet of 240x4000000000 pixels, at most 8192 a side");
}

}  // namespace
}  // namespace raks::render
