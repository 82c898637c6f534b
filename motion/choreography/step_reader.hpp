#pragma once

#include "base/toml_reader.hpp"
#include "motion/choreography/authored_dance.hpp"

namespace raks::motion {

/// Reads a figure's steps = [{ foot, at, ... }, ...], by the beat of landing. The figure's beats
/// and style are known already.
void read_steps(const toml::table& table, TomlComplaints& complaints, AuthoredFigure& figure);

}  // namespace raks::motion
