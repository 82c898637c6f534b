// What `raks stick --json` says of a clip.
#pragma once

#include <string>

#include "motion/skeleton/motion_clip.hpp"
#include "render/scene/clip_body.hpp"

namespace raks::apps {

/// The document (raks-clip, version 1; docs/reference/files.md): rate, and where the clip holds a
/// humanoid its joints with the reasons, up, rest pose, unit and height, each with a confidence.
/// JSON text without a line's end.
[[nodiscard]] std::string clip_document(const std::string& file,
                                        const motion::MotionClip& clip,
                                        const render::ClipBodies& recorded);

}  // namespace raks::apps
