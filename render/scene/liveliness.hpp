#pragma once

#include <cstdint>

namespace raks::render {

/// How lively camera and light are.
enum class Liveliness : std::uint8_t {
    usual,  ///< cuts and accents
    calm,   ///< fewer cuts; the light changes slowly, little, and with no accent
};

}  // namespace raks::render
