// How the builds of the mannequin differ in the solids of their bodies.
#pragma once

#include <optional>
#include <vector>

#include "render/mannequin/body_primitives.hpp"
#include "render/model/mannequin_style.hpp"

namespace raks::render {

/// A solid of the body as a build has it.
struct ShapedPrimitive {
    Primitive primitive;
    /// Stations of a loft that the build widens; else those of `primitive`.
    std::vector<Station> stations;
};

/// The solid of a build in its costume; none where it lacks it. The tables give the follow's in a
/// unitard.
[[nodiscard]] std::optional<ShapedPrimitive> shaped(const Primitive& primitive,
                                                    MannequinStyle style);

}  // namespace raks::render
