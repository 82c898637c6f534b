// Bones by the tree of nodes and where they are, and what a standing figure must look like.
#pragma once

#include <optional>
#include <span>

#include "render/import/joint_shape.hpp"
#include "render/model/model.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// The bones of a standing figure without names: two equal limbs that end lowest are the legs,
/// what they hang on the hips, the way from there to two more equal limbs the trunk, beyond them
/// the head. The trunk may hang on the hips or carry them. Of the joints along a limb those three
/// count that make it a limb by their lengths: helper joints and collar bones are passed over. An
/// arm may end without a hand, a trunk be one joint. Fingers are left open. Left is +x where the
/// feet do not tell. Empty where there is no such figure. `places`: of all nodes, standing, y up;
/// `flesh`: what moves nothing of the skin is no joint; empty: it is not known.
[[nodiscard]] HumanoidMap map_by_shape(const Model& model,
                                       std::span<const glm::vec3> places,
                                       const NodeFlesh& flesh = {});

/// Where the feet point, level, of length 1: from foot to toes, else to the middle of the foot's
/// vertices. None: no foot tells, or they point apart.
[[nodiscard]] std::optional<glm::vec3> feet_direction(const Model& model,
                                                      const HumanoidMap& humanoid,
                                                      std::span<const glm::mat4> world);

/// Where the figure faces, level, of length 1, if its left is on its left: from the hips, else
/// from the shoulders; +z where neither tells.
[[nodiscard]] glm::vec3 facing_of(const HumanoidMap& humanoid, std::span<const glm::vec3> places);

/// How far the trunk leans from upright, radians: 0 of one that stands, about 1.6 of a dog.
[[nodiscard]] float trunk_lean(const HumanoidMap& humanoid, std::span<const glm::vec3> places);

}  // namespace raks::render
