// Xbody marks: what is drawn of a model beside its surface.
#pragma once

#include <vector>

#include "apps/xbody/shown_model.hpp"
#include "apps/xbody/skeleton_view.hpp"
#include "apps/xbody/spring_view.hpp"

namespace raks::apps {

/// What is drawn over a model, and of it, beside its look.
struct XbodyMarks {
    bool has_bones = true;
    bool has_names = false;    ///< beside the bones, see named_nodes
    bool has_springs = false;  ///< chains and colliders
    bool is_wireframe = false;
    int chosen = -1;   ///< node; -1: none
    int pointed = -1;  ///< node under the pointer; -1: none
};

/// Bones and springs as they are seen.
struct SeenMarks {
    std::vector<SeenNode> skeleton;  ///< also where it is not drawn: it can be picked
    SeenSprings springs;             ///< empty where they are not drawn
};

/// What a camera sees of them in a box. Arguments as of seen_skeleton.
[[nodiscard]] SeenMarks seen_marks(const ShownModel& model,
                                   const ShownPose& shown,
                                   const render::HumanoidMap& humanoid,
                                   const std::vector<bool>& is_hidden,
                                   const render::Camera& camera,
                                   const render::Box& box,
                                   const XbodyMarks& marks);

/// Draws them, cut at the edge of the box.
void draw_marks(const render::PaneFrame& frame,
                const render::Box& box,
                const SeenMarks& seen,
                const XbodyMarks& marks);

}  // namespace raks::apps
