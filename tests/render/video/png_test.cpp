#include "render/video/png.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include "base/file.hpp"
#include "tests/render/video/film_support.hpp"

namespace raks::render {
namespace {

Rgba read_png(const std::filesystem::path& path, int& width, int& height) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.c_str()) == 0) {
        return {};
    }
    image.format = PNG_FORMAT_RGBA;
    width = static_cast<int>(image.width);
    height = static_cast<int>(image.height);
    Rgba rgba(PNG_IMAGE_SIZE(image));
    png_image_finish_read(&image, nullptr, rgba.data(), 0, nullptr);
    return rgba;
}

TEST(Png, every_byte_comes_back) {
    const raks::test::TemporaryFolder folder;
    for (const auto& [wide, high] : {std::pair{1, 1}, std::pair{17, 3}, std::pair{640, 360}}) {
        const Rgba picture = noise_picture(wide, high, 5);
        ASSERT_TRUE(write_png(folder / "a.png", wide, high, picture));
        int width = 0;
        int height = 0;
        EXPECT_EQ(read_png(folder / "a.png", width, height), picture);
        EXPECT_EQ(width, wide);
        EXPECT_EQ(height, high);
    }
}

TEST(Png, the_same_picture_gives_the_same_bytes) {
    const raks::test::TemporaryFolder folder;
    const Rgba picture = noise_picture(33, 21, 6);
    ASSERT_TRUE(write_png(folder / "a.png", 33, 21, picture));
    ASSERT_TRUE(write_png(folder / "b.png", 33, 21, picture));
    EXPECT_EQ(read_file(folder / "a.png").value(), read_file(folder / "b.png").value());
}

TEST(Png, a_size_that_does_not_fit_and_a_missing_folder_are_refused) {
    const raks::test::TemporaryFolder folder;
    const auto wrong = write_png(folder / "a.png", 10, 10, Rgba(399));
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().message,
              (folder / "a.png").string() + ": a picture of 10x10 does not have 399 bytes");
    EXPECT_FALSE(write_png(folder / "a.png", 0, 10, {}));
    EXPECT_FALSE(write_png(folder / "a.png", -1, -1, Rgba(4)));
    EXPECT_FALSE(write_png(folder / "no/such/a.png", 1, 1, Rgba(4)));
    EXPECT_TRUE(folder.is_empty());
}

}  // namespace
}  // namespace raks::render
