// What a costume changes of the solids of the body: cloth that hangs wide is a wider body.
#pragma once

#include <optional>
#include <span>

#include "render/mannequin/body_primitives.hpp"
#include "render/mannequin/build_shape.hpp"
#include "render/model/mannequin_style.hpp"

namespace raks::render {

/// A solid of a build in its costume; none where the cloth hides it.
[[nodiscard]] std::optional<ShapedPrimitive> dressed(ShapedPrimitive made, MannequinStyle style);

/// Solids that a costume adds. A static table.
[[nodiscard]] std::span<const Primitive> costume_primitives(Costume costume) noexcept;

/// Whether it wears a coat with a shirt under it.
[[nodiscard]] bool has_coat(MannequinStyle style) noexcept;

/// Whether its shoes have a heel and an arch before it (sole_height), or a flat sole.
[[nodiscard]] bool has_arch(Costume costume) noexcept;

}  // namespace raks::render
