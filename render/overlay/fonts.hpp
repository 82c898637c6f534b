#pragma once

#include <imgui.h>

namespace raks::render {

/// The faces that the overlay and labels are written in.
enum class FontFace { plain, bold };

/// Which characters a font has. `names`: Latin, Greek, Cyrillic, dashes and the ellipsis, for names
/// of files and devices. `labels`: Latin of Western Europe, for the program's own words.
enum class Glyphs { names, labels };

/// Adds a font of this height in pixels: DejaVu Sans where it is installed, else ImGui's own, which
/// is always there. The atlas owns it. `oversampling`: columns of the texture for each pixel; 1
/// where the texture is copied as it is.
ImFont* add_font(
    ImFontAtlas& atlas, FontFace face, float pixels, Glyphs glyphs, int oversampling = 3);

}  // namespace raks::render
