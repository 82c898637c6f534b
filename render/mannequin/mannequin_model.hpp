// The mannequin as a model that other programs can read.
#pragma once

#include <array>

#include "render/mannequin/mannequin.hpp"
#include "render/model/model.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// Linear colours in the order of Paint (render/model/paint.hpp) and of DressColours.
using PaintColours = std::array<glm::vec3, 10>;

/// The mannequin as a figure of VRM 1.0: its skin and what it wears over it, in a material for each
/// colour; expressions, gaze, springs; CC0. Of the skin's helpers, those at elbows and knees and in
/// the forearms are nodes with constraints, which turn them exactly as the mannequin's own. The
/// others VRM cannot say: the half way joints of shoulders and hips are folded half into the bone
/// above and half into the limb, the rolled ones of the limbs into the limb, so that armpits and
/// groins fold more sharply than in Raks; collar bones rise where the pose says so. Threads: any.
/// Real-time: no (0.3 s).
[[nodiscard]] Model mannequin_model(const PaintColours& colours, MannequinStyle style = {});

}  // namespace raks::render
