#pragma once

#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "render/avatar/avatar_rig.hpp"
#include "render/model/model.hpp"

namespace raks::apps {

/// Puts the face that a person writes as "happy=1,blink=0.6" on: names of the model's own
/// expressions, weights 0 to 1. Errors: not of this form, a weight out of range, an expression that
/// the model lacks (with the nearest).
[[nodiscard]] Expected<void> put_on_face(std::string_view text,
                                         const render::AvatarRig& rig,
                                         render::RigState& state);

/// How far one morph target of a node's mesh is on.
struct MorphWeight {
    int node = 0;
    std::size_t target = 0;
    float weight = 0.0F;
};
/// Those that are not 0, by node and target.
[[nodiscard]] std::vector<MorphWeight> morph_weights(const render::Model& model,
                                                     const render::AvatarRig& rig,
                                                     const render::RigState& state);

}  // namespace raks::apps
