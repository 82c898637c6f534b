// The parts of VRM's reader: one function a subject. Where a part is bad, all of these leave it
// out with a warning, and those that return nothing never fail.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string_view>

#include "base/expected.hpp"
#include "render/import/json_field.hpp"
#include "render/import/lenient.hpp"
#include "render/model/model.hpp"

namespace raks::render {

inline constexpr std::size_t kMostExpressions = 1000;
inline constexpr std::size_t kMostBinds = 10'000;  ///< of one expression
/// Where a gaze begins, from the head, in the file's unit.
inline constexpr NumberLimits kHeadOffset{-1000.0F, 1000.0F, 0.0F};

/// Whether a specVersion can be read: 1.0, or with a warning another 1.x or none.
[[nodiscard]] bool is_known_version(const JsonField& extension, Model& model);

// ---- The three kinds of file. Errors: no humanoid, or one of a later version.

/// `vrm`: extensions.VRMC_vrm.
[[nodiscard]] Expected<void> read_vrm1(const JsonField& vrm, Model& model);
/// `vrm`: extensions.VRM.
[[nodiscard]] Expected<void> read_vrm0(const JsonField& vrm, Model& model);
/// `animation`: extensions.VRMC_vrm_animation.
[[nodiscard]] Expected<void> read_vrm_animation(const JsonField& animation, Model& model);

// ---- Bones (vrm_humanoid.cpp). Faults of the field: a node that is not there, one node for two
// bones, a bone below its own child.

/// A map from bone to {node}: VRM 1.0.
void read_human_bones1(const JsonField& bones, Model& model);
/// A list of {bone, node}: VRM 0.x, whose thumbs have other names.
void read_human_bones0(const JsonField& bones, Model& model);
/// Fails with the names of those of the 15 required bones that a file does not name.
[[nodiscard]] Expected<void> check_required_bones(const HumanoidMap& humanoid);

// ---- Springs (spring_bone.cpp)

/// `springs`: extensions.VRMC_springBone.
void read_springs1(const JsonField& springs, Model& model);
/// `springs`: secondaryAnimation.
void read_springs0(const JsonField& springs, Model& model);

// ---- All else

/// VRMC_node_constraint of all nodes (node_constraint.cpp). `nodes`: of the file.
void read_constraints(const JsonField& nodes, Model& model);
/// VRMC_materials_mtoon of all materials (mtoon.cpp). `materials`: of the file.
void read_mtoon1(const JsonField& materials, Model& model);
/// `properties`: materialProperties of VRM 0.x, brought onto MToon 1.0 (mtoon0.cpp).
void read_materials0(const JsonField& properties, Model& model);

/// Morph targets of a node's mesh; 0 where it has none.
[[nodiscard]] std::size_t morphs_of_node(const Model& model, int node);

/// All that a "meta" object says, as terms, without the keys named in `others`.
void read_terms(const JsonField& meta,
                std::initializer_list<std::string_view> others,
                Model& model);

}  // namespace raks::render
