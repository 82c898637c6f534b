// Primitives that more joints move than one draw call holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/model/model.hpp"

namespace raks::render {

/// A part of a primitive, and the joints of its skin that it uses: a vertex's joint k is
/// `joints[k]` of the skin.
struct SkinnedPiece {
    ModelPrimitive primitive;
    std::vector<std::uint16_t> joints;
};

/// The primitive in as few pieces as its triangles' order gives, each with `most` (at least 12)
/// joints or fewer; vertices on a border are in both pieces. Threads: any. Real-time: no.
[[nodiscard]] std::vector<SkinnedPiece> split_by_joints(const ModelPrimitive& primitive,
                                                        std::size_t most);

}  // namespace raks::render
