// BMP and TGA: as another program writes them they are read to the pixels that it was given.
#include "render/import/plain_picture.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "render/import/image_file.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::render {
namespace {

using Colour = std::array<int, 4>;

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

void run(const std::vector<std::string>& command) {
    raks::test::ProcessPlan plan;
    plan.command = command;
    EXPECT_EQ(raks::test::run_process(plan).exit_code, 0) << command.back();
}

/// A picture of 37 x 5 pixels, red, then green above blue. `convert` writes BMP, and PNG for
/// ffmpeg, which writes TGA (that of `convert` 6 stands upside down).
std::string plain_picture(const std::string& name, const std::vector<std::string>& options) {
    const raks::test::TemporaryFolder folder;
    const bool is_tga = name == "a.tga";
    const std::string file = (folder / name).string();
    const std::string first = is_tga ? (folder / "a.png").string() : file;
    const std::string shown = name.rfind("BMP", 0) == 0
                                  ? name.substr(0, name.find(':') + 1) + (folder / "a.bmp").string()
                                  : first;
    std::vector<std::string> command = {"convert",
                                        "-size",
                                        "20x5",
                                        "xc:#ff0000",
                                        "(",
                                        "-size",
                                        "17x2",
                                        "xc:#00ff00",
                                        "-size",
                                        "17x3",
                                        "xc:#0000ff",
                                        "-append",
                                        ")",
                                        "+append"};
    if (!is_tga) {
        command.insert(command.end(), options.begin(), options.end());
    }
    command.push_back(shown);
    run(command);
    if (is_tga) {
        command = {"ffmpeg", "-v", "error", "-i", first};
        command.insert(command.end(), options.begin(), options.end());
        command.push_back(file);
        run(command);
    }
    return read_file(is_tga ? folder / "a.tga" : folder / "a.bmp").value_or("");
}

Colour pixel(const Image& image, int x, int y) {
    const std::size_t at = 4 * static_cast<std::size_t>(y * image.width + x);
    return {image.pixels[at], image.pixels[at + 1], image.pixels[at + 2], image.pixels[at + 3]};
}

struct Kind {
    const char* name;
    std::vector<std::string> options;
};

std::vector<Kind> kinds() {
    return {{"BMP3:a.bmp", {"-type", "TrueColor"}},
            {"BMP3:a.bmp", {"-type", "Palette", "-compress", "none"}},
            {"BMP2:a.bmp", {"-type", "TrueColor"}},
            {"BMP:a.bmp", {"-alpha", "on", "-define", "bmp:format=bmp4"}},
            {"BMP:a.bmp", {"-type", "TrueColor", "-define", "bmp:subtype=RGB565"}},
            {"a.tga", {"-rle", "0", "-pix_fmt", "bgr24"}},
            {"a.tga", {"-rle", "1", "-pix_fmt", "bgr24"}},
            {"a.tga", {"-rle", "1", "-pix_fmt", "bgra"}},
            {"a.tga", {"-rle", "1", "-pix_fmt", "pal8"}}};
}

/// Each is written once.
const std::string& written(const Kind& kind) {
    static std::map<std::string, std::string> files;
    std::string key = kind.name;
    for (const std::string& option : kind.options) {
        key += option;
    }
    const auto [place, is_new] = files.try_emplace(key);
    if (is_new) {
        place->second = plain_picture(kind.name, kind.options);
    }
    return place->second;
}

TEST(PlainPictures, are_read_to_the_pixels_that_were_written) {
    for (const Kind& kind : kinds()) {
        SCOPED_TRACE(std::string(kind.name) + " " + kind.options.back());
        const std::string& file = written(kind);
        ASSERT_TRUE(is_plain_picture(bytes_of(file), kind.name));
        const auto image = read_plain_picture(bytes_of(file));
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->width, 37);
        EXPECT_EQ(image->height, 5);
        EXPECT_EQ(pixel(*image, 0, 0), (Colour{255, 0, 0, 255}));
        EXPECT_EQ(pixel(*image, 19, 4), (Colour{255, 0, 0, 255}));
        EXPECT_EQ(pixel(*image, 20, 1), (Colour{0, 255, 0, 255}));
        EXPECT_EQ(pixel(*image, 36, 2), (Colour{0, 0, 255, 255}));
        EXPECT_EQ(pixel(*image, 36, 4), (Colour{0, 0, 255, 255}));
    }
}

TEST(PlainPictures, grey_and_two_colours_are_read) {
    for (const auto& [name, options] :
         {Kind{"a.tga", {"-pix_fmt", "gray"}},
          Kind{"BMP3:a.bmp", {"-colorspace", "Gray", "-threshold", "60%", "-type", "Bilevel"}}}) {
        SCOPED_TRACE(name);
        const auto image = read_plain_picture(bytes_of(plain_picture(name, options)));
        ASSERT_TRUE(image) << image.error().message;
        const Colour green = pixel(*image, 36, 0);
        EXPECT_EQ(green[0], green[1]);
        EXPECT_EQ(green[0], green[2]);
        EXPECT_GT(green[0], pixel(*image, 36, 4)[0]);  // green is brighter than blue
    }
}

TEST(PlainPictures, become_png_of_the_same_pixels) {
    ModelUnpacker unpacker;
    for (const Kind& kind : kinds()) {
        const std::string& file = written(kind);
        const auto png = png_of_plain_picture(bytes_of(file));
        ASSERT_TRUE(png) << png.error().message;
        const auto image = decode_image(unpacker, *png);
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->pixels, read_plain_picture(bytes_of(file))->pixels);
    }
}

TEST(PlainPictures, whose_opacity_is_0_everywhere_are_opaque) {
    std::string tga(18 + 4, '\0');
    tga[2] = 2;
    tga[12] = tga[14] = 1;
    tga[16] = 32;
    tga[18] = '\x10';
    const auto image = read_plain_picture(bytes_of(tga));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(pixel(*image, 0, 0), (Colour{0, 0, 16, 255}));
}

TEST(PlainPictures, of_fifteen_bits_are_read) {
    std::string tga(18 + 2, '\0');
    tga[2] = 2;
    tga[12] = tga[14] = 1;
    tga[16] = 16;
    tga[18] = '\x1F';  // blue
    tga[19] = '\x40';  // half of red
    const auto image = read_plain_picture(bytes_of(tga));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(pixel(*image, 0, 0), (Colour{132, 0, 255, 255}));
}

TEST(PlainPictures, are_told_from_others) {
    EXPECT_FALSE(is_plain_picture(bytes_of("\x89PNG"), "a.png"));
    EXPECT_FALSE(is_plain_picture({}, ""));
    EXPECT_TRUE(is_plain_picture({}, "C:\\MAPS\\SKIN.TGA"));
    EXPECT_EQ(read_plain_picture({}).error().message, "is not a TGA of a kind that is read");
}

TEST(PlainPictures, that_claim_too_much_are_refused_by_their_head) {
    std::string tga(18, '\0');
    tga[2] = 10;
    tga[13] = tga[15] = 32;
    tga[16] = 24;
    EXPECT_EQ(read_plain_picture(bytes_of(tga)).error().message,
              "has 8192 x 8192 pixels; sides of 1 to 8192 and up to 16777216 pixels are read");
    tga[13] = tga[15] = 16;
    EXPECT_EQ(read_plain_picture(bytes_of(tga)).error().message, "is a TGA that is cut off");
}

TEST(PlainPictures, survive_cuts_and_damage) {
    for (const Kind& kind : kinds()) {
        const std::string& good = written(kind);
        for (std::size_t size = 0; size < good.size(); ++size) {
            (void)read_plain_picture(bytes_of(good.substr(0, size)));
        }
        for (std::uint64_t seed = 0; seed < 300; ++seed) {
            const std::string bad =
                raks::test::mangled(good, {.seed = seed, .bytes = 1 + seed % 4, .reach = 80});
            const auto image = read_plain_picture(bytes_of(bad));
            ASSERT_TRUE(image || image.error().message.find('\n') == std::string::npos);
        }
    }
}

}  // namespace
}  // namespace raks::render
