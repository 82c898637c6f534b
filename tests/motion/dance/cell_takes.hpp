#pragma once

#include <memory>

#include "motion/cells/cell_dance.hpp"
#include "motion/dance/dance_content.hpp"
#include "motion/dance_library.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion::test {

/// A dance of cells whose takes are the shipped figures of salsa, joined at random: each cell has
/// the turn and the way that its take has, every third one that ends half a bar counts as a rest,
/// and later cells of a take have more energy.
const CellDance& salsa_cells();
/// The same, solved for the mannequin.
const DanceContent& salsa_cell_content();
/// The same as a library for a body.
std::shared_ptr<const DanceLibrary> salsa_cell_library(const Skeleton& body = mannequin_skeleton());

}  // namespace raks::motion::test
