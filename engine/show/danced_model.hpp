// A dance as a clip of the model that dances it.
#pragma once

#include <span>
#include <string>

#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/avatar/face.hpp"
#include "render/model/model.hpp"

namespace raks::engine {

/// The body that dances of a figure that is given away are solved for (render::dance_body).
/// Threads: workers. Real-time: no.
[[nodiscard]] motion::Skeleton dance_body_of(const render::Model& model);

/// Puts a dance into a figure that is given away (load_to_give_away, mannequin_to_give_away) as its
/// only clip: bones, what hangs from them by constraints and what swings, as the rig moves them. A
/// joint that rests has no channel. `sound`: file of the music, which the clip names. `poses`: that
/// were solved for its dance_body_of, at least one, `rate` (> 0) a second. `faces`: one a pose, or
/// none; they move the morph targets of the figure's expressions. Threads: workers. Real-time: no.
void put_dance(render::Model& model,
               std::span<const motion::Pose> poses,
               std::span<const render::Face> faces,
               double rate,
               const std::string& name,
               const std::string& sound = {});

}  // namespace raks::engine
