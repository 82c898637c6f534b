#pragma once

#include <map>
#include <string>

#include "render/import/import_budget.hpp"
#include "render/import/tds_file.hpp"
#include "render/model/model.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// A place or direction of a 3DS file, z up, with y up. It is a rotation.
[[nodiscard]] inline glm::vec3 with_y_up(const glm::vec3& v) noexcept { return {v.x, v.z, -v.y}; }

/// The mesh of an object. `from_world`: its node's space, y up, from the file's world, z up; it can
/// be inverted. Normals are those of its smoothing groups, across vertices at one place; triangles
/// of no group are flat. There is a primitive for each material (`materials`: by name) that
/// triangles have, and one for those that have none or an unknown one.
/// Errors: more than `budget` allows. Threads: one. Real-time: no.
[[nodiscard]] Expected<ModelMesh> make_tds_mesh(const TdsObject& object,
                                                const glm::mat4& from_world,
                                                const std::map<std::string, int>& materials,
                                                ImportBudget& budget);

}  // namespace raks::render
