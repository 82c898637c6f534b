// Expressions of figures that bring morph targets and do not say what they are for.
#pragma once

#include "render/model/model.hpp"

namespace raks::render {

/// Gives a figure the expressions that its morph targets can show, by their names: the 52 of ARKit
/// ("mouthSmileLeft", "mouthSmile_L"), Oculus' visemes ("viseme_aa", "vrc.v_aa"), those of VRoid
/// ("Face.M_F00_Fcl_ALL_Joy"), those of scanned heads ("h_expressions.LsmileOpen_h") and plain
/// words ("smile", "face_happy", "lip_a"). What stands before the last dot, letter case, blanks and
/// underscores do not count. A model that has expressions keeps its own. Without bones for the
/// eyes, targets that turn them do. Threads: workers. Real-time: no.
void add_face_morphs(Model& model);

}  // namespace raks::render
