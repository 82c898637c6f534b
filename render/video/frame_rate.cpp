#include <array>
#include <cmath>
#include <numeric>

#include "render/video/video_writer.hpp"

namespace raks::render {

FrameRate FrameRate::nearest(double fps) noexcept {
    // What television means by 23.976 (or 23.98), 29.97, 59.94 and their doubles.
    for (const int whole : std::array{24, 30, 48, 60, 120, 240}) {
        if (std::abs(fps - whole * 1000.0 / 1001.0) < 0.005) {
            return {whole * 1000, 1001};
        }
    }
    // Everything else is a fraction of thousandths in lowest terms; the bound keeps the int in
    // range.
    const int thousandths = static_cast<int>(std::lround(std::min(fps, 1e6) * 1000.0));
    const int common = std::gcd(thousandths, 1000);
    return {thousandths / common, 1000 / common};
}

}  // namespace raks::render
