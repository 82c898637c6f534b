#include "render/overlay/fonts.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <system_error>

namespace raks::render {
namespace {

constexpr std::array<ImWchar, 11> kNameRanges = {
    0x0020, 0x024F, 0x0370, 0x03FF, 0x0400, 0x052F, 0x2010, 0x2027, 0x20AC, 0x20AC, 0};
// Large glyphs take much of the font texture.
constexpr std::array<ImWchar, 5> kLabelRanges = {0x0020, 0x00FF, 0x2010, 0x2027, 0};

/// Where Debian, Fedora and Arch put DejaVu.
std::string font_file(const char* name) {
    for (const char* const folder : {"/usr/share/fonts/truetype/dejavu/",
                                     "/usr/share/fonts/dejavu-sans-fonts/",
                                     "/usr/share/fonts/TTF/"}) {
        std::string path = std::string(folder) + name;
        std::error_code ignored;
        if (std::filesystem::is_regular_file(path, ignored)) {
            return path;
        }
    }
    return {};
}

}  // namespace

ImFont* add_font(ImFontAtlas& atlas, FontFace face, float pixels, Glyphs glyphs, int oversampling) {
    const std::string file =
        font_file(face == FontFace::plain ? "DejaVuSans.ttf" : "DejaVuSans-Bold.ttf");
    const ImWchar* const ranges =
        glyphs == Glyphs::names ? kNameRanges.data() : kLabelRanges.data();
    ImFontConfig config;
    config.OversampleH = oversampling;
    ImFont* font =
        file.empty() ? nullptr : atlas.AddFontFromFileTTF(file.c_str(), pixels, &config, ranges);
    if (font == nullptr) {
        ImFontConfig usual;
        usual.SizePixels = pixels;
        // Its pixels are whole ones, and whoever reads them from the texture counts on that.
        usual.OversampleH = 1;
        usual.OversampleV = 1;
        usual.PixelSnapH = true;
        font = atlas.AddFontDefault(&usual);
    }
    return font;
}

}  // namespace raks::render
