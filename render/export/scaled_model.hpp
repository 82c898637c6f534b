#pragma once

#include "render/model/model.hpp"

namespace raks::render {

/// Makes a model larger: all its lengths, so that no node has a scale for it. Threads: any.
/// Real-time: no.
void scale_model(Model& model, float factor);

}  // namespace raks::render
