// Step reader: the steps of a figure in a dance file.
#pragma once

#include "base/toml_reader.hpp"
#include "motion/choreography/authored_dance.hpp"

namespace raks::motion {

/// Reads a figure's steps = [{ foot, at, ... }, ...] and sorts them by the beat of landing. The
/// figure's beats and style must be known already. Faults go to `complaints`.
void read_steps(const toml::table& table, TomlComplaints& complaints, AuthoredFigure& figure);

}  // namespace raks::motion
