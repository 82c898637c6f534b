#include "apps/xbody/xbody_marks.hpp"

#include "render/panes/picture_view.hpp"

namespace raks::apps {

SeenMarks seen_marks(const ShownModel& model,
                     const ShownPose& shown,
                     const render::HumanoidMap& humanoid,
                     const std::vector<bool>& is_hidden,
                     const render::Camera& camera,
                     const render::Box& box,
                     const XbodyMarks& marks) {
    return {seen_skeleton(model, shown, humanoid, is_hidden, camera, box),
            marks.has_springs ? seen_springs(model, shown, camera, box) : SeenSprings()};
}

void draw_marks(const render::PaneFrame& frame,
                const render::Box& box,
                const SeenMarks& seen,
                const XbodyMarks& marks) {
    const render::PaneClip clip(frame, box);
    draw_springs(frame, seen.springs);
    if (marks.has_bones) {
        draw_skeleton(
            frame,
            seen.skeleton,
            {.has_names = marks.has_names, .chosen = marks.chosen, .pointed = marks.pointed});
    }
}

}  // namespace raks::apps
