#pragma once

#include <string>

#include "render/model/model.hpp"

namespace raks::render {

/// Adds a line to the model's warnings: made printable, none twice, at most 40; then one that says
/// that there are more.
void warn(Model& model, const std::string& line);

}  // namespace raks::render
