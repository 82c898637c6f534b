#pragma once

#include <cstdint>

namespace raks::render {

/// Which colour of a dancer's dress tints a vertex; the order of DressColours in render/dress.hpp.
enum class Paint : std::uint8_t {
    skin,
    suit,
    stripe,
    hair,
    shoes,
    trim,
    sole,
    white,
    iris,
    lips,
};

}  // namespace raks::render
