// Pictures: the three kinds are read to the same pixels, and hostile ones are refused.
#include "render/import/image_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace raks;
using namespace raks::render;

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

/// A picture of 40 x 24 pixels, red on the left and half-clear blue on the right, as `convert`
/// writes it.
std::string picture(const std::string& name, const std::vector<std::string>& options = {}) {
    const raks::test::TemporaryFolder folder;
    const std::string file = (folder / name).string();
    std::vector<std::string> command = {
        "convert", "-size", "20x24", "xc:#ff0000ff", "xc:#0000ff80", "+append"};
    command.insert(command.end(), options.begin(), options.end());
    command.push_back(file);
    raks::test::ProcessPlan plan;
    plan.command = command;
    EXPECT_EQ(raks::test::run_process(plan).exit_code, 0) << name;
    return read_file(file).value_or("");
}

std::array<int, 4> pixel(const Image& image, int x, int y) {
    const std::size_t at = 4 * static_cast<std::size_t>(y * image.width + x);
    return {image.pixels[at], image.pixels[at + 1], image.pixels[at + 2], image.pixels[at + 3]};
}

class ModelImages : public testing::Test {
 protected:
    ModelUnpacker unpacker;
};

TEST_F(ModelImages, of_every_kind_become_the_same_pixels) {
    for (const char* const depth : {"8", "16"}) {
        SCOPED_TRACE(depth);
        const auto image = decode_image(unpacker, bytes_of(picture("a.png", {"-depth", depth})));
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->width, 40);
        EXPECT_EQ(image->height, 24);
        EXPECT_EQ(pixel(*image, 3, 3), (std::array<int, 4>{255, 0, 0, 255}));
        EXPECT_EQ(pixel(*image, 30, 20), (std::array<int, 4>{0, 0, 255, 128}));
    }
}

TEST_F(ModelImages, that_are_interlaced_or_progressive_are_read) {
    const auto png = decode_image(unpacker, bytes_of(picture("a.png", {"-interlace", "PNG"})));
    ASSERT_TRUE(png) << png.error().message;
    EXPECT_EQ(pixel(*png, 3, 3), (std::array<int, 4>{255, 0, 0, 255}));
    const auto jpeg = decode_image(
        unpacker, bytes_of(picture("a.jpg", {"-interlace", "JPEG", "-quality", "95"})));
    ASSERT_TRUE(jpeg) << jpeg.error().message;
    EXPECT_NEAR(pixel(*jpeg, 3, 3)[0], 255, 4);
    EXPECT_EQ(pixel(*jpeg, 3, 3)[3], 255);
}

TEST_F(ModelImages, that_are_webp_have_their_size_in_their_head) {
    struct Case {
        const char* name;
        std::vector<std::string> options;
    };
    // Lossy with opacity (VP8X), lossy without (VP8 ), not lossy (VP8L).
    for (const Case& one : {Case{"a.webp", {}},
                            Case{"a.webp", {"-alpha", "off"}},
                            Case{"a.webp", {"-define", "webp:lossless=true"}}}) {
        const std::string webp = picture(one.name, one.options);
        const auto head = look_at_image(bytes_of(webp));
        ASSERT_TRUE(head) << head.error().message;
        EXPECT_EQ(head->width, 40);
        EXPECT_EQ(head->height, 24);
        const auto image = decode_image(unpacker, bytes_of(webp));
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_NEAR(pixel(*image, 3, 3)[0], 255, 8);
    }
}

TEST_F(ModelImages, are_halved_by_the_mean_of_four_pixels) {
    const auto half = decode_image(unpacker, bytes_of(picture("a.png")), 1);
    ASSERT_TRUE(half);
    EXPECT_EQ(half->width, 20);
    EXPECT_EQ(half->height, 12);
    EXPECT_EQ(pixel(*half, 15, 11), (std::array<int, 4>{0, 0, 255, 128}));
    const auto least = decode_image(unpacker, bytes_of(picture("a.png")), 30);
    ASSERT_TRUE(least);
    EXPECT_EQ(least->width, 1);
}

TEST_F(ModelImages, that_claim_too_much_are_refused_by_their_head) {
    std::string png = picture("a.png");
    png[16] = '\x7F';
    const auto head = look_at_image(bytes_of(png));
    ASSERT_FALSE(head);
    EXPECT_EQ(head.error().message, "has 2130706472 x 24 pixels; sides of 1 to 8192 are read");
    EXPECT_FALSE(look_at_image(bytes_of("GIF89a..............................")));
    EXPECT_FALSE(look_at_image({}));
}

TEST_F(ModelImages, survive_cuts_and_damage) {
    for (const std::string& good : {picture("a.png"), picture("a.jpg"), picture("a.webp")}) {
        ASSERT_FALSE(good.empty());
        for (std::size_t size = 0; size < good.size(); ++size) {
            (void)decode_image(unpacker, bytes_of(good.substr(0, size)));
        }
        for (std::uint64_t seed = 0; seed < 500; ++seed) {
            const std::string bad =
                raks::test::mangled(good, {.seed = seed, .bytes = 1 + seed % 4});
            const auto image = decode_image(unpacker, bytes_of(bad));
            ASSERT_TRUE(image || !image.error().message.empty());
        }
    }
}

}  // namespace
