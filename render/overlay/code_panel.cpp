#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/overlay/panels.hpp"

namespace raks::render {
namespace {

constexpr float kQuiet = 4.0F;        // modules of light around the code, as its standard asks
constexpr float kCodeSide = 210.0F;   // at most, with that light
constexpr float kCaption = 26.0F;     // room for the line below
constexpr float kCodeMargin = 12.0F;  // between the panel and the picture's edge

}  // namespace

void draw_code(const Pen& pen, const OverlayCode& code, const Canvas& canvas) {
    const float side = std::min({kCodeSide,
                                 canvas.width - 2.0F * kCodeMargin,
                                 canvas.height - 2.0F * kCodeMargin - kCaption});
    if (code.side == 0 || code.modules.size() < code.side * code.side || side <= 0.0F) {
        return;
    }
    // Whole pixels, so that all modules are as large.
    const float modules = static_cast<float>(code.side) + 2.0F * kQuiet;
    const float pixels = std::max(1.0F, std::floor(side * pen.unit() / modules));
    const float module = pixels / pen.unit();
    const float whole = module * modules;
    const auto on_a_pixel = [&](float place) {
        return std::floor(place * pen.unit()) / pen.unit();
    };
    // At the right, where the middle is the dancer's; there where nothing else has room.
    const bool is_wide = canvas.width >= 3.0F * whole;
    const float left =
        on_a_pixel(is_wide ? canvas.width - kMargin - whole : (canvas.width - whole) / 2.0F);
    const float top = on_a_pixel((canvas.height - whole - kCaption) / 2.0F);
    const Box panel{left, top, whole, whole + kCaption};
    pen.fill(panel, {0xFFFFFF}, 8.0F);
    for (std::size_t y = 0; y < code.side; ++y) {
        for (std::size_t x = 0; x < code.side; ++x) {
            if (code.modules[y * code.side + x] != 0) {
                pen.fill({left + module * (kQuiet + static_cast<float>(x)),
                          top + module * (kQuiet + static_cast<float>(y)),
                          module,
                          module},
                         {0x000000});
            }
        }
    }
    pen.text(pen.fonts().small,
             left + whole / 2.0F,
             top + whole - module,
             {0x303440},
             code.caption,
             Align::middle,
             whole - 8.0F);
}

}  // namespace raks::render
